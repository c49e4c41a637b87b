// SPDX-License-Identifier: MIT
// Light of sky and ground on volumes: a furnace, and the path tracer of tests/reference under a
// uniform sky over black ground. Radiances are in units of the sky's.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "reference/monte_carlo.hpp"
#include "slicing_scene.hpp"

namespace {

using namespace image_test;
namespace truth = welkin::reference;

constexpr int SIZE = 24;       // pixels
constexpr int N = 32;          // voxels
constexpr double EDGE = 2000;  // m, of the box
constexpr double BASE = 5000;  // m, altitude of its underside
constexpr Point MIDDLE{0, BASE + EDGE / 2, 0};
constexpr double DISTANCE = 6000;  // m, of the eye from its middle

// A ball of radius 0.4 of the box, softened over a voxel; or the whole box in its middle half.
std::vector<float> ball() {
  std::vector<float> values;
  for (int i = 0; i < N * N * N; ++i) {
    const auto at = [](int k) { return (k + 0.5) / N - 0.5; };
    const double r = std::hypot(at(i % N), at(i / N % N), at(i / N / N));
    values.push_back(static_cast<float>(std::clamp((0.4 - r) * N + 0.5, 0.0, 1.0)));
  }
  return values;
}

std::vector<float> slab() {
  std::vector<float> values;
  for (int i = 0; i < N * N * N; ++i) {
    const int y = i / N % N;
    values.push_back(y >= N / 4 && y < 3 * N / 4 ? 1.0f : 0.0f);
  }
  return values;
}

Camera cameraAt(double elevation_deg) {
  const double e = elevation_deg * DEGREE;
  Camera camera;
  camera.position = MIDDLE + DISTANCE * Point{0, std::sin(e), std::cos(e)};
  camera.forward = {0, -std::sin(e), -std::cos(e)};
  camera.tangent = 0.24;
  return camera;
}

class AmbientLight : public ::testing::Test {
 protected:
  AmbientLight() : scene_(SIZE) {
    // Dark, but a light: it decides what counts as passing.
    auto light = welkin::make<WlkLight>();
    std::fill_n(light.irradiance, 3, 1e-6f);
    welkin::check(wlkSetLights(scene_.context(), 1, sizeof light, &light));
  }
  ~AmbientLight() override { EXPECT_TRUE(scene_.messages().empty()) << scene_.messages().front(); }

  void setLevel(uint32_t level, uint32_t scattering,
                uint32_t resolution = WLK_VOLUME_RESOLUTION_FULL) {
    Quality quality;
    quality.level = level;
    quality.scattering = scattering;
    quality.resolution = resolution;
    quality.slices = quality.lightSize = 0;  // of the level
    scene_.setQuality(quality);
  }
  void setAmbient(float sky, float ground) const {
    auto ambient = welkin::make<WlkAmbient>();
    ambient.mode = WLK_AMBIENT_GIVEN;
    std::fill_n(ambient.sky, 3, sky);
    std::fill_n(ambient.ground, 3, ground);
    welkin::check(wlkSetAmbient(scene_.context(), &ambient));
  }

