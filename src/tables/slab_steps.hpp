// SPDX-License-Identifier: MIT
// Depths of a slab, and exact integrals of light along a stretch between two of them when the
// source is a parabola of depth. Lengths and depths are optical. No Vulkan.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace welkin {

// Integrals of y^p e^(-x y) over [0, 1], p = 0 .. 4, x >= 0; 1e-14 relative (SlabSteps tests).
std::array<double, 5> decayMoments(double x);

// Depths 0 .. thickness: cells with a node in their middle, narrow at both faces, where light that
// grazes them comes and goes. `fineness` divides every width; at 1 the light of a set of orders is
// within 2e-4 of its limit, energy within 1e-4.
std::vector<double> slabDepths(double thickness, double fineness = 1);

// One stretch of a ray, between neighbouring nodes of a cell: I(end) = decay I(start) + sum over
// the nodes of weight[0] J; weight[p] holds u^p e^-u, u the length from the end back.
struct SlabStep {
  double length = 0;
  double decay = 1;
  std::array<std::array<double, 3>, 3> weight{};  // [p][node]
};

// `node`: places of the parabola's nodes, in lengths of the stretch from its end back: 0, 1, 2 in a
// cell's second half and 0, 1, -1 in its first; all different.
SlabStep slabStep(double length, const std::array<double, 3>& node);

}  // namespace welkin
