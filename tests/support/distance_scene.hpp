// SPDX-License-Identifier: MIT
// The volumes' distance in an image of the spied engine's, beside a square picture that looks along
// -z from the origin.
#pragma once

#include <array>

#include "support/engine_scene.hpp"

namespace welkin::test {

class DistanceScene {
 public:
  static constexpr uint32_t SIZE = 24;
  static constexpr uint32_t SLABS = 64;

  explicit DistanceScene(VkFormat format = VK_FORMAT_R32G32_SFLOAT);
  ~DistanceScene();
  DistanceScene(const DistanceScene&) = delete;
  DistanceScene& operator=(const DistanceScene&) = delete;

  EngineScene scene;  // without sky or volumes
  WlkVulkanImage described{};
  bool asked = true;  // frames get the image
  double wall = 0;    // distance of an opaque surface from the eye, m; 0: none

  // SLABS slabs of the settings given; wlkPrepare.
  void setQuality(uint32_t batchSize, const WlkQuality& settings = make<WlkQuality>()) const;
  FrameCounts render();
  // Distance and part hidden, of floats.
  std::array<double, 2> at(uint32_t pixel) const;
  const void* bytes() const { return image_.bytes(); }
  static std::array<double, 3> direction(uint32_t pixel);

 private:
  void writeWall();
  SpyImage image_;
  SpyImage depth_;
  WlkVulkanImage depthDescribed_{};
};

}  // namespace welkin::test
