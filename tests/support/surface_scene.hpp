// SPDX-License-Identifier: MIT
// Cloud surfaces for tests: closed meshes handed to a context.
#pragma once

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