  SlicingScene scene_;
};

// Light from everywhere that nothing absorbs is the same everywhere, also between rays of every
// second pixel, which the levels take.
TEST_F(AmbientLight, OfAFurnaceHidesWhatDoesNotAbsorb) {
  setAmbient(1, 1);
  struct Form {
    uint32_t level, scattering, resolution;
  };
  for (const auto& [level, scattering, resolution] :
       {Form{WLK_QUALITY_LOW, WLK_SCATTERING_ALL_ORDERS, WLK_VOLUME_RESOLUTION_DEFAULT},
        Form{WLK_QUALITY_LOW, WLK_SCATTERING_FORWARD, WLK_VOLUME_RESOLUTION_FULL},
        Form{WLK_QUALITY_HIGH, WLK_SCATTERING_ALL_ORDERS, WLK_VOLUME_RESOLUTION_DEFAULT},
        Form{WLK_QUALITY_HIGH, WLK_SCATTERING_FORWARD, WLK_VOLUME_RESOLUTION_DEFAULT}}) {
    setLevel(level, scattering, resolution);
    for (const double depth : {0.5, 5.0, 100.0}) {
      for (const double g : {0.0, 0.85}) {
        if (level == WLK_QUALITY_HIGH && g == 0) {
          continue;  // ten times the time
        }
        const WlkVolume volume = scene_.addVolume(cubeField(N, ball(), depth / EDGE, EDGE, MIDDLE),
                                                  scene_.henyeyGreenstein(g));
        double most = 0;
        for (const double elevation : {-70.0, 0.0, 35.0}) {
          scene_.setCamera(cameraAt(elevation));
          const Picture picture = scene_.render();
          EXPECT_EQ(picture.nonFinite, 0u);
          for (size_t i = 0; i < picture.radiance.size(); ++i) {
            most =
                std::max(most, std::abs(picture.radiance[i][0] + picture.transmittance[i][0] - 1));
          }
        }
        std::printf("level %u, scattering %u, depth %g, g %g: %.1e\n", level, scattering, depth, g,
                    most);
        // Single precision over some hundred steps.
        EXPECT_LT(most, 2e-4);
        scene_.removeVolume(volume);
      }
    }
  }
}

struct Errors {
  double bias;
  double rms;
};

class AmbientTruth : public AmbientLight {
 protected:
  // Against the sky over black ground.
  void expectNear(const char* name, const std::vector<float>& values, double depth, double g,
                  double elevation_deg, const Errors& bound) {
    const VoxelField field = cubeField(N, values, depth / EDGE, EDGE, MIDDLE);
    const WlkVolume volume = scene_.addVolume(field, scene_.henyeyGreenstein(g));
    const Camera camera = cameraAt(elevation_deg);
    scene_.setCamera(camera);
    const Picture picture = scene_.render();
    scene_.removeVolume(volume);
    EXPECT_EQ(picture.nonFinite, 0u);

    truth::Scene scene;
    scene.ground = true;
    scene.environment = {1, 1, 1};
    truth::ParticleField particles;
    particles.values = values;
    particles.extinctionScale = {depth / EDGE, depth / EDGE, depth / EDGE};
    particles.phase = truth::PhaseFunction::henyeyGreenstein(g);
    scene.volumes.emplace_back(std::array<int, 3>{N, N, N}, field.worldFromBox,
                               std::vector{particles});
    std::vector<truth::EyeRay> rays;
    for (int i = 0; i < SIZE * SIZE; ++i) {
      truth::EyeRay ray;
      ray.origin = camera.position;
      ray.direction = camera.ray(i % SIZE, i / SIZE, SIZE);
      rays.push_back(ray);
    }
    truth::RenderOptions options;
    options.samples = 512;
    const truth::RenderResult wanted = truth::render(scene, rays, options);
    std::vector<double> is;
    std::vector<double> shouldBe;
    double noise = 0;
    for (size_t i = 0; i < rays.size(); ++i) {
      is.push_back(picture.radiance[i][0]);
      // Behind the volume is the sky or black ground. Light that the forward peak turns a little
      // counts as passing for some forms of scattering.
      const double behind = rays[i].direction[1] > 0 ? picture.transmittance[i][0] : 0.0;
      shouldBe.push_back(wanted.pixels[i].radiance[0] - behind);
      noise += wanted.pixels[i].variance[0] / (SIZE * SIZE);
    }
    // Without the noise of the truth.
    const double square =
        std::pow(relativeRms(is, shouldBe), 2) - noise / std::pow(mean(shouldBe), 2);
    const Errors errors{mean(is) / mean(shouldBe) - 1, std::sqrt(std::max(square, 0.0))};
    std::printf("%s %g, g %g, from %+.0f deg: mean %.3f, bias %+.1f %%, rms %.1f %%\n", name, depth,
                g, elevation_deg, mean(shouldBe), 100 * errors.bias, 100 * errors.rms);
    EXPECT_NEAR(errors.bias, 0, bound.bias) << name;
    EXPECT_LT(errors.rms, bound.rms) << name;
  }
};

TEST_F(AmbientTruth, OfBallsIsThatOfPathTracing) {
  setAmbient(1, 0);
  for (const uint32_t scattering : {WLK_SCATTERING_ALL_ORDERS, WLK_SCATTERING_FORWARD}) {
    for (const uint32_t level : {WLK_QUALITY_MEDIUM}) {
      setLevel(level, scattering);
      std::printf("level %u, scattering %u\n", level, scattering);
      for (const double elevation : {-20.0, 0.0, 45.0}) {
        // From above a thin ball shows a tenth of what it shows from below, a third too much; at
        // the horizon its forward peak blurs the edge of the sky behind it.
        if (elevation < 0) {
          expectNear("ball", ball(), 2, 0.85, elevation, {0.09, 0.19});
        }
        expectNear("ball", ball(), 20, 0.85, elevation, {0.05, 0.2});
        expectNear("slab", slab(), 20, 0.5, elevation, {0.08, 0.21});
      }
    }
  }
}

}  // namespace
