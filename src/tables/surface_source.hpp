// SPDX-License-Identifier: MIT
// The canonical slab transport as surface clouds read it: the source J of light scattered at least
// twice, as an image for linear filters, and the phase functions of the sets. Coordinates:
// shaders/model/surface/source.glsl. No Vulkan.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "tables/canonical_table.hpp"

namespace welkin {

struct SurfaceSource {
  std::array<size_t, 3> size{};  // of the image: x fastest
  std::vector<float> values;     // ln(J / (mu_L P))
  std::vector<float> logPhase;   // [set][angle], at 0, 1, .. 180 degrees
};

// As a device reads it, four numbers to a texel: model/surface/source.glsl.
struct SurfaceSourceImage {
  std::array<size_t, 3> size{};
  std::vector<float> values;
  std::vector<float> logPhase;  // 181 x 2: four sets to a texel
};
SurfaceSourceImage surfaceSourceImage(const SurfaceSource& source);

// Differs from what the table's own cubics give by what docs/models.md says.
SurfaceSource surfaceSource(const CanonicalTable& table);

// A point of a slab, as tangent_slab.glsl finds it.
struct SurfaceSlabPoint {
  double thickness;  // > 0
  double depth;      // [0, thickness]
  double muLight;    // (0, 1]
  double muView;     // > 0 deeper into the slab, [-1, 1]
  double phi;        // [0, pi]
};

// J per unit irradiance, in 1/sr; the pass's arithmetic in double.
double surfaceSourceAt(const SurfaceSource& source, size_t set, const SurfaceSlabPoint& point);

}  // namespace welkin
