// SPDX-License-Identifier: MIT
// Diffuse light in a slab of the canonical cloud: of a point's source, the part that light from the
// side of the lit face makes; light from the other side makes the rest. No Vulkan.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "tables/surface_source.hpp"

namespace welkin {

// As an image for linear filters: depth, then thickness and view (those up behind those down), all
// in the coordinates of shaders/model/surface/source.glsl.
struct SurfaceAmbient {
  std::array<size_t, 2> size{};
  std::vector<float> share;  // less that of diffusion
};

// Integrals over the hemisphere of light that is equally bright there, all orders. In equal light
// from both sides the source is that light: what the sums of both sides lack of it (2 % in the
// mean, where the table's filters cut corners) is shared between them.
SurfaceAmbient surfaceAmbient(const SurfaceSource& source, double asymmetry);

// Between the nodes, as the pass has it.
double surfaceAmbientAt(const SurfaceAmbient& table, double thickness, double depth, double muView);

}  // namespace welkin
