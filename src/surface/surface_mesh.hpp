// SPDX-License-Identifier: MIT
// The boundary of a surface cloud ([B08]): triangles that enclose a volume, checked. Lengths in m.
// No Vulkan.
//
// An optical depth along a ray needs an inside, so the mesh must be closed: each edge is walked as
// often one way as the other. Vertices at equal places count as one, since exporters split them at
// seams of texture and normal. Self-intersections are accepted.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace welkin {

constexpr size_t SURFACE_TRIANGLES_MAX = size_t{1} << 22;
constexpr float SURFACE_POSITION_MAX = 1e7f;  // m, of each coordinate
constexpr uint32_t NO_PLACE = ~0U;            // of a vertex that no triangle uses

struct SurfaceMesh {
  std::vector<std::array<float, 3>> positions;     // no two are equal
  std::vector<std::array<uint32_t, 3>> triangles;  // none has zero area; normals face outwards
  std::vector<uint32_t> placeOf;                   // of each vertex that came, or NO_PLACE
  std::array<float, 3> low{};                      // of the box around them
  std::array<float, 3> high{};
  double area_m2 = 0;
  double volume_m3 = 0;  // > 0
};

// `positions`: x, y, z of each vertex; `indices`: three of each triangle. A mesh wound inwards is
// turned. Fails with WLK_ERROR_INVALID_ARGUMENT and `positions` or `indices` as the field.
SurfaceMesh makeSurfaceMesh(std::span<const float> positions, std::span<const uint32_t> indices);

}  // namespace welkin
