// SPDX-License-Identifier: MIT
// Samples of every kind of particle against its own phase function: chi-square in double, and the
// distribution of the float curve that shaders and path tracers get.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "model/model.hpp"
#include "particles/medium.hpp"
#include "reference/phase_reference.hpp"

namespace {

using namespace welkin;
using reference::Real;
namespace f64 = model::f64;

constexpr double PI = std::numbers::pi;

struct Sampled {
  std::string label;
  Particle particle;
  size_t channel;
};

constexpr int SAMPLES = 1'000'000;

// Five values over the range of each kind, as table and as closed form.
std::vector<Sampled> casesOf(ParticleType type) {
  constexpr double PLACES[] = {0, 0.25, 0.5, 0.75, 1};
  const std::vector<double> angle = {0, 0.02, 0.1, 1, 2.4, PI};
  const std::vector<double> phase = {900, 800, 700, 90, 90, 80, 7, 8, 9, 1, 2, 3, 2, 4, 1, 0, 4, 1};
  const ParticleKind& kind = particleKind(type);
  std::vector<Sampled> cases;
  for (const bool analytic : {false, true}) {
    if (!(analytic ? kind.hasAnalytic : kind.hasTable)) {
      continue;
    }
    for (size_t i = 0; i < std::size(PLACES); ++i) {
      ParticleParams params;
      const ParticleRange& size = kind.diameter_um;
      params.diameter_um =
          size.high > 0 ? size.low * std::pow(size.high / size.low, PLACES[i]) : 0.0;
      params.spread = kind.spread.initial;
      params.roughness = std::lerp(kind.roughness.low, kind.roughness.high, PLACES[i]);
      params.asymmetry = std::lerp(-0.95, 0.95, PLACES[i]);
      params.analytic = analytic;
      params.userAngle = angle;
      params.userPhase = phase;
      cases.push_back({kind.name + std::string(analytic ? " closed " : " ") + std::to_string(i),
                       kind.make(params), cases.size() % RGB});
    }
  }
  return cases;
}

class ParticleSample : public testing::TestWithParam<ParticleType> {};

double angleAt(double s) {
  return 2 * std::asin(std::sqrt(std::min(f64::curveNode(s) / 2, 1.0)));
}

// Normal deviate of a chi-square sum (Wilson and Hilferty 1931).
double deviate(double sum, double degrees) {
  const double spread = 2 / (9 * degrees);
  return (std::cbrt(sum / degrees) - (1 - spread)) / std::sqrt(spread);
}
constexpr double DEVIATE_LIMIT = 3.89;  // p > 1e-4: there are 65 sums

TEST_P(ParticleSample, HasTheDensityOfThePhaseFunction) {
  constexpr size_t BINS = 200;  // even steps of the table coordinate
  std::mt19937_64 generator(7 + static_cast<uint64_t>(GetParam()));
  for (const Sampled& one : casesOf(GetParam())) {
    std::vector<int> counts(BINS);
    for (int i = 0; i < SAMPLES; ++i) {
      const double random = static_cast<double>(generator() >> 11) * 0x1p-53;
      const double angle = sampleParticle(one.particle, one.channel, random);
      const double half = std::sin(angle / 2);
      const double s = f64::phaseCoordinate(2 * half * half);
      ++counts[std::min(static_cast<size_t>(s * BINS), BINS - 1)];
    }
    double sum = 0;
    double degrees = -1;
    double expected = 0;
    double found = 0;
    for (size_t i = 0; i < BINS; ++i) {
      const double begin = angleAt(static_cast<double>(i) / BINS);
      const double end = angleAt(static_cast<double>(i + 1) / BINS);
      const Real energy = reference::integrateSphere(
          [&](Real theta) {
            return static_cast<Real>(
                evalParticle(one.particle, one.channel, static_cast<double>(theta)));
          },
          begin, end, static_cast<Real>(end - begin) / 4);
      expected += static_cast<double>(energy) * SAMPLES;
      found += counts[i];
      if (expected >= 20 || i + 1 == BINS) {  // few a bin are no normal distribution
        sum += (found - expected) * (found - expected) / std::max(expected, 1.0);
        degrees += 1;
        expected = 0;
        found = 0;
      }
    }
    EXPECT_GE(degrees, 80) << one.label;
    EXPECT_LE(std::abs(deviate(sum, degrees)), DEVIATE_LIMIT)
        << one.label << ": " << sum << " of " << degrees;
  }
}

TEST_P(ParticleSample, FloatCurveInvertsTheDistribution) {
  constexpr double CDF_BOUND = 1e-5;
  constexpr int STEPS = 1 << 14;
  double worst = 0;
  for (const Sampled& one : casesOf(GetParam())) {
    const PhaseCurveF curve = roundPhaseCurve(one.particle.curve);
    for (int i = 0; i <= STEPS; ++i) {
      const float xi = static_cast<float>(i) / STEPS;
      const AxisAngleF sample = samplePhaseCurve(curve, one.channel, xi);
      ASSERT_TRUE(sample.y >= 0 && sample.y <= 1.002f) << one.label << " " << xi;
      const double fromAxis = static_cast<double>(sample.y);
      const double y = sample.backward ? 2 - fromAxis : fromAxis;
      const double error =
          std::abs(phaseCurveCdf(one.particle.curve, one.channel, y) - static_cast<double>(xi));
      worst = std::max(worst, error);
      ASSERT_LE(error, CDF_BOUND) << one.label << " " << xi;
    }
  }
  std::printf("%s: CDF error %.1e\n", particleKind(GetParam()).name, worst);
}

// Random numbers of every binade, about every power of two, and beyond [0, 1].
TEST_P(ParticleSample, EveryFloatGivesAnAngle) {
  std::vector<float> numbers = {
      0, 0.5f, 1, 1 - 0x1p-24f, std::numeric_limits<float>::denorm_min(), -0.0f, -1, 2};
  for (int power = -149; power <= 0; ++power) {
    const float base = std::ldexp(1.0f, power);
    for (const float part : {1.0f, 1.1f, 1.37f, 1.5f, 1.9f}) {
      numbers.push_back(base * part);
      numbers.push_back(1 - base * part);
    }
    numbers.push_back(std::nextafter(base, 0.0f));
  }
  for (int i = 0; i < 20000; ++i) {
    numbers.push_back(static_cast<float>(i) / 20000);
  }
  for (const Sampled& one : casesOf(GetParam())) {
    const PhaseCurveF curve = roundPhaseCurve(one.particle.curve);
    for (const float number : numbers) {
      const AxisAngleF sample = samplePhaseCurve(curve, one.channel, number);
      ASSERT_TRUE(sample.y >= 0 && sample.y <= 1.002f) << one.label << " " << number;
      const float density = evalPhaseCurve(curve, one.channel, sample);
      ASSERT_TRUE(std::isfinite(density) && density >= 0) << one.label << " " << number;
      if (number >= 0 && number < 1) {
        const double angle = sampleParticle(one.particle, one.channel, static_cast<double>(number));
        ASSERT_TRUE(angle >= 0 && angle <= PI) << one.label << " " << number;
        const double p = evalParticle(one.particle, one.channel, angle);
        ASSERT_TRUE(std::isfinite(p) && p >= 0) << one.label << " " << number;
      }
    }
  }
}

std::vector<ParticleType> everyType() {
  std::vector<ParticleType> types;
  for (uint32_t k = 0; k < PARTICLE_TYPES; ++k) {
    types.push_back(static_cast<ParticleType>(k));
  }
  return types;
}

std::string nameOf(const testing::TestParamInfo<ParticleType>& info) {
  std::string name = particleKind(info.param).name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Catalogue, ParticleSample, testing::ValuesIn(everyType()), nameOf);

}  // namespace
