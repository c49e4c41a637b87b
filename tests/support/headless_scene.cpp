// SPDX-License-Identifier: MIT
#include "support/headless_scene.hpp"

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <numbers>

namespace welkin::test {
namespace {

void keepMessage(void* user, const WlkLogMessage* message) {
  if (message->id == WLK_LOG_ID_VALIDATION) {
    static_cast<std::vector<std::string>*>(user)->emplace_back(message->text);
  }
}

double radians(double degrees) {
  return degrees * std::numbers::pi / 180.0;
}

}  // namespace

void chooseDriver() {
#ifdef WELKIN_TEST_DRIVER
  constexpr int KEEP = 0;
  if (std::getenv("VK_ICD_FILENAMES") == nullptr && std::getenv("WELKIN_ANY_DEVICE") == nullptr) {
    setenv("VK_DRIVER_FILES", WELKIN_TEST_DRIVER, KEEP);
  }
#endif
}

double Image::mean() const {
  double sum = 0;
  for (size_t i = 0; i < rgba.size(); ++i) {
    sum += i % 4 == 3 ? 0.0 : static_cast<double>(rgba[i]);
  }
  return sum / (3.0 * width * height);
}

uint64_t Image::badValues() const {
  uint64_t count = 0;
  for (const float x : rgba) {
    count += std::isfinite(x) && x >= 0 ? 0u : 1u;
  }
  return count;
}

bool Image::operator==(const Image& other) const {
  return width == other.width && height == other.height &&
         std::memcmp(rgba.data(), other.rgba.data(), rgba.size() * sizeof(float)) == 0;
}

double relativeRms(const Image& image, const Image& truth) {
  double squares = 0;
  for (size_t i = 0; i < truth.rgba.size(); ++i) {
    if (i % 4 != 3) {
      const double d = static_cast<double>(image.rgba[i]) - static_cast<double>(truth.rgba[i]);
      squares += d * d;
    }
  }
  return std::sqrt(squares / (3.0 * truth.width * truth.height)) / truth.mean();
}

std::array<double, 12> boxTransform(const std::array<double, 3>& lo,
                                    const std::array<double, 3>& edges) {
  return {edges[0], 0, 0, lo[0], 0, edges[1], 0, lo[1], 0, 0, edges[2], lo[2]};
}

SceneBuilder::SceneBuilder(const SceneOptions& options)
    : options_(options), messages_(std::make_unique<std::vector<std::string>>()) {
  chooseDriver();
}

void SceneBuilder::create(const void* chained) {
  auto info = make<WlkContextInfo>();
  info.next = chained;
  info.allocator = options_.allocator;
  info.deviceMemoryLimit = options_.deviceMemoryLimit;
  info.log = keepMessage;
  info.logUser = messages_.get();
  check(wlkCreateContext(WLK_API_VERSION, &info, &context));
  if (!options_.ambient) {
    auto off = make<WlkAmbient>();
    off.mode = WLK_AMBIENT_OFF;
    check(wlkSetAmbient(context, &off));
  }
  if (options_.view) {
    view = addView(options_);
  }
}

HeadlessScene::HeadlessScene(const SceneOptions& options) : SceneBuilder(options) {
  auto headless = make<WlkHeadlessInfo>();
  headless.flags = options.validation ? uint64_t{WLK_HEADLESS_VALIDATION} : 0;
  create(&headless);
}

void SceneBuilder::setSky() const {
  const auto sky = make<WlkSky>();
  check(wlkSetSky(context, &sky));
}

void SceneBuilder::setSun(double elevation_deg, double azimuth_deg) const {
  auto light = make<WlkLight>();
  const double elevation = radians(elevation_deg);
  const double azimuth = radians(azimuth_deg);
  light.direction[0] = static_cast<float>(std::cos(elevation) * std::sin(azimuth));
  light.direction[1] = static_cast<float>(std::sin(elevation));
  light.direction[2] = static_cast<float>(-std::cos(elevation) * std::cos(azimuth));
  check(wlkSetLights(context, 1, sizeof light, &light));
}

void SceneBuilder::setFog(float extinction, float scaleHeight) const {
  auto fog = make<WlkFog>();
  fog.extinction = extinction;
  fog.scaleHeight = scaleHeight;
  check(wlkSetFog(context, &fog));
}

void SceneBuilder::clearSky() const {
  check(wlkSetSky(context, nullptr));
}

void SceneBuilder::clearLights() const {
  check(wlkSetLights(context, 0, 0, nullptr));
}

WlkMedium SceneBuilder::addMedium() const {
  const auto info = make<WlkMediumInfo>();
  WlkMedium medium{};
  check(wlkCreateMedium(context, &info, &medium));
  return medium;
}

WlkMedium SceneBuilder::addHenyeyGreenstein(float asymmetry) const {
  auto info = make<WlkMediumInfo>();
  info.particle = WLK_PARTICLE_HENYEY_GREENSTEIN;
  info.asymmetry = asymmetry;
  WlkMedium medium{};
  check(wlkCreateMedium(context, &info, &medium));
  return medium;
}

WlkVolume SceneBuilder::addVolume(WlkMedium medium, const std::array<uint32_t, 3>& size,
                                  const std::array<double, 12>& worldFromVolume,
                                  float extinctionScale) const {
  WlkVolumeField field{};
  field.medium = medium;
  field.extinctionScale = extinctionScale;
  auto info = make<WlkVolumeInfo>();
  std::memcpy(info.size, size.data(), sizeof info.size);
  info.fieldCount = 1;
  info.fields = &field;
  std::memcpy(info.worldFromVolume, worldFromVolume.data(), sizeof info.worldFromVolume);
  WlkVolume volume{};
  check(wlkCreateVolume(context, &info, &volume));
  return volume;
}

void SceneBuilder::upload(WlkVolume volume, const std::array<uint32_t, 3>& size,
                          const std::vector<float>& values, uint32_t field) const {
  auto upload = make<WlkVolumeUpload>();
  upload.field = field;
  std::memcpy(upload.extent, size.data(), sizeof upload.extent);
  upload.data = values.data();
  upload.dataSize = values.size() * sizeof(float);
  check(wlkUploadVolume(context, volume, &upload));
}

WlkVolume SceneBuilder::addBall(float extinction) const {
  constexpr uint32_t N = 8;
  std::vector<float> values;
  for (uint32_t i = 0; i < N * N * N; ++i) {
    const std::array<uint32_t, 3> voxel{i % N, i / N % N, i / (N * N)};
    double squares = 0;
    for (const uint32_t c : voxel) {
      const double x = (c + 0.5) / N - 0.5;
      squares += x * x;
    }
    values.push_back(squares < 0.4 * 0.4 ? 1.0f : 0.0f);
  }
  const WlkVolume volume = addVolume(
      addMedium(), {N, N, N}, boxTransform({-1000, 500, -6000}, {2000, 2000, 2000}), extinction);
  upload(volume, {N, N, N}, values);
  return volume;
}

WlkQuality qualityOf(const SceneOptions& options) {
  auto quality = make<WlkQuality>();
  quality.level = options.level;
  quality.scattering = options.scattering;
  quality.volumeResolution = options.volumeResolution;
  quality.volumeCells = options.volumeCells;
  quality.flags = options.qualityFlags;
  return quality;
}

WlkView SceneBuilder::addView(const SceneOptions& options) const {
  auto info = make<WlkViewInfo>();
  info.width = options.width;
  info.height = options.height;
  info.composite = options.composite;
  info.layers = options.layers;
  info.targetFormat = options.targetFormat;
  WlkView made{};
  check(wlkCreateView(context, &info, &made));
  const WlkQuality quality = qualityOf(options);
  check(wlkSetQuality(context, made, &quality));
  return made;
}

void SceneBuilder::setCamera(const std::array<double, 3>& position, double yaw_deg,
                             double pitch_deg) const {
  auto camera = make<WlkCamera>();
  std::memcpy(camera.position, position.data(), sizeof camera.position);
  const double cy = std::cos(radians(yaw_deg));
  const double sy = std::sin(radians(yaw_deg));
  const double cp = std::cos(radians(pitch_deg));
  const double sp = std::sin(radians(pitch_deg));
  // Rows of viewFromWorld are the view's right, up and back in the world.
  const double rows[3][3] = {{cy, 0, sy}, {-sp * sy, cp, sp * cy}, {-cp * sy, -sp, cp * cy}};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      camera.viewFromWorld[3 * column + row] = static_cast<float>(rows[row][column]);
    }
  }
  camera.clipFromView[0] = -camera.clipFromView[5] * static_cast<float>(options_.height) /
                           static_cast<float>(options_.width);
  check(wlkSetCamera(context, view, &camera));
}

