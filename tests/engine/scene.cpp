// SPDX-License-Identifier: MIT
#include "scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace engine {
namespace {

using welkin::check;
using welkin::make;

constexpr double NEAR = 2.0;     // m
constexpr double FAR = 20000.0;  // m
constexpr double PITCH = 0.12;   // rad
constexpr double YAW = 0.2;      // rad

// Device depth = first + second / view depth.
std::pair<double, double> depthTerms(const CameraCase& camera) {
  if (camera.infinite) {
    return camera.reversed ? std::pair{0.0, NEAR} : std::pair{1.0, -NEAR};
  }
  const double range = FAR - NEAR;
  return camera.reversed ? std::pair{-NEAR / range, FAR * NEAR / range}
                         : std::pair{FAR / range, -FAR * NEAR / range};
}

welkin::Context makeHeadless() {
  const auto headless = make<WlkHeadlessInfo>();
  auto info = make<WlkContextInfo>();
  info.next = &headless;
  return welkin::Context(info);
}

}  // namespace

WlkCamera cameraOf(const CameraCase& camera, uint32_t width, uint32_t height) {
  auto value = make<WlkCamera>();
  value.position[0] = 30.0;
  value.position[1] = 60.0;
  value.position[2] = 10.0;
  const double sy = std::sin(YAW);
  const double cy = std::cos(YAW);
  const double sp = std::sin(PITCH);
  const double cp = std::cos(PITCH);
  const double sign = camera.leftHanded ? 1.0 : -1.0;  // view z of what lies in front
  const std::array<std::array<double, 3>, 3> rows{
      {{cy, 0.0, -sy}, {sy * sp, cp, cy * sp}, {-sy * cp * sign, sp * sign, -cy * cp * sign}}};
  for (size_t row = 0; row < 3; ++row) {
    for (size_t column = 0; column < 3; ++column) {
      value.viewFromWorld[3 * column + row] = static_cast<float>(rows[row][column]);
    }
  }
  const double scale = 1.0 / std::tan(0.5);
  const double aspect = static_cast<double>(width) / height;
  const auto [first, second] = depthTerms(camera);
  std::fill(std::begin(value.clipFromView), std::end(value.clipFromView), 0.0f);
  value.clipFromView[0] = static_cast<float>((camera.mirrorX ? -1.0 : 1.0) * scale / aspect);
  value.clipFromView[5] = static_cast<float>((camera.flipY ? 1.0 : -1.0) * scale);
  value.clipFromView[10] = static_cast<float>(first * sign);
  value.clipFromView[11] = static_cast<float>(sign);
  value.clipFromView[14] = static_cast<float>(second);
  return value;
}

std::vector<float> EnginePicture::depth(const CameraCase& camera) const {
  const auto [first, second] = depthTerms(camera);
  std::vector<float> values;
  for (const double z : viewDepth) {
    const double d = std::isfinite(z) ? first + second / z : (camera.reversed ? 0.0 : 1.0);
    values.push_back(static_cast<float>(std::clamp(d, 0.0, 1.0)));
  }
  return values;
}

// Left third: nothing. The rest: from 5 km in the top row to 50 m in the bottom row, all of it
// above the ground; some stands before the cloud, some inside, some behind.
EnginePicture makeEnginePicture(uint32_t width, uint32_t height, const CameraCase& camera) {
  EnginePicture picture{width, height, {}, {}};
  for (uint32_t j = 0; j < height; ++j) {
    for (uint32_t i = 0; i < width; ++i) {
      const uint32_t x = camera.mirrorX ? width - 1 - i : i;
      const uint32_t y = camera.flipY ? height - 1 - j : j;
      const float u = static_cast<float>(x) / static_cast<float>(width);
      const float v = static_cast<float>(y) / static_cast<float>(height);
      picture.color.insert(picture.color.end(),
                           {2.0f * u, 0.5f + v, 3.0f * u * v, 0.25f + 0.5f * u});
      picture.viewDepth.push_back(u < 1.0f / 3.0f
                                      ? std::numeric_limits<double>::infinity()
                                      : 50.0 * std::pow(100.0, 1.0 - static_cast<double>(v)));
    }
  }
  return picture;
}

std::vector<float> turned(const std::vector<float>& rgba, uint32_t width,
                          const CameraCase& camera) {
  const size_t height = rgba.size() / (size_t{4} * width);
  std::vector<float> result(rgba.size());
  for (size_t j = 0; j < height; ++j) {
    for (size_t i = 0; i < width; ++i) {
      const size_t x = camera.mirrorX ? width - 1 - i : i;
      const size_t y = camera.flipY ? height - 1 - j : j;
      std::copy_n(&rgba[4 * (y * width + x)], 4, &result[4 * (j * width + i)]);
    }
  }
  return result;
}

