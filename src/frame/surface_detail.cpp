// SPDX-License-Identifier: MIT
#include "frame/surface_detail.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "frame/surface.hpp"
#include "model/model.hpp"
#include "tables/detail_noise.hpp"

namespace welkin {
namespace {

using interface_::SurfaceUniforms;

constexpr double BORDER = 2;  // cells on each side in which nothing of the mesh lies
constexpr uint32_t LEAST_CELLS = 8;
constexpr uint32_t MOST_CELLS = 256;

glm::dvec3 vectorOf(const std::array<float, 3>& a) {
  return {a[0], a[1], a[2]};
}

glm::dvec3 lowOf(const SurfaceState& s) {
  return vectorOf(s.low);
}

// Edges of a box, never 0.
glm::dvec3 edgesBetween(const std::array<float, 3>& low, const std::array<float, 3>& high) {
  const glm::dvec3 edge = vectorOf(high) - vectorOf(low);
  return glm::max(edge, std::max({edge.x, edge.y, edge.z, 1e-6}) * 1e-6);
}

// Of the mesh's box in its own frame.
glm::dvec3 edgesOf(const SurfaceState& s) {
  return edgesBetween(s.low, s.high);
}

// World lengths of the mesh's axes.
glm::dvec3 scalesOf(const SurfaceState& s) {
  const glm::dmat3 linear(s.worldFromMesh);
  return {glm::length(linear[0]), glm::length(linear[1]), glm::length(linear[2])};
}

glm::dvec3 countsOf(const SurfaceState& s) {
  return {s.shell.cells[0], s.shell.cells[1], s.shell.cells[2]};
}

// Edges of a cell in the mesh's frame.
glm::dvec3 cellOf(const SurfaceState& s) {
  return edgesOf(s) / (countsOf(s) - 2 * BORDER);
}

}  // namespace

std::array<uint32_t, 3> shellCells(const SurfaceState& s, double depth) {
  const glm::dvec3 edges = edgesBetween(s.newLow, s.newHigh) * scalesOf(s);
  double cell = std::max(depth / model::f64::SHELL_CELLS, 1e-6);
  std::array<uint32_t, 3> cells{};
  for (;; cell *= 1.1) {
    uint64_t all = 1;
    for (int i = 0; i < 3; ++i) {
      const double count = std::min(std::ceil(edges[i] / cell) + 2 * BORDER, double{MOST_CELLS});
      cells[static_cast<size_t>(i)] = std::max(static_cast<uint32_t>(count), LEAST_CELLS);
      all *= cells[static_cast<size_t>(i)];
    }
    if (all <= SHELL_ROOM) {
      return cells;
    }
  }
}

vk::Buffer makeShell(vk::Device& device, const std::array<uint32_t, 3>& cells,
                     SurfaceTables& tables) {
  const VkDeviceSize rows = VkDeviceSize{cells[0]} * cells[1] * cells[2];
  vk::Buffer shell(device, 4 * sizeof(float) * rows, vk::ROWS | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                   false);
  if (tables.noise) {
    return shell;
  }
  // Drivers such as lavapipe fetch two texels of four corners for less than the eight of a linear
  // filter.
  const std::vector<uint32_t> faces = detailFaces(detailNoise());
  vk::Buffer staging(device, faces.size() * sizeof faces[0], VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                     true);
  std::memcpy(staging.data(), faces.data(), staging.size());
  vk::ImageInfo info;
  info.type = VK_IMAGE_TYPE_3D;
  info.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  info.format = VK_FORMAT_R8G8B8A8_UNORM;
  info.extent = {DETAIL_IMAGE[0], DETAIL_IMAGE[1], DETAIL_IMAGE[2]};
  static_assert(interface_::SHELL_LEVELS == DETAIL_LEVELS &&
                interface_::SHELL_NOISE == DETAIL_TEXELS);
  vk::Image image(device, info);
  constexpr VkBufferUsageFlags WORK =
      VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
  tables.cells = vk::Buffer(device, VkDeviceSize{2} * SHELL_ROOM * sizeof(float), WORK, false);
  tables.noise = std::move(image);
  tables.newNoise = std::move(staging);
  return shell;
}

void fillDetail(const SurfaceState& s, const glm::dvec3& origin, const glm::dmat3& axes,
                double width, SurfaceUniforms& out) {
  const SurfaceDetail& d = s.detail;
  if (!(d.depth > 0)) {
    return;
  }
  out.detail = {static_cast<float>(d.depth), static_cast<float>(1 / d.depth),
                static_cast<float>(d.softness), static_cast<float>(width)};
  const glm::dmat3 inverse = glm::inverse(glm::dmat3(s.worldFromMesh));
  const glm::dvec3 counts = countsOf(s);
  const glm::dvec3 cell = cellOf(s);
  const glm::dvec3 scales = scalesOf(s);
  const glm::dvec3 low = lowOf(s);
  const double period = d.size * DETAIL_LUMPS;
  const auto row = [&](int i) {
    const glm::dvec3 toMesh(inverse[0][i], inverse[1][i], inverse[2][i]);
    const double unit = 1 / (cell[i] * counts[i]);
    const double at = (glm::dot(toMesh, origin) - low[i]) * unit + BORDER / counts[i];
    return glm::vec4(glm::dvec4(glm::dot(toMesh, axes[0]) * unit, glm::dot(toMesh, axes[1]) * unit,
                                glm::dot(toMesh, axes[2]) * unit, at));
  };
  out.cellX = row(0);
  out.cellY = row(1);
  out.cellZ = row(2);
  const glm::dvec3 metres = cell * scales;  // of a cell
  const glm::dvec3 shift = (low * scales - BORDER * metres - d.offset) / period;
  const double cellDepth = (metres.x + metres.y + metres.z) / 3 / d.depth;
  out.detailScale = glm::vec4(glm::dvec4(counts * metres / period, DETAIL_TEXELS / period));
  // Whole periods fall out in double.
  out.detailShift = glm::vec4(glm::dvec4(shift - glm::floor(shift), cellDepth));
  out.cells = {s.shell.cells[0], s.shell.cells[1], s.shell.cells[2], 0};
}

void fillShell(const SurfaceState& s, SurfaceUniforms& out) {
  out = {};
  const glm::dvec3 cell = cellOf(s);
  const glm::dvec3 low = lowOf(s);
  const glm::dvec3 pixel = cell / double{interface_::SHELL_PIXELS};
  const double border = BORDER * interface_::SHELL_PIXELS;
  out.pixelX = glm::vec4(glm::dvec4(1 / pixel.x, 0, 0, border - 0.5 - low.x / pixel.x));
  out.pixelY = glm::vec4(glm::dvec4(0, 0, 1 / pixel.z, border - 0.5 - low.z / pixel.z));
  out.pixelW = {0, 0, 0, 1};
  out.depth = glm::vec4(glm::dvec4(0, 1 / cell.y, 0, BORDER - low.y / cell.y));
  out.steps = {0, 1, static_cast<float>(s.shell.cells[1]), -1e30F};
  out.rect = {0, 0, static_cast<int>(s.shell.cells[0] * interface_::SHELL_PIXELS),
              static_cast<int>(s.shell.cells[2] * interface_::SHELL_PIXELS)};
  out.cells = {s.shell.cells[0], s.shell.cells[1], s.shell.cells[2], 0};
  // x, z, y: the picture's axes are mirrored.
  fillTriangles(s, true, out);
}

}  // namespace welkin