void SceneBuilder::setQuality(uint32_t level, uint64_t flags) const {
  WlkQuality quality = qualityOf(options_);
  quality.level = level;
  quality.flags = flags;
  check(wlkSetQuality(context, view, &quality));
}

Image HeadlessScene::render(const WlkHeadlessInputs* targets) const {
  check(wlkPrepare(context));
  check(wlkRenderHeadless(context, view, targets));
  return read(options_.composite == WLK_COMPOSITE_SEPARATE ? WLK_IMAGE_RADIANCE : WLK_IMAGE_COLOR);
}

Image HeadlessScene::read(uint32_t image) const {
  Image result{options_.width, options_.height, {}};
  result.rgba.resize(size_t{options_.width} * options_.height * 4);
  auto data = make<WlkImageData>();
  data.image = image;
  data.data = result.rgba.data();
  data.dataSize = result.rgba.size() * sizeof(float);
  const WlkResult code = check(wlkReadback(context, view, &data));
  if (code != WLK_SUCCESS) {
    throw std::runtime_error(std::string("wlkReadback returned ") + wlkResultName(code));
  }
  return result;
}

WlkFrameStats SceneBuilder::stats() const {
  auto stats = make<WlkFrameStats>();
  uint32_t count = 0;
  check(wlkGetFrameStats(context, view, &stats, &count, sizeof(WlkPassStats), nullptr));
  return stats;
}

std::vector<WlkPassStats> SceneBuilder::passes() const {
  auto stats = make<WlkFrameStats>();
  uint32_t count = 0;
  check(wlkGetFrameStats(context, view, &stats, &count, sizeof(WlkPassStats), nullptr));
  std::vector<WlkPassStats> passes(count);
  check(wlkGetFrameStats(context, view, &stats, &count, sizeof(WlkPassStats), passes.data()));
  return passes;
}

}  // namespace welkin::test
