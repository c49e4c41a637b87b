// SPDX-License-Identifier: MIT
// Directions in which light travels through a volume's grid of cells, and what is integrated over
// them. Lengths in m.
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "frame/transport.hpp"

namespace welkin {

// Lebedev 1976, 26 points: faces, edges and corners of a cube; exact to degree 7, which products of
// two harmonics of degree 3 do not exceed. With the 24 that follow: 50 points, degree 11.
struct TransportQuadrature {
  static constexpr size_t COUNT = interface_::TRANSPORT_DIRECTIONS;
  static constexpr size_t COARSE = interface_::TRANSPORT_COARSE_DIRECTIONS;
  std::array<glm::dvec3, COUNT> direction;
  std::array<double, COUNT> fine;     // weights of all
  std::array<double, COARSE> coarse;  // of the first 26 alone
};
TransportQuadrature transportQuadrature();

// Degree < 4, numbered l l + l + m, mean square 1; m > 0 with cos(m azimuth).
std::array<double, interface_::TRANSPORT_TERMS> transportHarmonics(const glm::dvec3& v);

// Cells along the box's axes, `perCell` of them for each cell.
glm::dmat3 transportCellsFromWorld(const glm::dmat3& boxFromWorld, const TransportShape& shape,
                                   double perCell);

// How rays of a direction meet slices.
interface_::TransportDirection transportDirection(const glm::dmat3& cellsFromWorld,
                                                  const glm::dvec3& direction, double weight);

// The box's axes, made orthonormal.
glm::dmat3 transportTurn(const glm::dmat3& box);

// The quadrature's, turned with the box. Of a flat volume they are tilted: none lies in its plane,
// where light goes far and one direction would stand for much.
std::array<glm::dvec3, TransportQuadrature::COUNT> transportDirectionsIn(
    const glm::dmat3& box, const TransportShape& shape);

// Takes degrees under 4 off a function of the angle, at the nodes of FINE_NODES.
void removeLowDegrees(std::array<glm::dvec3, FINE_NODES>& kernel);

}  // namespace welkin
