// SPDX-License-Identifier: MIT
#include "slicing_scene.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <thread>

#include "reference/phase_reference.hpp"

namespace image_test {
namespace {

welkin::test::SceneOptions optionsOf(int size, bool validation) {
  welkin::test::SceneOptions options;
  options.validation = validation;
  options.width = static_cast<uint32_t>(size);
  options.height = options.width;
  options.composite = WLK_COMPOSITE_SEPARATE;
  return options;
}

}  // namespace

Point operator+(const Point& a, const Point& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

Point operator-(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

Point operator*(double s, const Point& a) {
  return {s * a[0], s * a[1], s * a[2]};
}

double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Point normalized(const Point& a) {
  return 1 / std::sqrt(dot(a, a)) * a;
}

Point turned(const Point& p, const Point& axis, double angle) {
  const double c = std::cos(angle);
  return c * p + std::sin(angle) * cross(axis, p) + (1 - c) * dot(axis, p) * axis;
}

Point Camera::ray(int x, int y, int size) const {
  const double u = (2 * (x + 0.5) / size - 1) * tangent;
  const double v = (1 - 2 * (y + 0.5) / size) * tangent;
  const Point r = right();
  return normalized(forward + u * r + v * cross(r, forward));
}

float Camera::depthAt(int x, int y, int size, double distance) const {
  return static_cast<float>(NEAR_PLANE / (distance * dot(ray(x, y, size), forward)));
}

std::vector<double> Picture::red() const {
  std::vector<double> values;
  values.reserve(radiance.size());
  for (const std::array<double, 3>& rgb : radiance) {
    values.push_back(rgb[0]);
  }
  return values;
}

SlicingScene::SlicingScene(int size, bool validation)
    : scene_(optionsOf(size, validation)), size_(size) {}

WlkVolume SlicingScene::addVolume(const VoxelField& field, WlkMedium medium) {
  return addVolume(std::vector{field}, std::vector{medium});
}

WlkVolume SlicingScene::addVolume(const std::vector<VoxelField>& fields,
                                  const std::vector<WlkMedium>& media) {
  std::vector<WlkVolumeField> list(fields.size());
  for (size_t i = 0; i < list.size(); ++i) {
    list[i] = {media[i], 1.0f, 0};
  }
  auto info = welkin::make<WlkVolumeInfo>();
  std::array<uint32_t, 3> size{};
  for (size_t k = 0; k < 3; ++k) {
    size[k] = static_cast<uint32_t>(fields[0].size[k]);
    info.size[k] = size[k];
  }
  info.fieldCount = static_cast<uint32_t>(list.size());
  info.fields = list.data();
  std::copy(fields[0].worldFromBox.begin(), fields[0].worldFromBox.end(), info.worldFromVolume);
  WlkVolume volume{};
  welkin::check(wlkCreateVolume(scene_.context, &info, &volume));
  for (uint32_t i = 0; i < info.fieldCount; ++i) {
    scene_.upload(volume, size, {fields[i].extinction.begin(), fields[i].extinction.end()}, i);
  }
  return volume;
}

void SlicingScene::removeVolume(WlkVolume volume) {
  welkin::check(wlkDestroyVolume(scene_.context, volume));
}

void SlicingScene::setLight(const Point& direction) {
  auto light = welkin::make<WlkLight>();
  for (size_t k = 0; k < 3; ++k) {
    light.direction[k] = static_cast<float>(direction[k]);
  }
  welkin::check(wlkSetLights(scene_.context, 1, sizeof light, &light));
}

void SlicingScene::setCamera(const Camera& camera) {
  auto c = welkin::make<WlkCamera>();
  const Point right = camera.right();
  const Point up = cross(right, camera.forward);
  for (size_t k = 0; k < 3; ++k) {
    c.position[k] = camera.position[k];
    c.viewFromWorld[3 * k] = static_cast<float>(right[k]);
    c.viewFromWorld[3 * k + 1] = static_cast<float>(up[k]);
    c.viewFromWorld[3 * k + 2] = static_cast<float>(-camera.forward[k]);
  }
  std::fill_n(c.clipFromView, 16, 0.0f);
  c.clipFromView[0] = static_cast<float>(1 / camera.tangent);
  c.clipFromView[5] = static_cast<float>(-1 / camera.tangent);
  c.clipFromView[11] = -1;
  c.clipFromView[14] = static_cast<float>(NEAR_PLANE);
  welkin::check(wlkSetCamera(scene_.context, scene_.view, &c));
}

void SlicingScene::setQuality(const Quality& quality) {
  auto q = welkin::make<WlkQuality>();
  q.level = quality.level;
  q.sliceCount = quality.slices;
  q.batchSize = quality.batch;
  q.lightBufferSize = quality.lightSize;
  q.slicing = quality.slicing;
  q.scattering = quality.scattering;
  q.volumeResolution = quality.resolution;
  q.volumeCells = quality.cells;
  welkin::check(wlkSetQuality(scene_.context, scene_.view, &q));
}

void SlicingScene::setSky(bool on) {
  on ? scene_.setSky() : scene_.clearSky();
}

void SlicingScene::setFog(double extinction) {
  auto fog = welkin::make<WlkFog>();
  fog.extinction = static_cast<float>(extinction);
  welkin::check(wlkSetFog(scene_.context, extinction > 0 ? &fog : nullptr));
}

Picture SlicingScene::render(const std::vector<float>& depth) {
  welkin::check(wlkPrepare(scene_.context));
  auto targets = welkin::make<WlkHeadlessInputs>();
  targets.depth = depth.empty() ? nullptr : depth.data();
  targets.depthSize = depth.size() * sizeof(float);
  welkin::check(wlkRenderHeadless(scene_.context, scene_.view, &targets));
  Picture picture;
  picture.size = size_;
  for (const uint32_t which : {WLK_IMAGE_RADIANCE, WLK_IMAGE_TRANSMITTANCE}) {
    const welkin::test::Image image = scene_.read(which);
    auto& out = which == WLK_IMAGE_RADIANCE ? picture.radiance : picture.transmittance;
    for (size_t i = 0; i < image.rgba.size(); i += 4) {
      out.push_back({static_cast<double>(image.rgba[i]), static_cast<double>(image.rgba[i + 1]),
                     static_cast<double>(image.rgba[i + 2])});
    }
  }
  picture.nonFinite = scene_.stats().nonFinitePixels;
  for (const WlkPassStats& pass : scene_.passes()) {
    const double ms = static_cast<double>(pass.gpuTime_ns) * 1e-6;
    picture.eye_ms += pass.pass == WLK_PASS_EYE_SLICES ? ms : 0;
    picture.light_ms += pass.pass == WLK_PASS_LIGHT_SLICES ? ms : 0;
  }
  return picture;
}

VoxelField cubeField(int n, const std::vector<float>& values, double scale, double edge,
                     const Point& centre) {
  VoxelField field;
  field.size = {n, n, n};
  for (const float v : values) {
    // Rounded as the upload rounds, so that both sides march the same numbers.
    field.extinction.push_back(
        static_cast<double>(static_cast<float>(scale * static_cast<double>(v))));
  }
  field.worldFromBox = {};
  for (size_t k = 0; k < 3; ++k) {
    field.worldFromBox[5 * k] = edge;
    field.worldFromBox[4 * k + 3] = centre[k] - edge / 2;
  }
  return field;
}

double mean(const std::vector<double>& a) {
  double sum = 0;
  for (const double x : a) {
    sum += x;
  }
  return sum / static_cast<double>(a.size());
}

double relativeRms(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (size_t i = 0; i < a.size(); ++i) {
    sum += (a[i] - b[i]) * (a[i] - b[i]);
  }
  return std::sqrt(sum / static_cast<double>(a.size())) / mean(b);
}

void parallelFor(int count, const std::function<void(int)>& task) {
  std::atomic<int> next{0};
  const auto work = [&] {
    for (int i = next++; i < count; i = next++) {
      task(i);
    }
  };
  std::vector<std::thread> threads;
  for (unsigned t = 1; t < std::thread::hardware_concurrency(); ++t) {
    threads.emplace_back(work);
  }
  work();
  for (std::thread& t : threads) {
    t.join();
  }
}

std::vector<double> marchPicture(const RayMarch& march, const Camera& camera, int size,
                                 const Point& toLight, double g, int refinement,
                                 const std::vector<double>& lengths) {
  std::vector<double> picture(static_cast<size_t>(size) * static_cast<size_t>(size));
  parallelFor(size, [&](int y) {
    for (int x = 0; x < size; ++x) {
      const auto i = static_cast<size_t>(y * size + x);
      const Point direction = camera.ray(x, y, size);
      const double length = lengths.empty() ? 1e30 : lengths[i];
      const auto phase = static_cast<double>(::reference::henyeyGreenstein(
          static_cast<long double>(g), static_cast<long double>(dot(direction, toLight))));
      picture[i] =
          phase * march.march(camera.position, direction, length, toLight, refinement).scattered;
    }
  });
  return picture;
}

}  // namespace image_test
