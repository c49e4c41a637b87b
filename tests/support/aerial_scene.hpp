// SPDX-License-Identifier: MIT
// Aerial perspective in images of the spied engine's, beside the picture of the same view with an
// opaque surface all around the eye.
#pragma once

#include "support/engine_scene.hpp"

namespace welkin::test {

// Radiance and transmittance of one ray, RGB.
struct RayLayer {
  std::array<double, 3> radiance;
  std::array<double, 3> transmittance;
};

class AerialScene {
 public:
  // The view is composited SEPARATE. 32-bit floats unless `half`.
  explicit AerialScene(const WlkAerialPerspective& info, const SceneOptions& options = {},
                       bool half = false);
  ~AerialScene();
  AerialScene(const AerialScene&) = delete;
  AerialScene& operator=(const AerialScene&) = delete;

  EngineScene scene;  // without sky or volumes
  WlkAerialPerspective info;
  std::array<WlkVulkanImage, 2> described;  // radiance, transmittance
  bool asked = true;                        // frames get the images
  // From the eye to the surface, m; 0: there is none.
  double surface = 0;

  // A frame; everything it wrote is read back.
  FrameCounts render();
  RayLayer froxel(uint32_t x, uint32_t y, uint32_t slice) const;
  RayLayer pixel(uint32_t x, uint32_t y) const;
  double sliceDistance(uint32_t slice) const;
  // Unit direction of a column's middle, or of a pixel's, in the view.
  std::array<double, 3> direction(double x, double y) const;  // of the picture, [0, 1]
  std::array<double, 3> columnDirection(uint32_t x, uint32_t y) const;
  const std::vector<float>& texels(size_t image) const { return froxels_[image]; }

 private:
  void writeDepth();
  bool half_;
  std::vector<std::unique_ptr<SpyImage>> images_;   // of the froxels
  std::vector<std::unique_ptr<SpyImage>> picture_;  // radiance, transmittance, depth
  std::array<WlkVulkanImage, 3> pictureImages_;
  std::array<std::vector<float>, 2> froxels_;  // 4 floats per texel
};

}  // namespace welkin::test
