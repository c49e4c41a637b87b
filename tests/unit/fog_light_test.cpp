// SPDX-License-Identifier: MIT
// The fog's source of further light against Monte Carlo: radiance from many directions at a point,
// weighted with the fog's phase function. Relative errors, no unit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <random>
#include <sstream>
#include <string>

#include "reference/monte_carlo.hpp"
#include "tables/fog_light_solver.hpp"
#include "tables/sky_table.hpp"

namespace {

namespace ref = welkin::reference;
using welkin::FOG_TERMS;
using welkin::FogLight;
using welkin::FogLightInput;
using welkin::FogTermsOf;

constexpr double PI = 3.14159265358979323846;
constexpr double DEGREE = PI / 180;
constexpr std::array<double, 3> RAYLEIGH{5.8e-6, 1.35e-5, 3.31e-5};

struct Fog {
  double extinction = 0;  // at sea level, 1/m
  double scaleHeight = 0;
  double g = 0;
  double ground = 0;
};

// For the test runner's messages.
void PrintTo(const Fog& fog, std::ostream* stream) {
  *stream << "g " << fog.g << ", extinction " << fog.extinction << ", scale height "
          << fog.scaleHeight;
}

double peakOf(const Fog& fog) {
  return std::pow(fog.g, FOG_TERMS);
}

// Fog that absorbs nothing loses its peak by scattering less.
FogLightInput inputOf(const Fog& fog) {
  FogLightInput input;
  const double peak = peakOf(fog);
  std::copy(RAYLEIGH.begin(), RAYLEIGH.end(), input.air.airScattering);
  input.air.fogExtinction = fog.extinction * (1 - peak);
  input.air.fogScaleHeight = fog.scaleHeight;
  for (FogTermsOf& terms : input.terms) {
    for (size_t l = 0; l < FOG_TERMS; ++l) {
      terms[l] = (std::pow(fog.g, l) - peak) / (1 - peak);
    }
  }
  input.groundAlbedo.fill(fog.ground);
  input.lightAngularRadius = 0;
  return input;
}

ref::Scene sceneOf(const Fog& fog, const FogLightInput& input, double elevation) {
  ref::Scene scene;
  scene.globe.radius = input.air.planetRadius;
  scene.ground = true;
  scene.groundAlbedo = input.groundAlbedo;
  ref::ExponentialLayer air;
  std::copy(RAYLEIGH.begin(), RAYLEIGH.end(), air.extinction.begin());
  air.scaleHeight = input.air.airScaleHeight;
  air.phase = ref::PhaseFunction::rayleigh();
  scene.layers.push_back(air);
  ref::ExponentialLayer droplets;
  droplets.extinction.fill(fog.extinction);
  droplets.scaleHeight = fog.scaleHeight;
  droplets.phase = ref::PhaseFunction::henyeyGreenstein(fog.g);
  scene.layers.push_back(droplets);
  scene.lights.resize(1);
  scene.lights[0].direction = {std::cos(elevation), std::sin(elevation), 0};
  return scene;
}

double dot(const ref::Point& a, const ref::Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// The series of the fog's terms, 1/sr.
double phaseOf(const FogTermsOf& terms, double cosine) {
  const FogTermsOf p = welkin::legendreOf(0, cosine);
  double sum = 0;
  for (size_t l = 0; l < FOG_TERMS; ++l) {
    sum += static_cast<double>(2 * l + 1) * terms[l] * p[l];
  }
  return sum / (4 * PI);
}

struct Estimate {
  double mean = 0;
  double deviation = 0;
};

// Sum of what is scattered into `view`, in green. Rays: stratified over the sphere, as many
// weights.
Estimate gather(const std::vector<ref::EyeRay>& rays, const std::vector<ref::Estimate>& light,
                const FogTermsOf& terms, const ref::Point& view) {
  Estimate sum;
  const double solidAngle = 4 * PI / static_cast<double>(rays.size());
  double squares = 0;
  for (size_t i = 0; i < rays.size(); ++i) {
    const double weight = solidAngle * phaseOf(terms, dot(rays[i].direction, view));
    sum.mean += weight * light[i].radiance[1];
    squares += weight * weight * light[i].radiance[1] * light[i].radiance[1];
  }
  sum.deviation = std::sqrt(squares);  // or less: of rays without strata
  return sum;
}

class FogLightTruth : public testing::TestWithParam<Fog> {};

TEST_P(FogLightTruth, IsMonteCarlosLightTimesThePhaseFunction) {
  const Fog fog = GetParam();
  const FogLightInput input = inputOf(fog);
  const FogLight light = welkin::solveFogLight(input);
  std::mt19937_64 generator(5);
  std::uniform_real_distribution<double> unit(0, 1);
  // The slab's 16 streams and cells 1 %, four linear interpolations 3 %, flat layers 1 %.
  constexpr double WITHIN = 0.05;
  for (const double elevation : {8 * DEGREE, 35 * DEGREE, 80 * DEGREE}) {
    for (const double depthShare : {1.0, 0.2}) {
      const double altitude = 1 - fog.scaleHeight * std::log(depthShare);
      std::vector<ref::EyeRay> rays;
      constexpr size_t SIDE = 150;
      for (size_t i = 0; i < SIDE * SIDE; ++i) {
        const double up = 2 * (static_cast<double>(i / SIDE) + unit(generator)) / SIDE - 1;
        const double azimuth = 2 * PI * (static_cast<double>(i % SIDE) + unit(generator)) / SIDE;
        const double flat = std::sqrt(1 - up * up);
        rays.push_back(
            {{0, altitude, 0}, {flat * std::cos(azimuth), up, flat * std::sin(azimuth)}});
      }
      ref::RenderOptions options;
      options.samples = 2;
      options.firstOrder = 1;
      const std::vector<ref::Estimate> seen =
          ref::render(sceneOf(fog, input, elevation), rays, options).pixels;
      for (const double view : {-60.0, -5.0, 10.0, 50.0}) {
        for (const double azimuth : {5.0, 70.0, 180.0}) {
          const ref::Point direction = {std::cos(view * DEGREE) * std::cos(azimuth * DEGREE),
                                        std::sin(view * DEGREE),
                                        std::cos(view * DEGREE) * std::sin(azimuth * DEGREE)};
          const double viewSun =
              direction[0] * std::cos(elevation) + direction[1] * std::sin(elevation);
          const Estimate truth = gather(rays, seen, input.terms[1], direction);
          const double source =
              light.sourceAt(altitude, std::sin(elevation),
                             {direction[1], std::cos(azimuth * DEGREE), viewSun})[1];
          EXPECT_NEAR(source / truth.mean, 1, WITHIN + 3 * truth.deviation / truth.mean)
              << "sun " << elevation / DEGREE << " altitude " << altitude << " view " << view
              << " azimuth " << azimuth << " noise " << truth.deviation / truth.mean;
        }
      }
    }
  }
}

std::string fogName(const testing::TestParamInfo<Fog>& info) {
  std::ostringstream name;
  name << "Depth" << std::lround(100 * info.param.extinction * info.param.scaleHeight);
  return name.str();
}

INSTANTIATE_TEST_SUITE_P(Fogs, FogLightTruth,
                         testing::Values(Fog{2e-4, 300, 0.85, 0.2}, Fog{1e-3, 1000, 0.8, 0.6},
                                         Fog{1e-2, 500, 0.5, 0}),
                         fogName);

TEST(FogLight, IsFiniteAndNeverNegative) {
  std::mt19937_64 generator(3);
  std::uniform_real_distribution<double> unit(0, 1);
  const auto between = [&](double low, double high) {
    return low * std::pow(high / low, unit(generator));
  };
  for (int i = 0; i < 12; ++i) {
    FogLightInput input =
        inputOf({between(1e-9, 10), between(1, 1e4), unit(generator), unit(generator)});
    input.air.planetRadius = between(1e4, 1e8);
    input.air.airScaleHeight = between(10, 1e5);
    input.air.fogBaseAltitude = 2000 * unit(generator) - 1000;
    for (double& one : input.air.airScattering) {
      one = between(1e-8, 1e-2);
    }
    const FogLight light = welkin::solveFogLight(input);
    size_t bad = 0;
    for (const float value : light.table()) {
      bad += std::isfinite(value) && value >= 0 ? 0U : 1U;
    }
    EXPECT_EQ(bad, 0u) << i;
    for (const double x : {-1.0, -0.3, 0.0, 0.3, 1.0}) {
      const double source = light.sourceAt(1e4 * x, x, {x, -x, x})[1];
      EXPECT_TRUE(std::isfinite(source) && source >= 0) << i << " " << x;
    }
  }
}

TEST(FogLight, NothingIsScatteredWithoutFog) {
  const FogLight light = welkin::solveFogLight(inputOf({0, 100, 0.8, 0.5}));
  EXPECT_EQ(light.sourceAt(10, 0.5, {0.5, 1, 0.9})[1], 0.0);
}

}  // namespace
