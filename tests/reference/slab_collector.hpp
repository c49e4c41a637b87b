// SPDX-License-Identifier: MIT
// Light at a point of a homogeneous slab that absorbs nothing, by sets of scattering orders, and
// where it came in, by Monte Carlo: a check for deterministic solvers. Radiance per unit irradiance
// on a surface facing the sun, lengths and depths optical.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "reference/phase_function.hpp"

namespace welkin::reference {

// Light that travels with cosine mu to the vertical, > 0 downwards, and azimuth phi against the
// sun's light, arrives at this depth.
struct CollectorView {
  double thickness;
  double depth;
  double mu;
  double phi;
};

// Entry points on the top as seen from the point, x along the horizontal direction of the sun's
// light: mean and root of the mean square distance from there; one standard error of each.
struct CollectorEstimate {
  double radiance, radianceError;
  double x, y, shiftError;
  double width, widthError;
};

// suns: cosines of zenith angles, all from the same paths. orders: first order of each set; the
// last has no end. [sun][set].
std::vector<CollectorEstimate> slabCollectors(const CollectorView& view, const PhaseFunction& phase,
                                              std::span<const double> suns,
                                              std::span<const int> orders, uint64_t samples,
                                              uint64_t seed);

}  // namespace welkin::reference
