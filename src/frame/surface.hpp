// SPDX-License-Identifier: MIT
// Cloud surfaces of a context: meshes on the GPU, light maps, and the constants of their passes.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "frame/plan.hpp"
#include "frame/surface_detail.hpp"
#include "surface/surface_optics.hpp"
#include "vk/device.hpp"

namespace welkin {

namespace interface_ {
using vec4 = glm::vec4;
using ivec4 = glm::ivec4;
using uvec4 = glm::uvec4;
using uint = uint32_t;
#include "interface/surface.glsl"
}  // namespace interface_

// What a light map was made from: uniforms of the light's picture and the mesh's version.
struct SurfaceLightKey {
  std::array<float, 44> rows{};
  uint64_t version = 0;  // 0: nothing was made yet
  bool operator==(const SurfaceLightKey&) const = default;
};

// Light maps of a surface, for views whose quality asks for that size.
struct SurfaceLight {
  uint32_t size = 0;
  bool up = false;  // along the local vertical, for the light of sky and ground
  vk::Image depths;
  vk::Image columns;
  vk::Image faces;
  SurfaceLightKey key;
};

// Mean radiance from above and from below, by what they bring onto a level plane.
struct SurfaceAmbientLight {
  glm::dvec3 up{0, 1, 0};
  glm::dvec3 sky{0};
  glm::dvec3 ground{0};
};

struct SurfaceState {
  explicit SurfaceState(std::pmr::memory_resource* memory) : placeOf(memory), lights(memory) {}
  double extinction = 0;  // 1/m
  SurfaceOptics optics;   // `curve` is on the GPU
  SurfaceDetail detail;
  SurfaceShell shell;  // where there is, or was, detail
  glm::dmat4x3 worldFromMesh{1.0};
  std::array<float, 3> low{};  // of the vertices on the GPU
  std::array<float, 3> high{};
  std::array<float, 3> newLow{};  // of those to be uploaded
  std::array<float, 3> newHigh{};
  std::pmr::vector<uint32_t> placeOf;  // of the engine's vertices, or NO_PLACE
  uint32_t places = 0;
  uint32_t triangles = 0;
  vk::Image vertices;
  vk::Image corners;       // of triangles
  vk::Image phase;         // P without the forward peak, below it what is in the peak
  vk::Buffer newVertices;  // until they are uploaded
  vk::Buffer newCorners;
  vk::Buffer newPhase;
  uint64_t version = 1;  // of the vertices
  std::pmr::vector<SurfaceLight> lights;
  // The light of sky and ground on it, and what that was made of.
  SurfaceAmbientLight ambient;
  std::vector<char> ambientKey;

  // The unit box to the world.
  glm::dmat4x3 worldFromBox() const;
};

// The canonical cloud, for every surface: made where there is one.
struct SurfaceTables {
  double asymmetry = 0;
  vk::Image source;
  vk::Image curves;
  vk::Image share;  // of light of sky and ground
  // Where there is, or was, detail: its noise, and room to make cells in.
  vk::Image noise;
  vk::Buffer cells;
  vk::Buffer newSource;  // until they are uploaded
  vk::Buffer newCurves;
  vk::Buffer newShare;
  vk::Buffer newNoise;
};
SurfaceTables makeSurfaceTables(vk::Device& device);

// Texels along an edge of a surface's light map.
uint32_t surfaceMapSize(const SliceQuality& quality);
// Of all its levels together.
constexpr uint32_t surfaceMapTexels(uint32_t size) {
  uint32_t texels = 0;
  for (; size > 0; size /= 2) {
    texels += size * size;
  }
  return texels;
}
SurfaceLight makeSurfaceLight(vk::Device& device, uint32_t size, bool up);
SurfaceLight* findSurfaceLight(SurfaceState& surface, uint32_t size, bool up);

// Constants of the picture along the light: the same for every eye.
void fillSurfaceLight(const SurfaceState& surface, const glm::dvec3& toLight, uint32_t size,
                      interface_::SurfaceUniforms& out);
SurfaceLightKey surfaceLightKey(const SurfaceState& surface,
                                const interface_::SurfaceUniforms& uniforms);
// A view's eye (world), projection of positions relative to it, and size in pixels.
struct SurfaceEye {
  glm::dvec3 eye{0};
  glm::dmat4 clipFromEye{1.0};
  uint32_t width = 0;
  uint32_t height = 0;
};
// Of a view's; `shade`: the pixels of its pass.
void fillSurfaceView(const SurfaceState& surface, const PlannedVolume& planned,
                     const SurfaceEye& view, const glm::dvec3& toLight, uint32_t size,
                     const PixelRect& shade, interface_::SurfaceUniforms& out);
void fillTriangles(const SurfaceState& surface, bool mirrored, interface_::SurfaceUniforms& out);
// Workgroups of the passes over triangles, x and y.
std::array<uint32_t, 2> surfaceGroups(const interface_::SurfaceUniforms& uniforms);

}  // namespace welkin
