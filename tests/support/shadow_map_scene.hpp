// SPDX-License-Identifier: MIT
// A map of the volumes' shadow in an image of the spied engine's, and its texels as floats.
#pragma once

#include "support/engine_scene.hpp"

namespace welkin::test {

// What a wlkVulkanCmdRenderCloudShadow recorded, by the spy and by the library.
struct ShadowFrame {
  VulkanCounts counts;
  WlkCloudShadowState state;
};

class ShadowMapScene {
 public:
  // 32-bit floats unless `half`.
  explicit ShadowMapScene(const WlkCloudShadowInfo& info, bool half = false);
  ~ShadowMapScene();
  ShadowMapScene(const ShadowMapScene&) = delete;
  ShadowMapScene& operator=(const ShadowMapScene&) = delete;

  EngineScene scene;  // without sky or volumes, the sun at the zenith
  WlkCloudShadow map{};
  WlkVulkanImage described{};
  uint32_t images = 0;  // made so far

  // A frame of its own; the image stays in GENERAL.
  ShadowFrame record();
  // Another image of the same kind from now on.
  void replaceImage();
  // 4 floats per texel; of one channel the others are 0.
  std::vector<float> read() const;

 private:
  WlkCloudShadowInfo info_;
  bool half_;
  std::optional<SpyImage> image_;
  uint64_t frame_ = 0;
};

// The world's point at (u, v, d) of a map.
std::array<double, 3> worldFromMap(const double (&mapFromWorld)[12],
                                   const std::array<double, 3>& at);

}  // namespace welkin::test
