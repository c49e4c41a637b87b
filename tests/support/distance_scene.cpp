// SPDX-License-Identifier: MIT
#include "support/distance_scene.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

namespace welkin::test {
namespace {

constexpr double NEAR = 0.1;  // of the default camera, whose depth is reversed and infinite

SceneOptions square() {
  SceneOptions options;
  options.width = options.height = DistanceScene::SIZE;
  // The eye stands on the ground, under which the volumes reach.
  options.layers = WLK_LAYER_ALL & ~uint64_t{WLK_LAYER_GROUND};
  return options;
}

}  // namespace

DistanceScene::DistanceScene(VkFormat format)
    : scene(square()),
      image_(scene.device(), format, {SIZE, SIZE, 1}, VK_IMAGE_USAGE_STORAGE_BIT),
      depth_(scene.device(), VK_FORMAT_R32_SFLOAT, {SIZE, SIZE, 1}, VK_IMAGE_USAGE_SAMPLED_BIT) {
  // Nothing that a frame may leave as it is: 0.01 m.
  std::memset(image_.bytes(), 0x3c, size_t{16} * SIZE * SIZE);
  image_.write(VK_IMAGE_LAYOUT_GENERAL);
  described = scene.describe(image_, VK_IMAGE_LAYOUT_GENERAL);
  depthDescribed_ = scene.describe(depth_, VK_IMAGE_LAYOUT_GENERAL);
  scene.setCamera({0, 0, 0}, 0, 0);
  check(wlkSetVolumeDistance(scene.context, scene.view, 1));
  scene.addTargets = [this](WlkVulkanViewTargets& targets) {
    targets.volumeDistance = asked ? &described : nullptr;
    targets.depth = wall > 0 ? &depthDescribed_ : nullptr;
  };
}

DistanceScene::~DistanceScene() {
  EXPECT_TRUE(scene.device().messages().empty()) << scene.device().messages().front();
  check(wlkVulkanForgetImage(scene.context, image_.handle));
  check(wlkVulkanForgetImage(scene.context, depth_.handle));
}

void DistanceScene::setQuality(uint32_t batchSize, const WlkQuality& settings) const {
  WlkQuality quality = settings;
  quality.sliceCount = SLABS;
  quality.batchSize = batchSize;
  if (quality.volumeResolution == WLK_VOLUME_RESOLUTION_DEFAULT) {
    quality.volumeResolution = WLK_VOLUME_RESOLUTION_FULL;  // single pixels are looked at
  }
  check(wlkSetQuality(scene.context, scene.view, &quality));
  check(wlkPrepare(scene.context));
}

void DistanceScene::writeWall() {
  auto* values = static_cast<float*>(depth_.bytes());
  for (uint32_t i = 0; i < SIZE * SIZE; ++i) {
    values[i] = static_cast<float>(-NEAR / (wall * direction(i)[2]));
  }
  depth_.write(VK_IMAGE_LAYOUT_GENERAL);
}

FrameCounts DistanceScene::render() {
  if (wall > 0) {
    writeWall();
  }
  const FrameCounts counts = scene.renderFrame();
  image_.read(VK_IMAGE_LAYOUT_GENERAL);
  return counts;
}

std::array<double, 2> DistanceScene::at(uint32_t pixel) const {
  const auto* values = static_cast<const float*>(image_.bytes());
  return {static_cast<double>(values[2 * pixel]), static_cast<double>(values[2 * pixel + 1])};
}

std::array<double, 3> DistanceScene::direction(uint32_t pixel) {
  const double half = std::tan(std::acos(-1.0) / 6);  // of the camera's 60 degrees
  const double right = (2 * (pixel % SIZE + 0.5) / SIZE - 1) * half;
  const double up = (1 - 2 * (pixel / SIZE + 0.5) / SIZE) * half;
  const double length = std::sqrt(right * right + up * up + 1);
  return {right / length, up / length, -1 / length};
}

}  // namespace welkin::test
