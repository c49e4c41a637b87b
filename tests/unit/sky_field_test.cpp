// SPDX-License-Identifier: MIT
// Light scattered at least twice in sky and fog, against Monte Carlo. Errors are parts of all the
// light along the ray.
#include "tables/sky_field.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "model/air_input.hpp"
#include "model/evaluate.hpp"
#include "reference/monte_carlo.hpp"
#include "tables/fog_light_solver.hpp"
#include "tables/sky_field_solver.hpp"
#include "tables/sky_light.hpp"

namespace {

namespace ref = welkin::reference;
using welkin::SkyColor;
using welkin::SkyField;
using welkin::SkyFieldInput;
using welkin::SkyFieldSolver;
using welkin::SkyFieldSteps;
using welkin::solveSkyField;

constexpr double PI = 3.14159265358979323846;
constexpr double DEGREE = PI / 180;
constexpr double INF = std::numeric_limits<double>::infinity();

// Henyey and Greenstein 1941, 1/sr.
double henyeyGreenstein(double g, double cosine) {
  return (1 - g * g) / (4 * PI) / std::pow(1 + g * g - 2 * g * cosine, 1.5);
}

struct Haze {
  double extinction;  // at sea level, 1/m; 0: none
  double scaleHeight;
  double g;
};

SkyFieldInput inputOf(const Haze& haze, double groundAlbedo) {
  SkyFieldInput input;
  const SkyColor rayleigh{5.8e-6, 1.35e-5, 3.31e-5};
  std::copy(rayleigh.begin(), rayleigh.end(), input.air.airScattering);
  input.air.fogExtinction = haze.extinction;
  input.air.fogScaleHeight = haze.scaleHeight;
  for (size_t l = 0; l < welkin::FOG_TERMS; ++l) {
    input.fogMoments[l].fill(std::pow(haze.g, l + 1));
  }
  input.groundAlbedo.fill(groundAlbedo);
  input.lightAngularRadius = 0;
  return input;
}

ref::Scene sceneOf(const SkyFieldInput& input, const Haze& haze) {
  ref::Scene scene;
  scene.globe.radius = input.air.planetRadius;
  scene.ground = true;
  scene.groundAlbedo = input.groundAlbedo;
  ref::ExponentialLayer air;
  std::copy_n(input.air.airScattering, 3, air.extinction.begin());
  air.scaleHeight = input.air.airScaleHeight;
  air.phase = ref::PhaseFunction::rayleigh();
  scene.layers.push_back(air);
  if (haze.extinction > 0) {
    ref::ExponentialLayer fog;
    fog.extinction.fill(haze.extinction);
    fog.scaleHeight = haze.scaleHeight;
    fog.phase = ref::PhaseFunction::henyeyGreenstein(haze.g);
    scene.layers.push_back(fog);
  }
  scene.lights.resize(1);
  return scene;
}

SkyFieldSteps coarseSteps() {
  SkyFieldSteps steps;
  steps.zenithNodes = 3;
  steps.azimuths = 4;
  steps.steps = 8;
  steps.maxOrders = 6;
  return steps;
}

struct Errors {
  double p90 = 0;
  double max = 0;
};

// Rays to everywhere from heights of 2 m to 20 km, suns 10 to 90 degrees high; in three colours.
// What the noise of the reference may add (2 standard errors) is taken off each error.
Errors errorsOf(const Haze& haze, double distance, int rays, uint64_t paths) {
  const SkyFieldInput input = inputOf(haze, 0.2);
  const SkyField field = solveSkyField(input);
  ref::Scene scene = sceneOf(input, haze);
  std::mt19937_64 generator(11);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<double> errors;
  for (int i = 0; i < rays; ++i) {
    const double sun = (10 + 80 * unit(generator)) * DEGREE;
    const double view = (-15 + 105 * unit(generator)) * DEGREE;
    const double azimuth = PI * unit(generator);
    const double altitude = 2 * std::pow(1e4, unit(generator));
    scene.lights[0].direction = {std::cos(sun), std::sin(sun), 0};
    ref::EyeRay ray;
    ray.origin = {0, altitude, 0};
    ray.direction = {std::cos(view) * std::cos(azimuth), std::sin(view),
                     std::cos(view) * std::sin(azimuth)};
    ray.length = distance;
    const double cosine = ray.direction[0] * std::cos(sun) + ray.direction[1] * std::sin(sun);
    ref::RenderOptions options;
    options.samples = paths;
    options.firstOrder = 2;
    const ref::Estimate truth = ref::render(scene, {ray}, options).pixels[0];
    options.firstOrder = 1;
    options.lastOrder = 1;
    const ref::Estimate first = ref::render(scene, {ray}, options).pixels[0];
    const SkyColor phase = {henyeyGreenstein(haze.g, cosine), henyeyGreenstein(haze.g, cosine),
                            henyeyGreenstein(haze.g, cosine)};
    const SkyColor result =
        field.higherOrdersAlong(altitude, std::sin(view), std::sin(sun), cosine, distance, phase);
    for (size_t c = 0; c < 3; ++c) {
      const double all = truth.radiance[c] + first.radiance[c];
      const double noise = 2 * std::sqrt(truth.variance[c]);
      errors.push_back(std::max(std::abs(result[c] - truth.radiance[c]) - noise, 0.0) / all);
    }
  }
  std::sort(errors.begin(), errors.end());
  return {errors[errors.size() * 9 / 10], errors.back()};
}

constexpr Haze CLEAR{0, 1200, 0};
constexpr Haze EARTH{1e-5, 1200, 0.76};
constexpr Haze THICK_FOG{1e-3, 200, 0.87};

TEST(SkyField, ClearSkyAgreesWithMonteCarlo) {
  const Errors errors = errorsOf(CLEAR, INF, 24, 20000);
  EXPECT_LT(errors.p90, 0.003);
  EXPECT_LT(errors.max, 0.01);
}

TEST(SkyField, HazySkyAgreesWithMonteCarlo) {
  const Errors errors = errorsOf(EARTH, INF, 24, 20000);
  EXPECT_LT(errors.p90, 0.015);
  EXPECT_LT(errors.max, 0.04);
}

TEST(SkyField, AerialPerspectiveAgreesWithMonteCarlo) {
  const Errors errors = errorsOf(EARTH, 2e4, 16, 20000);
  EXPECT_LT(errors.p90, 0.02);
}

// Two Legendre terms are few for a fog of 5 optical depths sideways: some 10 % of its light.
TEST(SkyField, ThickFogAgreesRoughlyWithMonteCarlo) {
  const Errors errors = errorsOf(THICK_FOG, INF, 16, 6000);
  EXPECT_LT(errors.p90, 0.10);
  EXPECT_LT(errors.max, 0.20);
}

TEST(SkyField, ThinAirScattersTwiceAsItsSquare) {
  SkyFieldInput input = inputOf(CLEAR, 0);
  const auto zenith = [&](double scale) {
    for (double& one : input.air.airScattering) {
      one = 1e-9 * scale;
    }
    return solveSkyField(input).radianceAlong(2, 1, 0.5, 0.5, INF)[1];
  };
  EXPECT_NEAR(zenith(10) / zenith(1), 100, 0.1);
}

TEST(SkyField, NothingScattersInNothing) {
  SkyFieldInput input = inputOf(CLEAR, 0.5);
  std::fill(std::begin(input.air.airScattering), std::end(input.air.airScattering), 0.0);
  const SkyField field = solveSkyField(input);
  EXPECT_EQ(field.radianceAlong(2, 0.5, 0.5, 0.5, INF)[1], 0.0);
  EXPECT_EQ(field.irradianceAt(0.7)[1], 0.0);
}

TEST(SkyField, IsFiniteAndNeverNegative) {
  std::mt19937_64 generator(3);
  std::uniform_real_distribution<double> unit(0, 1);
  const auto between = [&](double low, double high) {
    return low * std::pow(high / low, unit(generator));
  };
  for (int i = 0; i < 12; ++i) {
    SkyFieldInput input =
        inputOf({between(1e-7, 10), between(1, 1e4), 2 * unit(generator) - 1}, unit(generator));
    input.air.planetRadius = between(1e4, 1e8);
    input.air.airScaleHeight = between(10, 1e5);
    input.air.fogBaseAltitude = 2000 * unit(generator) - 1000;
    for (double& one : input.air.airScattering) {
      one = between(1e-8, 1e-2);
    }
    const SkyField field = solveSkyField(input, coarseSteps());
    for (int k = 0; k < 40; ++k) {
      const double view = 2 * unit(generator) - 1;
      const double sun = 2 * unit(generator) - 1;
      const double room = std::sqrt((1 - view * view) * (1 - sun * sun));
      const SkyColor result = field.higherOrdersAlong(
          between(1e-3, 1e9), view, sun, view * sun + room * std::cos(PI * unit(generator)),
          k % 2 == 0 ? INF : between(1e-3, 1e7), {0.1, 0.1, 0.1});
      for (const double one : result) {
        EXPECT_TRUE(std::isfinite(one) && one >= 0 && one < 1) << i << ' ' << k << ' ' << one;
      }
    }
  }
}

TEST(SkyFieldSolver, GivesTheSameFieldInPortionsOfAnySize) {
  const SkyFieldInput input = inputOf(EARTH, 0.2);
  const SkyField whole = solveSkyField(input, coarseSteps());
  const size_t rows =
      SkyField::ALTITUDES * static_cast<size_t>(whole.orders()) + welkin::FogLightSolver::STEPS;
  for (const size_t portion : {size_t{1}, size_t{7}, rows}) {
    SkyFieldSolver solver(input, coarseSteps());
    EXPECT_FALSE(solver.advance(0));
    size_t calls = 1;
    while (!solver.advance(portion)) {
      EXPECT_FALSE(solver.done());
      EXPECT_EQ(solver.rows(), portion * calls);
      ++calls;
    }
    EXPECT_EQ(calls, (rows + portion - 1) / portion);
    EXPECT_TRUE(solver.input() == input);
    const SkyField field = solver.take();
    EXPECT_EQ(field.orders(), whole.orders());
    EXPECT_EQ(field.moments(), whole.moments());
    EXPECT_EQ(field.irradiance(), whole.irradiance());
    EXPECT_EQ(field.fogLight()->table(), whole.fogLight()->table());
  }
  RecordProperty("rows", static_cast<int>(rows));
}

TEST(SkyFieldSolver, DoesNothingMoreWhenDone) {
  const SkyFieldInput input = inputOf(CLEAR, 0.2);
  const SkyField whole = solveSkyField(input, coarseSteps());
  SkyFieldSolver solver(input, coarseSteps());
  EXPECT_TRUE(solver.advance(SkyField::ALTITUDES * 64));
  const size_t rows = solver.rows();
  EXPECT_EQ(rows, SkyField::ALTITUDES * static_cast<size_t>(whole.orders()));
  EXPECT_TRUE(solver.advance(SkyField::ALTITUDES));
  EXPECT_EQ(solver.rows(), rows);
  EXPECT_EQ(solver.take().moments(), whole.moments());
}

// What the solver does for all suns at once is what rays that are looked at do one by one. Float
// keeps the share of a node to 24 2^-24, and these moments change by up to 10 times their mean.
TEST(SkyFan, ScattersLikeSingleRays) {
  const welkin::AirInput air = inputOf(EARTH, 0.2).air;
  const welkin::FogTerms terms =
      welkin::fogTerms({SkyColor{0.7, 0.7, 0.7}, SkyColor{0.5, 0.5, 0.5}});
  std::mt19937_64 generator(5);
  std::uniform_real_distribution<float> unit(0, 1);
  std::vector<float> moments(SkyField::ALTITUDES * SkyField::SUNS * welkin::VALUES);
  for (float& one : moments) {
    one = unit(generator);
  }
  const double altitude = 3000;
  const auto radius = static_cast<float>(air.planetRadius + altitude);
  for (const float viewMu : {-0.9F, -0.02F, 0.1F, 0.8F}) {
    welkin::SkyRay ray;
    welkin::planRay(air, welkin::SkyAxes(air), altitude, static_cast<double>(viewMu), INF, 20, ray);
    const float azimuth = unit(generator) * static_cast<float>(PI);
    for (const welkin::SkyStep& step : ray.steps) {
      welkin::Suns sunMu;
      welkin::SkyFan airFan{};
      for (size_t s = 0; s < SkyField::SUNS; ++s) {
        sunMu[s] = static_cast<float>(welkin::SkyAxes::sunAt(static_cast<double>(s) / 47));
        airFan.viewSun[s] = viewMu * sunMu[s] + std::cos(azimuth) * std::sqrt(1 - viewMu * viewMu) *
                                                    std::sqrt(1 - sunMu[s] * sunMu[s]);
      }
      welkin::SkyFan fogFan = airFan;
      const float* low = moments.data() + step.high.index * SkyField::SUNS * welkin::VALUES;
      const float y = welkin::placeAt({radius, viewMu, 0, 0}, step).view.y;
      const float flat = std::sqrt((1 - y) * (1 + y));
      const welkin::SkyPlaces places = welkin::placesOf(
          welkin::sunsAt(step, radius, sunMu, airFan.viewSun), airFan.viewSun, y, flat);
      welkin::SkySource source;
      welkin::airSource(low, step, y, flat, source);
      welkin::addAir(source, places, airFan);
      welkin::fogSource(low, step, terms, y, flat, source);
      welkin::addFog(source, places, fogFan);
      for (size_t s = 0; s < SkyField::SUNS; ++s) {
        const welkin::SkyPlace place =
            welkin::placeAt({radius, viewMu, sunMu[s], airFan.viewSun[s]}, step);
        welkin::SunRow row;
        welkin::blendAltitudes(moments, step.high, 0, row.size(), row.data());
        const welkin::SkyNode node = welkin::sunNode(place.sunMu);
        const size_t first = std::min(node.index, SkyField::SUNS - 4);
        welkin::SunNodes sun{first, {}};
        sun.weights[node.index - first] = 1 - static_cast<float>(node.share);
        sun.weights[node.index - first + 1] = static_cast<float>(node.share);
        const welkin::SkyLight g = welkin::gatherMoments(row.data(), place.view, sun);
        for (size_t c = 0; c < 3; ++c) {
          const float inAir = step.air[c] * welkin::RAYLEIGH * (g.mean[c] + g.square[c]);
          const float inFog = step.fog[c] * welkin::ISOTROPIC *
                              std::max(g.mean[c] + terms.first[c] * g.along[c] +
                                           terms.second[c] * (3 * g.square[c] - g.mean[c]),
                                       0.0F);
          const float tolerance = 10 * 24 * 6e-8F * g.mean[c];
          EXPECT_NEAR(airFan.radiance[s][c], inAir, step.air[c] * welkin::RAYLEIGH * tolerance);
          EXPECT_NEAR(fogFan.radiance[s][c], inFog, step.fog[c] * welkin::ISOTROPIC * tolerance);
        }
      }
    }
  }
}

// Float of the result, of the visible part and of the exponent.
TEST(LightAtAltitude, IsTheModelsTransmittanceTimesVisibility) {
  for (const Haze& haze : {CLEAR, EARTH, THICK_FOG}) {
    const welkin::AirInput input = inputOf(haze, 0).air;
    const welkin::model::f64::Air air = welkin::airFrom(input);
    for (const double altitude : {0.0, 3.0, 500.0, 2e4, 8e4}) {
      for (const double angularRadius : {0.0, 0.00466, 0.3, 1.0}) {
        const welkin::LightAtAltitude light(air, altitude, angularRadius);
        for (int i = 0; i < 40; ++i) {
          welkin::Suns mu;
          for (size_t s = 0; s < SkyField::SUNS; ++s) {
            // Half of them near the horizon.
            const double q = static_cast<double>(40 * s + static_cast<size_t>(i)) / 1919 * 2 - 1;
            mu[s] = static_cast<float>(i % 2 == 0 ? q : 0.2 * q * q * q - 0.01);
          }
          const auto result = light.at(mu);
          for (size_t s = 0; s < SkyField::SUNS; ++s) {
            double depth[3];
            double visible = 0;
            welkin::evalLightDepth(input, altitude, static_cast<double>(mu[s]), angularRadius,
                                   depth, &visible);
            for (size_t c = 0; c < 3; ++c) {
              const double expected = visible * std::exp(-depth[c]);
              EXPECT_NEAR(static_cast<double>(result[s][c]), expected,
                          1.2e-7 * (3 + depth[c]) * expected + 1e-37)
                  << altitude << ' ' << angularRadius << ' ' << mu[s];
            }
          }
        }
      }
    }
  }
}

}  // namespace
