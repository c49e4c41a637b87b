// SPDX-License-Identifier: MIT
// Detail under the faces of a cloud surface: its noise, and the cells that tell how deep points
// lie.
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "vk/device.hpp"

namespace welkin {

struct SurfaceState;
struct SurfaceTables;
namespace interface_ {
struct SurfaceUniforms;
}

// As WlkSurfaceDetail.
struct SurfaceDetail {
  double depth = 0;     // m; 0: none
  double size = 0;      // m, of the largest lumps
  double softness = 1;  // of the edge, in depths
  glm::dvec3 offset{0};
};

// Cells over a mesh's box, along the mesh's axes, two of them empty on each side.
struct SurfaceShell {
  std::array<uint32_t, 3> cells{};
  vk::Buffer depth;      // faces of four cells, see surface_shell.comp
  uint64_t version = 0;  // of the vertices that it was made from; 0: of none
};

constexpr uint32_t SHELL_ROOM = 1 << 19;  // at most

// Cells for a depth of detail, m in the world, over the box of the latest positions.
std::array<uint32_t, 3> shellCells(const SurfaceState& surface, double depth);
// Buffer and room for what it is made of, and the noise if that is not there. Throws before
// anything has changed.
vk::Buffer makeShell(vk::Device& device, const std::array<uint32_t, 3>& cells,
                     SurfaceTables& tables);

// A point `origin + x a + y b + z c` from the mesh's origin, world axes, to the cells; `width` as
// SurfaceUniforms::detail has it. Nothing where there is no detail.
void fillDetail(const SurfaceState& surface, const glm::dvec3& origin, const glm::dmat3& axes,
                double width, interface_::SurfaceUniforms& out);
// Constants of the picture that fills the cells.
void fillShell(const SurfaceState& surface, interface_::SurfaceUniforms& out);

}  // namespace welkin
