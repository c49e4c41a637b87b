// SPDX-License-Identifier: MIT
// A cloud in hazy air: every slab has its own share of air before it and its own sunlight. The
// cloud is marched by the reference, the air asked point by point through the CPU queries.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "cloud_scene.hpp"
#include "reference/phase_reference.hpp"

namespace {

using namespace image_test;
using welkin::reference::MarchNode;
using Rgb = std::array<double, 3>;

constexpr int SIZE = 24;
constexpr int STATIONS = 33;  // along a ray through the box; linear between: 1e-4 of what varies
constexpr double SCALE = 10;  // the cloud is 6.4 km wide, 15 km away

struct Station {
  Rgb radiance;
  Rgb transmittance;
  Rgb light;
};

class AirReference {
 public:
  AirReference(WlkContext context, const VoxelField& field, const Camera& camera)
      : context_(context), march_(field), camera_(camera) {}

  Rgb pixel(int x, int y, const Point& toLight) const {
    const Point view = camera_.ray(x, y, SIZE);
    const double phase = static_cast<double>(::reference::henyeyGreenstein(
        static_cast<long double>(CLOUD_G), static_cast<long double>(dot(view, toLight))));
    std::vector<MarchNode> nodes;
    march_.nodes(camera_.position, view, 1e30, toLight, 1, nodes);
    const Station far = stationAt(view, 1e9);
    Rgb sum{};
    double hidden = 0;
    if (!nodes.empty()) {
      const double begin = nodes.front().distance;
      const double step = (nodes.back().distance - begin) / (STATIONS - 1);
      std::vector<Station> stations;
      for (int i = 0; i < STATIONS; ++i) {
        stations.push_back(stationAt(view, begin + i * step));
      }
      for (const MarchNode& node : nodes) {
        const double u = std::clamp((node.distance - begin) / step, 0.0, STATIONS - 1.0);
        const auto i = static_cast<size_t>(std::min(std::floor(u), STATIONS - 2.0));
        const double f = u - static_cast<double>(i);
        for (size_t c = 0; c < 3; ++c) {
          const auto mix = [&](Rgb Station::*what) {
            return (1 - f) * (stations[i].*what)[c] + f * (stations[i + 1].*what)[c];
          };
          // Light scattered by the cloud on its way through the air, and air before the cloud.
          sum[c] += node.absorbed * (phase * std::exp(-node.lightDepth) * mix(&Station::light) *
                                         mix(&Station::transmittance) +
                                     mix(&Station::radiance));
        }
        hidden += node.absorbed;
      }
    }
    for (size_t c = 0; c < 3; ++c) {
      sum[c] += (1 - hidden) * far.radiance[c];
    }
    return sum;
  }

 private:
  Station stationAt(const Point& view, double distance) const {
    WlkRay ray{};
    auto batch = welkin::make<WlkRayBatch>();
    batch.count = 1;
    batch.rays = &ray;
    batch.maxOrder = 1;
    Point there{};
    for (size_t k = 0; k < 3; ++k) {
      ray.origin[k] = camera_.position[k];
      ray.direction[k] = view[k];
      there[k] = camera_.position[k] + std::min(distance, 1e5) * view[k];
    }
    ray.length = distance;
    Station station{};
    welkin::check(
        wlkEvalSky(context_, &batch, station.radiance.data(), station.transmittance.data()));
    welkin::check(wlkEvalLight(context_, 0, there.data(), station.light.data()));
    return station;
  }

  WlkContext context_;
  RayMarch march_;
  Camera camera_;
};

TEST(AerialPerspective, FollowsTheCloudSlabBySlab) {
  constexpr double BOUND = 0.005;  // slicing of a thin cloud 0.2 %, air between 5 nodes 0.3 %
  VoxelField field = noiseCloudField();
  const Point centre{0, 6000, -15000};
  for (double& x : field.extinction) {
    x /= 2 * SCALE;  // thin enough for its far side to be seen
  }
  for (size_t k = 0; k < 3; ++k) {
    field.worldFromBox[5 * k] *= SCALE;
    field.worldFromBox[4 * k + 3] = centre[k] - SCALE * CLOUD_EDGE / 2;
  }
  Camera camera = cloudCamera();
  camera.position = {0, 6000, 0};
  SlicingScene scene(SIZE);
  scene.addVolume(field, scene.henyeyGreenstein(CLOUD_G));
  scene.setCamera(camera);
  scene.setQuality({});
  scene.setSky(true);
  auto planet = welkin::make<WlkPlanet>();
  std::fill_n(planet.groundAlbedo, 3, 0.0f);
  welkin::check(wlkSetPlanet(scene.context(), &planet));
  const AirReference reference(scene.context(), field, camera);
  for (const double angle : {40.0, 100.0, 165.0}) {
    const Point light = lightAtAngle(angle);
    scene.setLight(light);
    for (const bool fog : {false, true}) {
      auto layer = welkin::make<WlkFog>();
      layer.extinction = 2e-5f;
      layer.scaleHeight = 3000;
      layer.phaseModel = WLK_PHASE_ANALYTIC;
      welkin::check(wlkSetFog(scene.context(), fog ? &layer : nullptr));
      const Picture picture = scene.render();
      std::printf("cloud 15 km off, light at %3.0f, %s:", angle, fog ? "air and haze" : "air");
      std::vector<Rgb> expected;
      for (int i = 0; i < SIZE * SIZE; ++i) {
        expected.push_back(reference.pixel(i % SIZE, i / SIZE, light));
      }
      for (size_t c = 0; c < 3; ++c) {
        std::vector<double> truth;
        std::vector<double> value;
        for (size_t i = 0; i < expected.size(); ++i) {
          truth.push_back(expected[i][c]);
          value.push_back(picture.radiance[i][c]);
        }
        const double error = relativeRms(value, truth);
        std::printf(" %.2f %% (%+.2f %%)", 100 * error, 100 * (mean(value) / mean(truth) - 1));
        EXPECT_LE(error, BOUND) << angle << fog << c;
      }
      std::printf("\n");
    }
  }
}

}  // namespace
