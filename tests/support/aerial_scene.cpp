// SPDX-License-Identifier: MIT
#include "support/aerial_scene.hpp"

#include <cmath>
#include <cstring>

#include "support/half_float.hpp"

namespace welkin::test {
namespace {

constexpr VkImageUsageFlags USAGE = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
constexpr double NEAR = 0.1;  // of the default camera, whose depth is reversed and infinite

SceneOptions separate(SceneOptions options) {
  options.composite = WLK_COMPOSITE_SEPARATE;
  options.targetFormat = WLK_TARGET_RGBA32_FLOAT;
  return options;
}

RayLayer layerOf(const float* radiance, const float* transmittance) {
  RayLayer layer{};
  for (size_t c = 0; c < 3; ++c) {
    layer.radiance[c] = static_cast<double>(radiance[c]);
    layer.transmittance[c] = static_cast<double>(transmittance[c]);
  }
  return layer;
}

}  // namespace

AerialScene::AerialScene(const WlkAerialPerspective& info_, const SceneOptions& options, bool half)
    : scene(separate(options)), info(info_), half_(half) {
  const VkFormat format = half ? VK_FORMAT_R16G16B16A16_SFLOAT : VK_FORMAT_R32G32B32A32_SFLOAT;
  for (size_t i = 0; i < described.size(); ++i) {
    images_.push_back(std::make_unique<SpyImage>(
        scene.device(), format, VkExtent3D{info.width, info.height, info.depth}, USAGE));
    std::memset(images_[i]->bytes(), 0, size_t{16} * info.width * info.height * info.depth);
    images_[i]->write(VK_IMAGE_LAYOUT_GENERAL);
    described[i] = scene.describe(*images_[i], VK_IMAGE_LAYOUT_GENERAL);
  }
  for (size_t i = 0; i < pictureImages_.size(); ++i) {
    picture_.push_back(std::make_unique<SpyImage>(
        scene.device(), i < 2 ? VK_FORMAT_R32G32B32A32_SFLOAT : VK_FORMAT_R32_SFLOAT,
        VkExtent3D{scene.options().width, scene.options().height, 1}, USAGE));
    std::memset(picture_[i]->bytes(), 0,
                size_t{16} * scene.options().width * scene.options().height);
    picture_[i]->write(VK_IMAGE_LAYOUT_GENERAL);
    pictureImages_[i] = scene.describe(*picture_[i], VK_IMAGE_LAYOUT_GENERAL);
  }
  check(wlkSetAerialPerspective(scene.context, scene.view, &info));
  scene.addTargets = [this](WlkVulkanViewTargets& targets) {
    targets.radiance = &pictureImages_[0];
    targets.transmittance = &pictureImages_[1];
    targets.depth = surface > 0 ? &pictureImages_[2] : nullptr;
    targets.aerialRadiance = asked ? described.data() : nullptr;
    targets.aerialTransmittance = asked ? &described[1] : nullptr;
  };
}

AerialScene::~AerialScene() {
  for (const auto* images : {&images_, &picture_}) {
    for (const auto& image : *images) {
      check(wlkVulkanForgetImage(scene.context, image->handle));
    }
  }
}

std::array<double, 3> AerialScene::direction(double x, double y) const {
  const double half = std::tan(std::acos(-1.0) / 6);  // of 60 degrees
  const double aspect = static_cast<double>(scene.options().width) / scene.options().height;
  const double right = (2 * x - 1) * half * aspect;
  const double up = (1 - 2 * y) * half;
  const double length = std::sqrt(right * right + up * up + 1);
  return {right / length, up / length, -1 / length};
}

std::array<double, 3> AerialScene::columnDirection(uint32_t x, uint32_t y) const {
  return direction((x + 0.5) / info.width, (y + 0.5) / info.height);
}

double AerialScene::sliceDistance(uint32_t slice) const {
  const double share = static_cast<double>(slice) / (info.depth - 1);
  return static_cast<double>(info.distance) * std::pow(share, static_cast<double>(info.exponent));
}

void AerialScene::writeDepth() {
  const uint32_t width = scene.options().width;
  const uint32_t height = scene.options().height;
  auto* values = static_cast<float*>(picture_[2]->bytes());
  for (uint32_t y = 0; y < height; ++y) {
    for (uint32_t x = 0; x < width; ++x) {
      const double ahead = -direction((x + 0.5) / width, (y + 0.5) / height)[2];
      values[y * width + x] = static_cast<float>(NEAR / (surface * ahead));
    }
  }
  picture_[2]->write(VK_IMAGE_LAYOUT_GENERAL);
}

FrameCounts AerialScene::render() {
  if (surface > 0) {
    writeDepth();
  }
  const FrameCounts counts = scene.renderFrame();
  picture_[0]->read(VK_IMAGE_LAYOUT_GENERAL);
  picture_[1]->read(VK_IMAGE_LAYOUT_GENERAL);
  const size_t values = size_t{4} * info.width * info.height * info.depth;
  for (size_t i = 0; i < images_.size(); ++i) {
    images_[i]->read(described[i].after.layout);
    froxels_[i].resize(values);
    for (size_t k = 0; k < values; ++k) {
      froxels_[i][k] = half_ ? decodedHalf(static_cast<const uint16_t*>(images_[i]->bytes())[k])
                             : static_cast<const float*>(images_[i]->bytes())[k];
    }
  }
  return counts;
}

RayLayer AerialScene::froxel(uint32_t x, uint32_t y, uint32_t slice) const {
  const size_t at = ((size_t{slice} * info.height + y) * info.width + x) * 4;
  return layerOf(&froxels_[0][at], &froxels_[1][at]);
}

RayLayer AerialScene::pixel(uint32_t x, uint32_t y) const {
  const size_t at = (size_t{y} * scene.options().width + x) * 4;
  return layerOf(static_cast<const float*>(picture_[0]->bytes()) + at,
                 static_cast<const float*>(picture_[1]->bytes()) + at);
}

}  // namespace welkin::test
