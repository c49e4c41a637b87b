// SPDX-License-Identifier: MIT
// Cloud surfaces for tests: closed meshes handed to a context.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <glm/glm.hpp>

#include "support/closed_meshes.hpp"
#include "support/headless_scene.hpp"

namespace welkin::test {

// What wlkCreateSurface wants of a mesh.
struct SurfaceArrays {
  explicit SurfaceArrays(const support::ClosedMesh& mesh) {
    for (const glm::dvec3& p : mesh.position) {
      for (int i = 0; i < 3; ++i) {
        positions.push_back(static_cast<float>(p[i]));
      }
    }
    for (const auto& triangle : mesh.triangle) {
      indices.insert(indices.end(), triangle.begin(), triangle.end());
    }
  }
  WlkSurfaceInfo info(WlkMedium medium, float extinction) const {
    auto info = make<WlkSurfaceInfo>();
    info.medium = medium;
    info.extinction = extinction;
    info.vertexCount = static_cast<uint32_t>(positions.size() / 3);
    info.triangleCount = static_cast<uint32_t>(indices.size() / 3);
    info.positions = positions.data();
    info.indices = indices.data();
    return info;
  }
  std::vector<float> positions;
  std::vector<uint32_t> indices;
};

// New places of a mesh's vertices: its own times `scale`.
inline void setScaledPositions(const SceneBuilder& scene, WlkSurface surface,
                               const support::ClosedMesh& mesh, float scale) {
  SurfaceArrays arrays(mesh);
  for (float& x : arrays.positions) {
    x *= scale;
  }
  check(wlkSetSurfacePositions(scene.context, surface, arrays.positions.data(),
                               static_cast<uint32_t>(arrays.positions.size() / 3), 12));
}

// Unit vector of a pixel of the camera that looks along -z.
inline glm::dvec3 pixelDirection(const SceneBuilder& scene, uint32_t x, uint32_t y) {
  const auto camera = make<WlkCamera>();
  const double focus = std::abs(static_cast<double>(camera.clipFromView[5]));
  const double aspect = double(scene.options().width) / scene.options().height;
  const double u = 2 * (x + 0.5) / scene.options().width - 1;
  const double v = 1 - 2 * (y + 0.5) / scene.options().height;
  return glm::normalize(glm::dvec3(u * aspect / focus, v / focus, -1));
}

// What the latest frame's light pass of surfaces did.
inline WlkPassStats surfaceLightPass(const SceneBuilder& scene) {
  for (const WlkPassStats& one : scene.passes()) {
    if (one.pass == WLK_PASS_SURFACE_LIGHT) {
      return one;
    }
  }
  ADD_FAILURE() << "no such pass";
  return {};
}

// Scaled along the axes, then moved.
inline void place(WlkSurfaceInfo& info, const std::array<double, 3>& scale,
                  const std::array<double, 3>& middle) {
  for (size_t i = 0; i < 3; ++i) {
    info.worldFromSurface[5 * i] = scale[i];
    info.worldFromSurface[4 * i + 3] = middle[i];
  }
}

inline WlkSurface addSurface(const SceneBuilder& scene, const support::ClosedMesh& mesh,
                             WlkMedium medium, float extinction, const std::array<double, 3>& scale,
                             const std::array<double, 3>& middle) {
  const SurfaceArrays arrays(mesh);
  WlkSurfaceInfo info = arrays.info(medium, extinction);
  place(info, scale, middle);
  WlkSurface surface{};
  check(wlkCreateSurface(scene.context, &info, &surface));
  return surface;
}

}  // namespace welkin::test
