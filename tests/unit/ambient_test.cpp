// SPDX-License-Identifier: MIT
// wlkEvalAmbient against Monte Carlo over all directions. Errors are parts of the first
// coefficient.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "reference/monte_carlo.hpp"
#include "welkin/welkin.h"

namespace {

namespace ref = welkin::reference;

constexpr double PI = 3.14159265358979323846;
constexpr size_t HARMONICS = WLK_AMBIENT_VALUES / 3;
using Coefficients = std::array<double, WLK_AMBIENT_VALUES>;

struct Context {
  Context() {
    WlkContextInfo info;
    wlkInitStruct(WLK_STRUCT_CONTEXT_INFO, sizeof info, &info);
    EXPECT_EQ(wlkCreateContext(WLK_API_VERSION, &info, &handle), WLK_SUCCESS);
    WlkPlanet planet;
    wlkInitStruct(WLK_STRUCT_PLANET, sizeof planet, &planet);
    for (float& one : planet.groundAlbedo) {
      one = 0.25F;
    }
    EXPECT_EQ(wlkSetPlanet(handle, &planet), WLK_SUCCESS);
    radius = planet.radius;
  }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  ~Context() { wlkDestroyContext(handle); }

  WlkSky setSky() const {
    WlkSky sky;
    wlkInitStruct(WLK_STRUCT_SKY, sizeof sky, &sky);
    EXPECT_EQ(wlkSetSky(handle, &sky), WLK_SUCCESS);
    return sky;
  }
  void setSun(const std::array<double, 3>& direction) const {
    WlkLight light;
    wlkInitStruct(WLK_STRUCT_LIGHT, sizeof light, &light);
    for (size_t i = 0; i < 3; ++i) {
      light.direction[i] = static_cast<float>(direction[i]);
      light.irradiance[i] = 1;
    }
    light.angularDiameter = 0;
    EXPECT_EQ(wlkSetLights(handle, 1, sizeof light, &light), WLK_SUCCESS);
  }
  Coefficients ambientAt(double altitude) const {
    const double position[3] = {0, altitude, 0};
    Coefficients values{};
    EXPECT_EQ(wlkEvalAmbient(handle, position, values.data()), WLK_SUCCESS);
    return values;
  }

