// SPDX-License-Identifier: MIT
#include "reference/monte_carlo.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "reference/noise_volume.hpp"
#include "reference/planet.hpp"
#include "reference/quadrature.hpp"
#include "reference/raymarch.hpp"

namespace welkin::reference {
namespace {

constexpr double PI = std::numbers::pi;
constexpr double ERRORS = 3.5;  // standard errors; seeds are fixed

RenderOptions optionsOf(uint64_t samples, uint32_t firstOrder = 0,
                        uint32_t lastOrder = ALL_ORDERS) {
  RenderOptions options;
  options.samples = samples;
  options.firstOrder = firstOrder;
  options.lastOrder = lastOrder;
  return options;
}

double errorOf(const Estimate& estimate, size_t channel) {
  return std::sqrt(estimate.variance[channel]);
}

// Like a droplet's: half of the energy within a degree or two.
PhaseFunction peakedPhase(double width) {
  std::vector<double> angles{0};
  std::vector<Rgb> values;
  for (int i = 1; i < 600; ++i) {
    angles.push_back(PI * std::pow(i / 600.0, 3));
  }
  angles.push_back(PI);
  for (const double t : angles) {
    const double peak = std::exp(-t * t / (2 * width * width)) / (4 * PI * width * width);
    const double broad = 0.5 * 0.36 / (4 * PI) / std::pow(1.64 - 1.6 * std::cos(t), 1.5);
    values.push_back({peak + broad, peak + broad, peak + broad});
  }
  return PhaseFunction::table(angles, values);
}

// A cloud in the air over ground, 6 km wide, everything coloured.
Scene cloudScene() {
  Scene scene;
  scene.globe.radius = 1e6;
  scene.ground = true;
  scene.groundAlbedo = {0.3, 0.5, 0.2};
  ExponentialLayer air;
  air.extinction = {5.8e-6, 1.35e-5, 3.31e-5};
  air.phase = PhaseFunction::rayleigh();
  ExponentialLayer fog;
  fog.scaleHeight = 300;
  fog.extinction.fill(4e-4);
  fog.albedo = {0.9, 0.95, 1};
  fog.phase = PhaseFunction::henyeyGreenstein(0.75);
  scene.layers = {air, fog};
  ParticleField field;
  field.values = noiseCloud();
  field.extinctionScale.fill(0.3 * NOISE_CLOUD_SIZE / 6000);
  field.phase = peakedPhase(0.02);
  scene.volumes.push_back({{NOISE_CLOUD_SIZE, NOISE_CLOUD_SIZE, NOISE_CLOUD_SIZE},
                           {6000, 0, 0, -3000, 0, 6000, 0, 500, 0, 0, 6000, -9000},
                           {field}});
  DistantLight sun;
  sun.direction = normalized({0.7, 0.6, 0.3});
  sun.irradiance = {1, 0.9, 0.8};
  scene.lights.push_back(sun);
  return scene;
}

// Rays from near the ground into the cloud, past it and to the ground.
std::vector<EyeRay> cloudRays() {
  std::vector<EyeRay> rays;
  for (const Point& d : {Point{0, 0.5, -1}, Point{0.1, 0.45, -1}, Point{-0.2, 0.6, -1},
                         Point{1, 0.2, 0.3}, Point{0.3, -0.1, -1}}) {
    EyeRay ray;
    ray.origin = {0, 50, 0};
    ray.direction = normalized(d);
    rays.push_back(ray);
  }
  return rays;
}

TEST(MonteCarlo, FurnaceHasOneRadianceEverywhere) {
  Scene scene = cloudScene();
  scene.environment = {1, 1, 1};
  scene.groundAlbedo = {1, 1, 1};
  scene.layers[1].albedo = {1, 1, 1};
  scene.lights[0].irradiance.fill(1e-30);  // dark, but paths branch towards it
  const RenderResult result = render(scene, cloudRays(), optionsOf(2000));
  for (const Estimate& estimate : result.pixels) {
    for (size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(estimate.radiance[c], 1, ERRORS * errorOf(estimate, c));
      EXPECT_LT(errorOf(estimate, c), 0.03);
    }
  }
}

TEST(MonteCarlo, SinglyScatteredSkyAgreesWithQuadrature) {
  Planet planet;
  planet.fogExtinction = 3e-4;
  planet.fogScaleHeight = 400;
  planet.fogAlbedo = {0.9, 0.8, 0.7};
  Scene scene;
  scene.globe.radius = planet.radius;
  scene.ground = true;  // black
  scene.layers.resize(2);
  scene.layers[0].extinction = planet.airScattering;
  scene.layers[0].phase = PhaseFunction::rayleigh();
  scene.layers[1].scaleHeight = 400;
  scene.layers[1].extinction.fill(3e-4);
  scene.layers[1].albedo = planet.fogAlbedo;
  scene.layers[1].phase = PhaseFunction::henyeyGreenstein(0.7);
  struct Case {
    double altitude, viewElevation, lightElevation, length;
  };
  for (const Case& c : {Case{2, 0.5, 0.6, FAR}, Case{2, 0.03, 0.02, FAR}, Case{2, 0.1, -0.03, FAR},
                        Case{9000, -0.03, 0.3, FAR}, Case{300, 0.0, 1.2, 2e4}}) {
    EyeRay ray;
    ray.origin = {0, c.altitude, 0};
    ray.direction = {std::cos(c.viewElevation), std::sin(c.viewElevation), 0};
    ray.length = c.length;
    DistantLight sun;
    sun.direction = {0.8 * std::cos(c.lightElevation), std::sin(c.lightElevation),
                     0.6 * std::cos(c.lightElevation)};
    scene.lights = {sun};
    const double y = oneMinusCosine(ray.direction, sun.direction);
    const std::array<double, 3> expected =
        inscatter(planet, {c.altitude, ray.direction[1], sun.direction[1], 1 - y, c.length},
                  scene.layers[0].phase.value(0, y), scene.layers[1].phase.value(0, y), 0, 1e-4);
    const Estimate estimate = render(scene, {ray}, optionsOf(60000, 1, 1)).pixels[0];
    for (size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(estimate.radiance[k], expected[k],
                  ERRORS * errorOf(estimate, k) + 1e-4 * expected[k])
          << c.viewElevation << " " << k;
      EXPECT_LT(errorOf(estimate, k), 0.04 * *std::max_element(expected.begin(), expected.end()));
    }
  }
}

TEST(MonteCarlo, SinglyScatteredCloudAgreesWithTheRayMarch) {
  Scene scene = cloudScene();
  scene.ground = false;
  scene.layers.clear();
  const ParticleField& field = scene.volumes[0].fields()[0];
  VoxelField voxels{{NOISE_CLOUD_SIZE, NOISE_CLOUD_SIZE, NOISE_CLOUD_SIZE},
                    {},
                    {6000, 0, 0, -3000, 0, 6000, 0, 500, 0, 0, 6000, -9000}};
  for (const float value : field.values) {
    voxels.extinction.push_back(static_cast<double>(value) * field.extinctionScale[0]);
  }
  const RayMarch march(voxels);
  for (const EyeRay& ray : cloudRays()) {
    const MarchResult expected =
        march.march(ray.origin, ray.direction, FAR, scene.lights[0].direction);
    const double phase =
        field.phase.value(0, oneMinusCosine(ray.direction, scene.lights[0].direction));
    const Estimate estimate = render(scene, {ray}, optionsOf(20000, 1, 1)).pixels[0];
    for (size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(estimate.transmittance[c], expected.transmittance, 1e-12);
      const double value = phase * expected.scattered * scene.lights[0].irradiance[c];
      // 5e-5: the march's own error.
      EXPECT_NEAR(estimate.radiance[c], value, ERRORS * errorOf(estimate, c) + 5e-5 * value);
      EXPECT_LE(errorOf(estimate, c), 0.02 * value);
    }
  }
}

TEST(MonteCarlo, OrdersAddUpToAll) {
  const Scene scene = cloudScene();
  const std::vector<EyeRay> rays = cloudRays();
  const RenderResult all = render(scene, rays, optionsOf(1500));
  std::vector<RenderResult> parts;
  for (const auto& [first, last] :
       {std::pair{0u, 0u}, {1u, 1u}, {2u, 2u}, {3u, 6u}, {7u, ALL_ORDERS}}) {
    parts.push_back(render(scene, rays, optionsOf(1500, first, last)));
  }
  for (size_t i = 0; i < rays.size(); ++i) {
    for (size_t c = 0; c < 3; ++c) {
      double sum = 0;
      double variance = all.pixels[i].variance[c];
      for (const RenderResult& part : parts) {
        sum += part.pixels[i].radiance[c];
        variance += part.pixels[i].variance[c];
      }
      EXPECT_NEAR(sum, all.pixels[i].radiance[c], ERRORS * std::sqrt(variance)) << i << " " << c;
      EXPECT_LT(std::sqrt(variance), 0.2 * sum);
    }
  }
}

TEST(MonteCarlo, RatioTrackingGivesTheSameLight) {
  const Scene scene = cloudScene();
  const std::vector<EyeRay> rays = cloudRays();
  RenderOptions options = optionsOf(1500);
  const RenderResult exact = render(scene, rays, options);
  options.shadow = Shadow::RATIO_TRACKING;
  options.seed = 2;
  const RenderResult tracked = render(scene, rays, options);
  for (size_t i = 0; i < rays.size(); ++i) {
    for (size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(exact.pixels[i].radiance[c], tracked.pixels[i].radiance[c],
                  ERRORS * std::hypot(errorOf(exact.pixels[i], c), errorOf(tracked.pixels[i], c)));
    }
  }
}

TEST(MonteCarlo, BranchingTowardsTheLightChangesNothingButTheNoise) {
  // In a slab, reciprocity turns the path around: branches then point elsewhere.
  Scene scene;
  UniformLayer layer;
  layer.extinction.fill(3);
  layer.phase = peakedPhase(0.05);
  scene.uniformLayers = {layer};
  const auto direction = [](double mu, double azimuth) {
    const double sine = std::sqrt(1 - mu * mu);
    return Point{sine * std::cos(azimuth), mu, sine * std::sin(azimuth)};
  };
  const auto radiance = [&](double viewMu, double lightMu, uint64_t seed) {
    scene.lights.assign(1, {});
    scene.lights[0].direction = direction(lightMu, 2);
    EyeRay ray;
    const Point back = direction(viewMu, 0);
    ray.origin = {0, 1, 0};
    ray.direction = {-back[0], -back[1], -back[2]};
    RenderOptions options = optionsOf(60000);
    options.seed = seed;
    return render(scene, {ray}, options).pixels[0];
  };
  const Estimate there = radiance(0.8, 0.3, 1);
  const Estimate back = radiance(0.3, 0.8, 2);
  EXPECT_NEAR(there.radiance[0] / 0.3, back.radiance[0] / 0.8,
              ERRORS * std::hypot(errorOf(there, 0) / 0.3, errorOf(back, 0) / 0.8));
  EXPECT_LT(errorOf(there, 0), 0.03 * there.radiance[0]);
}

TEST(MonteCarlo, IsTheSameForAnyNumberOfThreads) {
  // Four blocks of work per ray, the last one shorter: sums of two do not depend on their order.
  constexpr uint64_t BLOCK = 4096;  // as in monte_carlo.cpp
  const Scene scene = cloudScene();
  const std::vector<EyeRay> rays(2, cloudRays()[3]);  // past the cloud, for speed
  RenderOptions options = optionsOf(3 * BLOCK + 1000, 1, 2);
  options.threads = 1;
  const RenderResult one = render(scene, rays, options);
  options.threads = 3;
  const RenderResult three = render(scene, rays, options);
  options.seed = 2;
  const RenderResult other = render(scene, rays, options);
  EXPECT_EQ(one.events, three.events);
  for (size_t i = 0; i < rays.size(); ++i) {
    EXPECT_EQ(one.pixels[i].radiance, three.pixels[i].radiance);
    EXPECT_EQ(one.pixels[i].variance, three.pixels[i].variance);
    EXPECT_NE(one.pixels[i].radiance, other.pixels[i].radiance);
  }
}

TEST(MonteCarlo, StandardErrorIsTheSpreadOfRuns) {
  const Scene scene = cloudScene();
  const std::vector<EyeRay> rays(1, cloudRays()[0]);
  constexpr int RUNS = 200;
  double sum = 0;
  double square = 0;
  double variance = 0;
  for (int i = 0; i < RUNS; ++i) {
    RenderOptions options = optionsOf(50, 1, 3);
    options.seed = static_cast<uint64_t>(i);
    options.threads = 1;
    const Estimate estimate = render(scene, rays, options).pixels[0];
    sum += estimate.radiance[1] / RUNS;
    square += estimate.radiance[1] * estimate.radiance[1] / RUNS;
    variance += estimate.variance[1] / RUNS;
  }
  // A variance from 200 values has a relative error of 10 % (normal); three of these.
  EXPECT_NEAR((square - sum * sum) / variance, 1, 0.3);
}

TEST(MonteCarlo, WhatIsSeenDirectlyIsExact) {
  constexpr double ROUNDING = 1e-12;
  Scene scene;
  scene.globe.radius = 1e6;
  scene.ground = true;
  scene.groundAlbedo = {0.1, 0.2, 0.4};
  DistantLight sun;
  sun.direction = normalized({0.6, 0.8, 0});
  sun.irradiance = {1, 2, 3};
  sun.angularDiameter = 0.01;
  scene.lights = {sun};
  EyeRay down;
  down.origin = {0, 10, 0};
  down.direction = {0, -1, 0};
  EyeRay up = down;
  up.direction = sun.direction;
  EyeRay beside = down;
  beside.direction = deflected(sun.direction, 1 - std::cos(0.0051), 1);
  EyeRay wall = up;
  wall.length = 5;
  wall.background = {7, 8, 9};
  const RenderResult result = render(scene, {down, up, beside, wall}, optionsOf(10));
  for (size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(result.pixels[0].radiance[c], scene.groundAlbedo[c] * 0.8 / PI * sun.irradiance[c],
                ROUNDING);
    EXPECT_EQ(result.pixels[0].transmittance[c], 0);
    const double sine = std::sin(0.005);
    EXPECT_NEAR(result.pixels[1].radiance[c] * PI * sine * sine, sun.irradiance[c], 1e-9);
    EXPECT_EQ(result.pixels[2].radiance[c], 0);
    EXPECT_EQ(result.pixels[3].radiance[c], wall.background[c]);
    EXPECT_EQ(result.pixels[3].variance[c], 0);
  }
}

TEST(MonteCarlo, DiskBlursWhatAThinSlabScattersOnce) {
  // All ways through the slab have nearly one length, so that the attenuation is the same for all.
  constexpr double DEPTH = 0.1;
  constexpr double DIAMETER = 0.02;
  Scene scene;
  UniformLayer layer;
  layer.extinction.fill(DEPTH);
  layer.phase = peakedPhase(0.01);
  scene.uniformLayers = {layer};
  DistantLight sun;
  sun.angularDiameter = DIAMETER;
  sun.blurs = true;
  scene.lights = {sun};
  for (const double angle : {0.0, 0.012, 0.03}) {
    EyeRay ray;
    ray.origin = {0, -1, 0};
    ray.direction = deflected({0, 1, 0}, 1 - std::cos(angle), 0);
    // Mean over rings and spokes, midpoints in area.
    double expected = 0;
    constexpr int RINGS = 40;
    constexpr int SPOKES = 90;
    for (int i = 0; i < RINGS * SPOKES; ++i) {
      const double half = std::sin(DIAMETER / 4);
      const double y = 2 * half * half * (i / SPOKES + 0.5) / RINGS;
      const Point to = deflected({0, 1, 0}, y, 2 * PI * (i % SPOKES + 0.5) / SPOKES);
      expected += layer.phase.value(0, oneMinusCosine(ray.direction, to)) / (RINGS * SPOKES);
    }
    expected *= DEPTH * std::exp(-DEPTH);
    const Estimate estimate = render(scene, {ray}, optionsOf(200000, 1, 1)).pixels[0];
    // 1e-3: the rings, and 1 / mu - 1 < 5e-4 in the depth.
    EXPECT_NEAR(estimate.radiance[0], expected, ERRORS * errorOf(estimate, 0) + 1e-3 * expected)
        << angle;
    EXPECT_LT(errorOf(estimate, 0), 0.03 * expected);
  }
}

TEST(MonteCarlo, RefusesWhatIsNoScene) {
  Scene scene;
  EXPECT_THROW(render(scene, {EyeRay{}}, optionsOf(1)), std::invalid_argument);
  scene.globe.radius = 1e6;
  scene.uniformLayers.resize(1);
  EXPECT_THROW(render(scene, {EyeRay{}}, optionsOf(10)), std::invalid_argument);
}

}  // namespace
}  // namespace welkin::reference
