// SPDX-License-Identifier: MIT
// A small headless scene for tests: context, view, sky, sun, media and volumes in one call each,
// and the picture as floats. Failing calls throw welkin::Error, which GoogleTest reports.
#pragma once

#include <welkin/welkin.h>

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>
#include <welkin/welkin.hpp>

namespace welkin::test {

// Points the Vulkan loader at lavapipe unless the environment chose a driver already or, by
// WELKIN_ANY_DEVICE, the machine's own.
void chooseDriver();

// RGBA floats, top row first.
struct Image {
  uint32_t width = 0;
  uint32_t height = 0;
  std::vector<float> rgba;

  const float* at(uint32_t x, uint32_t y) const { return &rgba[(size_t{y} * width + x) * 4]; }
  // Mean of the three colours over all pixels.
  double mean() const;
  // Values of any channel that are NaN, infinite or below zero.
  uint64_t badValues() const;
  bool operator==(const Image& other) const;  // bit for bit
};

// RMS of the difference over the colours, divided by the mean of `truth`.
double relativeRms(const Image& image, const Image& truth);

struct SceneOptions {
  bool validation = true;  // with synchronisation validation; messages land in messages()
  bool view = true;        // make `view` at once
  uint32_t width = 32;
  uint32_t height = 24;
  uint32_t composite = WLK_COMPOSITE_COMPUTE;
  uint32_t targetFormat = WLK_TARGET_RGBA32_FLOAT;
  uint64_t layers = WLK_LAYER_ALL;
  uint32_t level = WLK_QUALITY_LOW;
  uint32_t scattering = WLK_SCATTERING_DEFAULT;
  uint64_t qualityFlags = 0;
  // Tests look at single pixels; half_resolution_test.cpp has the levels' choice.
  uint32_t volumeResolution = WLK_VOLUME_RESOLUTION_FULL;
  uint32_t volumeCells = 0;  // as WlkQuality has it: 8 take the least time
  // The library's default ambient light, of sky and ground; else none, so that volumes have the
  // light of the sun alone.
  bool ambient = false;
  uint64_t deviceMemoryLimit = 0;
  WlkAllocator allocator{};
};

// What the options ask of a view.
WlkQuality qualityOf(const SceneOptions& options);

// Row-major 3x4 of an axis-aligned box.
std::array<double, 12> boxTransform(const std::array<double, 3>& lo,
                                    const std::array<double, 3>& edges);

// What can be set in any context with a device.
class SceneBuilder {
 public:
  SceneBuilder(const SceneBuilder&) = delete;
  SceneBuilder& operator=(const SceneBuilder&) = delete;

  WlkContext context = nullptr;
  WlkView view{};

  void setSky() const;  // the default air
  // Sun at an elevation over the horizon and an azimuth from -z towards +x, irradiance 1.
  void setSun(double elevation_deg, double azimuth_deg) const;
  void setFog(float extinction, float scaleHeight) const;
  void clearSky() const;
  void clearLights() const;

  WlkMedium addMedium() const;  // the default droplets
  WlkMedium addHenyeyGreenstein(float asymmetry) const;
  // One field of `medium`, value 0 until something is uploaded.
  WlkVolume addVolume(WlkMedium medium, const std::array<uint32_t, 3>& size,
                      const std::array<double, 12>& worldFromVolume, float extinctionScale) const;
  void upload(WlkVolume volume, const std::array<uint32_t, 3>& size,
              const std::vector<float>& values, uint32_t field = 0) const;
  // A ball of density 1 with 8^3 voxels, a box of 2 km around (0, 1.5 km, -5 km): in front of the
  // default camera.
  WlkVolume addBall(float extinction) const;

  WlkView addView(const SceneOptions& options) const;
  // Eye at `position`, looking along -z turned up by `pitch_deg` and right by `yaw_deg`, the
  // aspect that of the view.
  void setCamera(const std::array<double, 3>& position, double yaw_deg, double pitch_deg) const;
  void setQuality(uint32_t level, uint64_t flags = 0) const;

  WlkFrameStats stats() const;
  std::vector<WlkPassStats> passes() const;
  const SceneOptions& options() const { return options_; }

  // Everything the context logged, validation messages included.
  const std::vector<std::string>& messages() const { return *messages_; }

 protected:
  explicit SceneBuilder(const SceneOptions& options);
  ~SceneBuilder() { wlkDestroyContext(context); }
  // Makes the context with `chained` in its chain, and the view.
  void create(const void* chained);

  SceneOptions options_;
  std::unique_ptr<std::vector<std::string>> messages_;  // a fixed address for the log callback
};

class HeadlessScene : public SceneBuilder {
 public:
  explicit HeadlessScene(const SceneOptions& options = {});

  // wlkPrepare, wlkRenderHeadless and wlkReadback.
  Image render(const WlkHeadlessInputs* targets = nullptr) const;
  Image read(uint32_t image) const;
};

}  // namespace welkin::test