std::vector<float> cloudValues() {
  std::vector<float> values;
  for (uint32_t k = 0; k < CLOUD_SIZE; ++k) {
    for (uint32_t j = 0; j < CLOUD_SIZE; ++j) {
      for (uint32_t i = 0; i < CLOUD_SIZE; ++i) {
        const double x = (i + 0.5) / CLOUD_SIZE - 0.5;
        const double y = (j + 0.5) / CLOUD_SIZE - 0.5;
        const double z = (k + 0.5) / CLOUD_SIZE - 0.5;
        const double r = std::sqrt(x * x + 1.5 * y * y + z * z) + 0.1 * x * std::sin(9.0 * z);
        // Steps of 1/16: exact in every format but the 8-bit one.
        values.push_back(
            static_cast<float>(std::round(16.0 * std::clamp(1.8 - 5.0 * r, 0.0, 1.0)) / 16.0));
      }
    }
  }
  return values;
}

void uploadCloud(WlkContext context, WlkVolume cloud, const std::vector<float>& values) {
  auto upload = make<WlkVolumeUpload>();
  std::fill(std::begin(upload.extent), std::end(upload.extent), CLOUD_SIZE);
  upload.data = values.data();
  upload.dataSize = values.size() * sizeof(float);
  check(wlkUploadVolume(context, cloud, &upload));
}

Scene makeScene(WlkContext context, bool upload) {
  const auto sky = make<WlkSky>();
  check(wlkSetSky(context, &sky));
  auto fog = make<WlkFog>();
  fog.extinction = 2e-4f;
  check(wlkSetFog(context, &fog));
  auto sun = make<WlkLight>();
  sun.direction[0] = 0.48f;
  sun.direction[1] = 0.6f;
  sun.direction[2] = -0.64f;
  std::fill(std::begin(sun.irradiance), std::end(sun.irradiance), 10.0f);
  check(wlkSetLights(context, 1, sizeof sun, &sun));

  Scene scene;
  scene.medium = welkin::Medium(context, make<WlkMediumInfo>());
  WlkVolumeField field{};
  field.medium = scene.medium;
  field.extinctionScale = 0.01f;
  auto info = make<WlkVolumeInfo>();
  std::fill(std::begin(info.size), std::end(info.size), CLOUD_SIZE);
  info.fieldCount = 1;
  info.fields = &field;
  constexpr std::array<double, 12> worldFromVolume{600, 0, 0, -400, 0, 400, 0, 0, 0, 0, 600, -1200};
  std::copy(worldFromVolume.begin(), worldFromVolume.end(), info.worldFromVolume);
  scene.cloud = welkin::Volume(context, info);
  if (upload) {
    uploadCloud(context, scene.cloud, cloudValues());
  }
  return scene;
}

void setQuality(WlkContext context, WlkView view, uint64_t flags) {
  auto quality = make<WlkQuality>();
  quality.flags = flags;
  quality.level = WLK_QUALITY_LOW;
  quality.sliceCount = 24;
  quality.batchSize = 8;
  quality.lightBufferSize = 32;
  check(wlkSetQuality(context, view, &quality));
}

Headless::Headless(uint32_t width, uint32_t height, uint64_t qualityFlags)
    : width_(width), height_(height), context_(makeHeadless()), scene_(makeScene(context_)) {
  auto info = make<WlkViewInfo>();
  info.width = width;
  info.height = height;
  view_ = welkin::View(context_, info);
  setQuality(context_, view_, qualityFlags);
  check(wlkPrepare(context_));
}

std::vector<float> Headless::render(const WlkCamera& camera, const std::vector<float>& color,
                                    const std::vector<float>& depth,
                                    const WlkHeadlessInputs* shadow) {
  check(wlkSetCamera(context_, view_, &camera));
  auto targets = shadow != nullptr ? *shadow : make<WlkHeadlessInputs>();
  targets.color = color.empty() ? nullptr : color.data();
  targets.colorSize = color.size() * sizeof(float);
  targets.depth = depth.empty() ? nullptr : depth.data();
  targets.depthSize = depth.size() * sizeof(float);
  check(wlkRenderHeadless(context_, view_, &targets));
  std::vector<float> pixels(size_t{4} * width_ * height_);
  auto image = make<WlkImageData>();
  image.data = pixels.data();
  image.dataSize = pixels.size() * sizeof(float);
  check(wlkReadback(context_, view_, &image));
  return pixels;
}

}  // namespace engine
