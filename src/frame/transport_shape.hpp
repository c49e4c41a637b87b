// SPDX-License-Identifier: MIT
// Where the grid of a volume's light lies and how deep, optically, the volume is. Lengths in m.
#pragma once

#include "frame/scene.hpp"

namespace welkin {

// Where a volume's grid lies: around all density, in cells that are cubes where the volume is not
// flat, multiples of 8 along each axis.
struct TransportShape {
  std::array<uint32_t, 3> cells{};
  glm::dvec3 origin{0};  // in the unit box
  glm::dvec3 size{1};
  int thinAxis = -1;   // of a flat one
  bool layer = false;  // much wider than high, see transport_layer.hpp
};
constexpr double FLAT = 0.4;  // of the longest edge
// At most edge^3 cells, edge a multiple of 8, and transportImageEdge(edge) along an axis.
TransportShape transportShape(const VolumeState& volume, uint32_t edge);
uint32_t transportImageEdge(uint32_t edge);

// All but the cells. Makes no table of the phase function, which a layer's cells ask for.
TransportShape flatShape(const VolumeState& volume);

// Least stretches of a ray in a flat volume, from face to face of the unit box along each axis; 0
// elsewhere. An eye's steps go by how far the light goes through the box, which is as far as a
// layer is wide where light comes from aside: such steps alone left 27 % of error at 16 slices
// (tests/image/flat_layer_test.cpp).
// `grid`: light of all orders comes from the grid, whose cells then count.
glm::dvec3 flatStretches(const TransportShape& shape, uint32_t slices, bool grid);
// Of a ray across what is filled: more with many slices, whose pictures shall come to a limit.
constexpr double flatStretchesAcross(uint32_t slices) {
  return slices > 256 ? slices / 16.0 : 16.0;
}

double meanAlbedo(const FieldState& field);

// Optical depth, without the peak, across what is filled of the volume where that is thinnest, of
// the mean extinction that light meets (weighted by itself: gaps between clouds do not make them
// thin, and uploads by parts leave it as it is); UNKNOWN_DEPTH for engines' images and where
// nothing is.
constexpr double UNKNOWN_DEPTH = 1e6;
double thinDepth(const VolumeState& volume);
// 1 - e^-thinDepth: in a thin layer light leaves before the peak has turned it as often as in an
// endless one.
double turnedShare(const VolumeState& volume);

}  // namespace welkin
