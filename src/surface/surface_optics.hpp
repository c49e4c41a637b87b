// SPDX-License-Identifier: MIT
// What a medium does to light as cloud surfaces count it ([B08] appendix A): with and without its
// forward peak, and as canonical cloud. No Vulkan.
#pragma once

#include <array>
#include <vector>

#include "particles/medium.hpp"
#include "tables/canonical_table.hpp"

namespace welkin {

struct SurfaceOptics {
  // Times the medium's extinction coefficient: extinction, that without the forward peak, depth of
  // the canonical cloud.
  double whole = 1;
  double smooth = 1;
  double canonical = 1;
  // Single-scattering albedo without the peak, and that with it over it, means of the colours.
  std::array<double, RGB> albedo{};
  double peakAlbedo = 1;
  // Part of the light of each set of orders that is not absorbed.
  std::array<std::array<double, RGB>, CANONICAL_SETS> orders{};
  // RGB at the nodes of a PhaseCurve, 1/sr: P without the peak, of integral 1 in the mean over the
  // colours, then what the peak adds to P; kCurveNodes each.
  std::vector<std::array<float, 4>> curve;
};

// `canonicalAsymmetry`: CanonicalTable::asymmetry. The peak is what P has within 5 degrees above
// its value there. As canonical cloud counts a depth of equal (1 - g), absorption added.
SurfaceOptics surfaceOptics(const Medium& medium, double canonicalAsymmetry);

}  // namespace welkin
