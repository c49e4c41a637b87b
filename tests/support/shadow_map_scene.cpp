// SPDX-License-Identifier: MIT
#include "support/shadow_map_scene.hpp"

#include <cstring>

#include "support/half_float.hpp"

namespace welkin::test {
namespace {

SceneOptions tiny() {
  SceneOptions options;
  options.width = 8;
  options.height = 8;
  return options;
}

}  // namespace

ShadowMapScene::ShadowMapScene(const WlkCloudShadowInfo& info, bool half)
    : scene(tiny()), info_(info), half_(half) {
  scene.setSun(90, 0);
  check(wlkCreateCloudShadow(scene.context, &info, &map));
  replaceImage();
}

ShadowMapScene::~ShadowMapScene() {
  check(wlkVulkanForgetImage(scene.context, image_->handle));
}

void ShadowMapScene::replaceImage() {
  if (image_) {
    check(wlkVulkanForgetImage(scene.context, image_->handle));
  }
  const bool one = info_.content == WLK_CLOUD_SHADOW_OPTICAL_DEPTH;
  const VkFormat format =
      one ? (half_ ? VK_FORMAT_R16_SFLOAT : VK_FORMAT_R32_SFLOAT)
          : (half_ ? VK_FORMAT_R16G16B16A16_SFLOAT : VK_FORMAT_R32G32B32A32_SFLOAT);
  image_.emplace(scene.device(), format, VkExtent3D{info_.width, info_.height, 1},
                 VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT |
                     VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT);
  std::memset(image_->bytes(), 0, size_t{4} * info_.width * info_.height);
  image_->write(VK_IMAGE_LAYOUT_GENERAL);
  ++images;
  described = scene.describe(*image_, VK_IMAGE_LAYOUT_GENERAL);
}

ShadowFrame ShadowMapScene::record() {
  auto info = make<WlkFrameInfo>();
  info.completedFrameIndex = frame_;
  info.frameIndex = ++frame_;
  check(wlkBeginFrame(scene.context, &info));
  ShadowFrame result;
  scene.device().run([&](VkCommandBuffer commands) {
    check(wlkVulkanCmdUpdate(scene.context, commands));
    SpyDevice::counts() = {};
    check(wlkVulkanCmdRenderCloudShadow(scene.context, commands, map, &described));
    result.counts = SpyDevice::counts();
  });
  result.state = make<WlkCloudShadowState>();
  check(wlkGetCloudShadowState(scene.context, map, &result.state));
  return result;
}

std::vector<float> ShadowMapScene::read() const {
  image_->read(VK_IMAGE_LAYOUT_GENERAL);
  const size_t texels = size_t{info_.width} * info_.height;
  const size_t channels = info_.content == WLK_CLOUD_SHADOW_OPTICAL_DEPTH ? 1 : 4;
  std::vector<float> values(4 * texels);
  const auto* bytes = static_cast<const unsigned char*>(image_->bytes());
  for (size_t i = 0; i < texels * channels; ++i) {
    float& value = values[i / channels * 4 + i % channels];
    if (half_) {
      uint16_t bits = 0;
      std::memcpy(&bits, bytes + i * sizeof bits, sizeof bits);
      value = decodedHalf(bits);
    } else {
      std::memcpy(&value, bytes + i * sizeof value, sizeof value);
    }
  }
  return values;
}

std::array<double, 3> worldFromMap(const double (&m)[12], const std::array<double, 3>& at) {
  // The rows are perpendicular: the inverse has them as columns, over their squared lengths.
  std::array<double, 3> world{};
  for (size_t row = 0; row < 3; ++row) {
    const double* r = m + 4 * row;
    const double along = (at[row] - r[3]) / (r[0] * r[0] + r[1] * r[1] + r[2] * r[2]);
    for (size_t i = 0; i < 3; ++i) {
      world[i] += along * r[i];
    }
  }
  return world;
}

}  // namespace welkin::test