  WlkContext handle = nullptr;
  double radius = 0;
};

std::array<double, HARMONICS> harmonicsOf(const std::array<double, 3>& w) {
  const auto [x, y, z] = w;
  const double a = std::sqrt(3 / (4 * PI));
  const double b = std::sqrt(15 / (4 * PI));
  return {std::sqrt(1 / (4 * PI)),
          a * y,
          a * z,
          a * x,
          b * x * y,
          b * y * z,
          std::sqrt(5 / (16 * PI)) * (3 * z * z - 1),
          b * x * z,
          0.5 * b * (x * x - y * y)};
}

// One path along each of many directions.
struct Truth {
  Coefficients value{};
  Coefficients error{};  // standard
};

Truth monteCarlo(const ref::Scene& scene, double altitude, int directions) {
  std::mt19937_64 generator(5);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<ref::EyeRay> rays;
  for (int i = 0; i < directions; ++i) {
    const double y = 2 * (i + unit(generator)) / directions - 1;
    const double azimuth = 2 * PI * unit(generator);
    const double s = std::sqrt((1 - y) * (1 + y));
    ref::EyeRay ray;
    ray.origin = {0, altitude, 0};
    ray.direction = {s * std::cos(azimuth), y, s * std::sin(azimuth)};
    rays.push_back(ray);
  }
  ref::RenderOptions options;
  options.samples = 4;
  options.firstOrder = 1;
  const ref::RenderResult result = ref::render(scene, rays, options);
  Truth truth;
  Coefficients square{};
  for (size_t i = 0; i < rays.size(); ++i) {
    const auto harmonics =
        harmonicsOf({rays[i].direction[0], rays[i].direction[1], rays[i].direction[2]});
    for (size_t k = 0; k < truth.value.size(); ++k) {
      const double one = 4 * PI * result.pixels[i].radiance[k % 3] * harmonics[k / 3];
      truth.value[k] += one / directions;
      square[k] += one * one / directions;
    }
  }
  for (size_t k = 0; k < square.size(); ++k) {
    truth.error[k] = std::sqrt((square[k] - truth.value[k] * truth.value[k]) / directions);
  }
  return truth;
}

void expectNear(const Coefficients& values, const Truth& truth, double tolerance) {
  constexpr double ERRORS = 3;
  for (size_t k = 0; k < values.size(); ++k) {
    const double first = truth.value[k % 3];
    EXPECT_NEAR(values[k], truth.value[k], tolerance * first + ERRORS * truth.error[k])
        << "coefficient " << k / 3 << ", colour " << k % 3;
    EXPECT_LT(truth.error[k], 0.02 * first);
  }
}

ref::Scene clearScene(const Context& context, const WlkSky& sky, const std::array<double, 3>& sun) {
  ref::Scene scene;
  scene.globe.radius = context.radius;
  scene.ground = true;
  scene.groundAlbedo = {0.25, 0.25, 0.25};
  ref::ExponentialLayer air;
  for (size_t c = 0; c < 3; ++c) {
    air.extinction[c] = static_cast<double>(sky.rayleighScattering[c]);
  }
  air.scaleHeight = static_cast<double>(sky.scaleHeight);
  air.phase = ref::PhaseFunction::rayleigh();
  scene.layers.push_back(air);
  scene.lights.resize(1);
  scene.lights[0].direction = {sun[0], sun[1], sun[2]};
  return scene;
}

TEST(Ambient, ClearSkyAgreesWithMonteCarlo) {
  constexpr double TOLERANCE = 0.02;  // of welkin/query.h
  const Context context;
  const WlkSky sky = context.setSky();
  // No symmetry between the axes.
  const std::vector<std::array<double, 3>> suns{{0.36, 0.48, 0.8}, {-0.8, 0.1, -0.59160798}};
  for (const auto& sun : suns) {
    context.setSun(sun);
    for (const double altitude : {1.0, 6000.0}) {
      SCOPED_TRACE(altitude);
      expectNear(context.ambientAt(altitude),
                 monteCarlo(clearScene(context, sky, sun), altitude, 40000), TOLERANCE);
    }
  }
}

TEST(Ambient, FogAgreesWithMonteCarlo) {
  // Of welkin/query.h. Two Legendre terms for what the sun lights first; measured 0.09.
  constexpr double TOLERANCE = 0.10;
  const Context context;
  const WlkSky sky = context.setSky();
  const std::array<double, 3> sun{0.36, 0.48, 0.8};
  context.setSun(sun);
  WlkFog fog;
  wlkInitStruct(WLK_STRUCT_FOG, sizeof fog, &fog);
  fog.dropletDiameter_um = 1;
  fog.extinction = 5e-4F;
  fog.scaleHeight = 500;
  ASSERT_EQ(wlkSetFog(context.handle, &fog), WLK_SUCCESS);
  ref::Scene scene = clearScene(context, sky, sun);
  ref::ExponentialLayer layer;
  layer.extinction.fill(static_cast<double>(fog.extinction));
  layer.scaleHeight = 500;
  for (size_t c = 0; c < 3; ++c) {
    layer.albedo[c] = static_cast<double>(fog.singleScatteringAlbedo[c]);
  }
  // The library's own phase function: it is checked elsewhere.
  WlkMediumInfo info;
  wlkInitStruct(WLK_STRUCT_MEDIUM_INFO, sizeof info, &info);
  info.particle = WLK_PARTICLE_FOG;
  info.diameter_um = 1;
  WlkMedium medium{};
  ASSERT_EQ(wlkCreateMedium(context.handle, &info, &medium), WLK_SUCCESS);
  std::vector<double> angles;
  for (int i = 0; i <= 2000; ++i) {
    angles.push_back(PI * i / 2000);
  }
  std::vector<ref::Rgb> values(angles.size());
  WlkPhaseQuery query;
  wlkInitStruct(WLK_STRUCT_PHASE_QUERY, sizeof query, &query);
  query.medium = medium;
  query.count = static_cast<uint32_t>(angles.size());
  query.scatteringAngle = angles.data();
  ASSERT_EQ(wlkEvalPhase(context.handle, &query, values[0].data()), WLK_SUCCESS);
  layer.phase = ref::PhaseFunction::table(angles, values);
  scene.layers.push_back(layer);
  expectNear(context.ambientAt(100), monteCarlo(scene, 100, 60000), TOLERANCE);
}

TEST(Ambient, FollowsWhatChanges) {
  const Context context;
  context.setSky();
  context.setSun({0, 1, 0});
  const Coefficients noon = context.ambientAt(0);
  context.setSun({1, 0.02, 0});
  const Coefficients evening = context.ambientAt(0);
  EXPECT_LT(evening[2], 0.5 * noon[2]);
  // Bluer above than below, where the ground is grey.
  EXPECT_GT(noon[2], noon[0]);
  EXPECT_EQ(wlkSetSky(context.handle, nullptr), WLK_SUCCESS);
  context.setSun({0, 1, 0});
  const Coefficients ground = context.ambientAt(0);
  // A white surface below of radiance albedo / pi: its integral is 2 pi of that.
  EXPECT_NEAR(ground[0] * std::sqrt(4 * PI), 2 * 0.25, 0.02);
  EXPECT_EQ(wlkSetLights(context.handle, 0, 0, nullptr), WLK_SUCCESS);
  EXPECT_EQ(context.ambientAt(0), Coefficients{});
}

}  // namespace
