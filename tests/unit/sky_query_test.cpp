// SPDX-License-Identifier: MIT
// wlkEvalSky and wlkEvalTransmittance against Monte Carlo, quadrature and exact limits.
#include <gtest/gtest.h>

#include <cstddef>
#include <random>
#include <string>

#include "reference/monte_carlo.hpp"
#include "reference/planet.hpp"
#include "tables/sky_field.hpp"
#include "unit/sky_scene.hpp"

namespace {

namespace ref = welkin::reference;
using namespace welkin::test;
using welkin::check;

ref::Scene monteCarloScene(const SkyScene& scene, const Point& sun) {
  ref::Scene result;
  result.globe.radius = static_cast<double>(scene.planet.radius);
  result.ground = true;
  result.groundAlbedo = {ALBEDO, ALBEDO, ALBEDO};
  ref::ExponentialLayer air;
  for (size_t c = 0; c < 3; ++c) {
    air.extinction[c] = static_cast<double>(scene.sky.rayleighScattering[c]);
  }
  air.scaleHeight = static_cast<double>(scene.sky.scaleHeight);
  air.phase = ref::PhaseFunction::rayleigh();
  result.layers.push_back(air);
  result.lights.resize(1);
  result.lights[0].direction = {sun[0], sun[1], sun[2]};
  return result;
}

TEST(QuerySky, AllOrdersAgreeWithMonteCarlo) {
  constexpr double TOLERANCE = 0.01;  // of welkin/query.h
  constexpr double ERRORS = 3;        // standard errors of the reference
  const SkyScene scene;
  scene.setSky();
  const Point sun = towards(30, 20);
  scene.setSun(sun);
  const ref::Scene truth = monteCarloScene(scene, sun);
  struct Case {
    double altitude;
    Point direction;
    double length;
  };
  // The last looks at the ground, 1 m short of it: what the ground itself sends is not asked for.
  const std::vector<Case> cases{{2, {0, 1, 0}, INF},
                                {2, towards(10, 80), INF},
                                {3000, towards(-5, 200), 2e4},
                                {3000, {0, -1, 0}, INF}};
  for (const Case& one : cases) {
    SCOPED_TRACE("elevation " + std::to_string(std::asin(one.direction[1]) * 180 / PI));
    const bool down = one.direction[1] == -1;
    ref::EyeRay ray;
    ray.origin = {0, one.altitude, 0};
    ray.direction = {one.direction[0], one.direction[1], one.direction[2]};
    ray.length = down ? one.altitude - 1 : one.length;
    ref::RenderOptions options;
    options.samples = 40000;
    options.firstOrder = 1;
    const ref::Estimate expected = ref::render(truth, {ray}, options).pixels[0];
    const Rgb value = scene.radiance({0, one.altitude, 0}, one.direction, one.length);
    for (size_t c = 0; c < 3; ++c) {
      const double noise = std::sqrt(expected.variance[c]);
      EXPECT_NEAR(value[c], expected.radiance[c], TOLERANCE * expected.radiance[c] + ERRORS * noise)
          << c;
      EXPECT_LT(noise, 0.006 * expected.radiance[c]) << c;
    }
  }
}

// With haze the part of the ground's light that droplets turn a little is the air's.
TEST(QuerySky, GroundSeenThroughHazeIsLeftOut) {
  constexpr double TOLERANCE = 0.04;  // of sky_field_test, of all light
  constexpr double G = 0.76;
  welkin::SkyFieldInput input;
  const welkin::SkyColor rayleigh{5.8e-6, 1.35e-5, 3.31e-5};
  std::copy(rayleigh.begin(), rayleigh.end(), input.air.airScattering);
  input.air.fogExtinction = 1e-4;
  input.air.fogScaleHeight = 1200;
  for (size_t l = 0; l < welkin::FOG_TERMS; ++l) {
    input.fogMoments[l].fill(std::pow(G, l + 1));
  }
  input.groundAlbedo.fill(0.6);
  input.lightAngularRadius = 0;
  const welkin::SkyField field = welkin::solveSkyField(input);
  const Point sun = towards(40, 0);
  const Point view = towards(-30, 100);
  const double cosine = sun[0] * view[0] + sun[1] * view[1] + sun[2] * view[2];
  const double phase = (1 - G * G) / (4 * PI) / std::pow(1 + G * G - 2 * G * cosine, 1.5);
  const welkin::SkyField::Parts parts =
      field.higherOrders(4000, view[1], sun[1], cosine, INF, {phase, phase, phase});

  SkyScene scene;
  ref::Scene truth = monteCarloScene(scene, sun);
  truth.groundAlbedo = input.groundAlbedo;
  ref::ExponentialLayer haze;
  haze.extinction.fill(1e-4);
  haze.scaleHeight = 1200;
  haze.phase = ref::PhaseFunction::henyeyGreenstein(G);
  truth.layers.push_back(haze);
  ref::EyeRay ray;
  ray.origin = {0, 4000, 0};
  ray.direction = {view[0], view[1], view[2]};
  ref::RenderOptions options;
  options.samples = 40000;
  options.firstOrder = 2;
  const ref::Estimate with = ref::render(truth, {ray}, options).pixels[0];
  ray.length = 7990;  // the ground is 8002 m away
  const ref::Estimate without = ref::render(truth, {ray}, options).pixels[0];
  for (size_t c = 0; c < 3; ++c) {
    const double noise = 3 * std::sqrt(with.variance[c] + without.variance[c]);
    EXPECT_NEAR(parts.air[c], without.radiance[c], TOLERANCE * with.radiance[c] + noise);
    EXPECT_NEAR(parts.ground[c], with.radiance[c] - without.radiance[c],
                TOLERANCE * with.radiance[c] + noise);
    EXPECT_GT(parts.ground[c], 0.03 * with.radiance[c]);
  }
}

TEST(QuerySky, TheFirstOrderAloneIsTheQuadratures) {
  constexpr double TOLERANCE = 0.01;  // riley2004.glsl, suns to 80 degrees from the zenith
  const SkyScene scene;
  scene.setSky();
  const Point sun = towards(30, 0);
  scene.setSun(sun);
  for (const Point& view : {Point{0, 1, 0}, towards(15, 50), towards(3, 170)}) {
    const double cosine = sun[0] * view[0] + sun[1] * view[1] + sun[2] * view[2];
    const double phase = 3 / (16 * PI) * (1 + cosine * cosine);
    const Rgb truth =
        ref::inscatter({}, {2, view[1], sun[1], cosine, INF}, phase, 0, 0.00465, 1e-4);
    const Rgb first = scene.radiance({0, 2, 0}, view, INF, 1);
    const Rgb all = scene.radiance({0, 2, 0}, view, INF);
    for (size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(first[c], truth[c], TOLERANCE * truth[c]);
      EXPECT_GT(all[c], 1.02 * first[c]);
    }
  }
}

TEST(QuerySky, FromFarAboveIsAsFromTheTop) {
  // Float positions of a ray of 36 000 km: a step is 4 m long, of scale heights of 8 km.
  constexpr double TOLERANCE = 2e-3;
  const SkyScene scene;
  scene.setSky();
  scene.setSun(towards(30, 0));
  for (const Point& target : {Point{0, 0, 0}, Point{2e6, 0, 1e6}, Point{6.39e6, -6.371e6, 0}}) {
    const Point eye{0, 3.6e7, 0};
    Point view{target[0] - eye[0], target[1] - eye[1], target[2] - eye[2]};
    const double length = std::hypot(view[0], view[1], view[2]);
    Point near{};
    for (size_t i = 0; i < 3; ++i) {
      view[i] /= length;
      near[i] = target[i] - 3e6 * view[i];
    }
    const Rgb far = scene.radiance(eye, view, INF);
    const Rgb close = scene.radiance(near, view, INF);
    for (size_t c = 0; c < 3; ++c) {
      EXPECT_GT(close[c], 1e-4);
      EXPECT_NEAR(far[c], close[c], TOLERANCE * close[c]) << target[0] << ", colour " << c;
    }
  }
}

TEST(QueryTransmittance, AgreesWithQuadratureBothWays) {
  constexpr double COLUMN = 0.003;  // layerColumn: 0.2 % of the depth, and rounding of the inputs
  const SkyScene scene;
  scene.setSky();
  scene.setHaze();
  std::mt19937 generator(2);
  std::uniform_real_distribution<double> unit(0, 1);
  ref::Planet planet;
  planet.fogExtinction = 1e-5;
  planet.fogScaleHeight = 1200;
  for (int i = 0; i < 40; ++i) {
    const double low = 1e4 * unit(generator);
    const Point a{0, low, 0};
    const Point view = towards(90 * unit(generator) - 1, 360 * unit(generator));
    const double length = std::pow(10, 2 + 4 * unit(generator));
    const Point b{length * view[0], low + length * view[1], length * view[2]};
    const Rgb value = scene.transmittance(a, b);
    EXPECT_EQ(value, scene.transmittance(b, a));
    if (value[0] == 0) {
      continue;  // the planet is between
    }
    const Rgb depth = ref::depthOf(planet, ref::columns(planet, low, view[1], length));
    for (size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(std::log(value[c]), -depth[c], COLUMN * depth[c] + 1e-9);
    }
  }
}

TEST(QueryTransmittance, IsTheProductOfItsParts) {
  constexpr double COLUMN = 0.004;  // 0.2 % of each depth
  const SkyScene scene;
  scene.setSky();
  scene.setHaze();
  for (const double slope : {-0.01, 0.0, 0.3}) {
    const Point a{-4e4, 3000 - 4e4 * slope, 0};
    const Point b{1e4, 3000 + 1e4 * slope, 0};
    const Point c{9e4, 3000 + 9e4 * slope, 0};
    if (a[1] < 0) {
      continue;
    }
    const Rgb whole = scene.transmittance(a, c);
    const Rgb first = scene.transmittance(a, b);
    const Rgb second = scene.transmittance(b, c);
    for (size_t k = 0; k < 3; ++k) {
      const double depth = -std::log(whole[k]);
      EXPECT_GT(depth, 0.0);
      EXPECT_NEAR(std::log(first[k] * second[k]), -depth, COLUMN * depth);
    }
  }
}

TEST(QueryTransmittance, ThePlanetIsOpaque) {
  constexpr Rgb ONE{1, 1, 1};
  constexpr Rgb NONE{0, 0, 0};
  const SkyScene scene;
  const double radius = static_cast<double>(scene.planet.radius);
  const Point here{0, 2, 0};
  const Point antipode{0, -2 * radius - 2, 0};
  for (const bool air : {false, true}) {
    if (air) {
      scene.setSky();
    }
    EXPECT_EQ(scene.transmittance(here, antipode), NONE);
    EXPECT_EQ(scene.transmittance(here, {1e5, 2 - 1e10 / (2 * radius), 0}), NONE);
    EXPECT_EQ(scene.transmittance(here, here), ONE);
  }
  check(wlkSetSky(scene.context, nullptr));
  EXPECT_EQ(scene.transmittance(here, {3e5, 8e8, 1e5}), ONE);
  // Points at sea level see each other as far as the straight line passes 1 m below: 7 km.
  EXPECT_EQ(scene.transmittance({-3000, -9e6 / (2 * radius), 0}, {3000, -9e6 / (2 * radius), 0}),
            ONE);
  EXPECT_EQ(scene.transmittance({-4000, -16e6 / (2 * radius), 0}, {4000, -16e6 / (2 * radius), 0}),
            NONE);
  // In a valley below sea level.
  EXPECT_EQ(scene.transmittance({0, -300, 0}, {1000, -200, 0}), ONE);
}

TEST(QuerySky, NothingIsSeenWithoutLight) {
  const SkyScene scene;
  scene.setSky();
  EXPECT_EQ(scene.radiance({0, 2, 0}, {0, 1, 0}, INF), Rgb{});
  EXPECT_EQ(scene.direct({0, 2, 0}, {0, 1, 0}), Rgb{});
  EXPECT_EQ(scene.diffuse({0, 2, 0}, {0, 1, 0}), Rgb{});
  for (const float one : scene.map(2, 4)) {
    EXPECT_EQ(one, 0.0F);
  }
  EXPECT_LT(scene.transmittance({0, 2, 0}, {0, 1e5, 0})[2], 0.8);
}

}  // namespace
