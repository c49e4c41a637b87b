// SPDX-License-Identifier: MIT
// Samples of shaders/model/phase/sample.glsl against the distributions of the papers' formulas.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "model/model.hpp"
#include "particles/fog_phase.hpp"
#include "reference/phase_reference.hpp"

namespace {

namespace f32 = welkin::model::f32;
namespace f64 = welkin::model::f64;
using reference::Real;

constexpr float LAST = 1 - 0x1p-24f;   // the largest float below 1
constexpr double CDF_BOUND = 4e-6;     // what sample.glsl states, in float
constexpr double EPS_FLOAT = 0x1p-24;  // half an ulp of 1
constexpr double EPS_LONG = 0x1p-64;

// Part of Draine's phase function [J23] Eq. 2 with cos > 1 - y, by its antiderivative in
// v = 1 + g^2 - 2 g cos, for g = 1 - gap: near 1, gap is the number that counts. The antiderivative
// divides by g^3, so Simpson's rule for small g.
Real draineCdf(Real gap, Real alpha, Real y) {
  const Real g = 1 - gap;
  if (std::abs(g) < 0.05L) {
    constexpr int PANELS = 40;  // the integrand is a parabola up to g: error < 1e-7
    Real sum = 0;
    for (int i = 0; i <= PANELS; ++i) {
      const Real factor = i == 0 || i == PANELS ? 1 : (i % 2 == 1 ? 4 : 2);
      sum += factor * reference::draine(alpha, g, 1 - y * i / PANELS);
    }
    return 2 * reference::PI * sum * y / PANELS / 3;
  }
  const Real a = 1 + g * g;
  const auto antiderivative = [&](Real v) {
    const Real root = std::sqrt(v);
    const Real square = -2 * a * a / root - 4 * a * root + 2 * v * root / 3;
    return -2 / root + alpha / (4 * g * g) * square;
  };
  const Real norm = 1 + alpha * (1 + 2 * g * g) / 3;
  const Real v = gap * gap + 2 * g * y;
  return (1 - g * g) / (4 * g * norm) * (antiderivative(v) - antiderivative(gap * gap));
}

Real fogCdf(const f64::FogPhase& p, Real y) {
  const Real peak = draineCdf(p.gapHg, 0, y);
  return (1 - static_cast<Real>(p.weightD)) * peak +
         static_cast<Real>(p.weightD) * draineCdf(p.gapD, p.alpha, y);
}

f32::FogPhase rounded(const f64::FogPhase& p) {
  f32::FogPhase result;
  result.gHg = static_cast<float>(p.gHg);
  result.gapHg = static_cast<float>(p.gapHg);
  result.gD = static_cast<float>(p.gD);
  result.gapD = static_cast<float>(p.gapD);
  result.alpha = static_cast<float>(p.alpha);
  result.weightD = static_cast<float>(p.weightD);
  return result;
}

// Diameters from 0 to 50 um, through the bands and both zeros of gD.
std::vector<double> diameters() {
  std::vector<double> result = {0, 0.1436, 0.1744, 50};
  for (double d = 1e-3; d < 50; d *= 1.06) {
    result.push_back(d);
  }
  return result;
}

double cdfError(float gap, float alpha, float y, float xi) {
  return std::abs(static_cast<double>(draineCdf(gap, alpha, y) - static_cast<Real>(xi)));
}

TEST(PhaseSample, FloatInvertsTheDistributionForEveryG) {
  double worst = 0;
  for (const float g : {-0.5f, -0.1f, -1e-3f, 0.0f, 1e-7f, 1e-3f, 0.0499f, 0.0501f, 0.2f, 0.5f,
                        0.7f, 0.9f, 0.99f, 0.999f, 0.9999f}) {
    const float gap = 1 - g;
    for (const float alpha : {0.0f, 1e-4f, 0.1f, 1.0f, 17.0f, 32.0f, 250.0f, 1000.0f}) {
      for (int i = 0; i < 250; ++i) {
        const float xi = (static_cast<float>(i) + 0.37f) / 250;
        const double error = cdfError(gap, alpha, f32::sampleDraine(g, gap, alpha, xi), xi);
        EXPECT_LE(error, CDF_BOUND) << g << " " << alpha << " " << xi;
        worst = std::max(worst, error);
        if (alpha == 0) {
          const float y = f32::sampleHenyeyGreenstein(g, gap, xi);
          EXPECT_LE(cdfError(gap, 0, y, xi), CDF_BOUND) << g << " " << xi;
        }
      }
    }
  }
  RecordProperty("worst", std::to_string(worst * 1e9) + "e-9");
}

TEST(PhaseSample, FloatInvertsBothLobesOfEveryDiameter) {
  double worst = 0;
  for (const double d : diameters()) {
    const f32::FogPhase p = rounded(f64::fogPhaseFromDiameter(d));
    for (int i = 0; i < 200; ++i) {
      const float xi = (static_cast<float>(i) + 0.61f) / 200;
      const float peak = f32::sampleHenyeyGreenstein(p.gHg, p.gapHg, xi);
      const float bulk = f32::sampleDraine(p.gD, p.gapD, p.alpha, xi);
      const double error =
          std::max(cdfError(p.gapHg, 0, peak, xi), cdfError(p.gapD, p.alpha, bulk, xi));
      EXPECT_LE(error, CDF_BOUND) << d << " " << xi;
      worst = std::max(worst, error);
    }
  }
  RecordProperty("worst", std::to_string(worst * 1e9) + "e-9");
}

// Henyey-Greenstein of any g by its end of the axis; the blends are drawn as before.
TEST(PhaseSample, BackwardPeaksAreAsExactAsForwardOnes) {
  double worst = 0;
  for (const double g : {-0.9999, -0.99, -0.95, -0.7, -0.3, 0.3, 0.95}) {
    const f32::FogPhase p = rounded(f64::henyeyGreensteinOnly(g));
    for (int i = 0; i < 500; ++i) {
      const float xi = (static_cast<float>(i) + 0.43f) / 500;
      const f32::AxisAngle a = f32::sampleFogPhaseAxis(p, xi);
      ASSERT_EQ(a.side, g < 0 ? -1.0f : 1.0f);
      // The energy from that end: mirrored, g has the other sign.
      const auto gap = static_cast<Real>(1 - std::abs(static_cast<double>(p.gHg)));
      const Real energy = draineCdf(gap, 0, static_cast<Real>(a.y));
      const Real expected = g < 0 ? 1 - static_cast<Real>(xi) : static_cast<Real>(xi);
      const auto error = static_cast<double>(std::abs(energy - expected));
      EXPECT_LE(error, CDF_BOUND) << g << " " << xi;
      worst = std::max(worst, error);
    }
  }
  RecordProperty("worst", std::to_string(worst * 1e9) + "e-9");
  const f32::FogPhase fog = rounded(f64::fogPhaseFromDiameter(10));
  EXPECT_EQ(f32::sampleFogPhaseAxis(fog, 0.7f).y, f32::sampleFogPhase(fog, 0.7f));
  EXPECT_EQ(f32::sampleFogPhaseAxis(fog, 0.7f).side, 1.0f);
}

TEST(PhaseSample, DoubleInvertsTheDistribution) {
  for (const double g : {-0.5, 0.1, 0.3, 0.6, 0.9, 0.99}) {
    for (const double alpha : {0.0, 1.0, 30.0, 250.0, 1000.0}) {
      for (int i = 0; i < 200; ++i) {
        const double xi = (i + 0.5) / 200;
        const double y = f64::sampleDraine(g, 1 - g, alpha, xi);
        // The last step is 2e-7 at most, and convergence cubic: rounding remains, of 30 operations,
        // amplified by the density in u, <= 3, and by 1 / gap where y is computed. Truth: terms of
        // 1 / (4 g^3), 20 roundings.
        const double rounding = 3 * 30 * 0x1p-53 / (1 - std::abs(g));
        const double truth = 20 * EPS_LONG / std::pow(std::abs(g), 3);
        EXPECT_NEAR(static_cast<double>(draineCdf(1 - static_cast<Real>(g), alpha, y)), xi,
                    rounding + truth)
            << g << " " << alpha;
      }
    }
  }
}

// Small angles: y is xi over the density at 0, to the last digits.
TEST(PhaseSample, TinyAnglesKeepTheirRelativePrecision) {
  for (const float g : {-0.5f, 0.0f, 0.6f, 0.99f, 0.9999f}) {
    const float gap = 1 - g;
    for (const float alpha : {0.0f, 1.0f, 30.0f, 250.0f}) {
      for (const float xi : {1e-8f, 1e-12f, 1e-20f, 1e-30f}) {
        const double density = static_cast<double>(
            2 * reference::PI * f64::drainePhase(g, static_cast<double>(gap), alpha, 0));
        const double y = f32::sampleDraine(g, gap, alpha, xi);
        // 20 roundings, the step of 2e-7 at which it ends, and curvature: xi (alpha + 3 / gap).
        const double bound = 20 * EPS_FLOAT + 2e-7 + 1000 * static_cast<double>(xi);
        EXPECT_NEAR(y * density / static_cast<double>(xi), 1, bound) << g << " " << alpha;
      }
    }
  }
}

template <typename T>
std::vector<T> extremeNumbers() {
  using Limits = std::numeric_limits<T>;
  std::vector<T> result = {0,
                           Limits::denorm_min(),
                           Limits::min(),
                           T(0x1p-60),
                           T(0.5),
                           T(LAST),
                           1 - Limits::epsilon() / 2,
                           1};
  for (int i = 1; i < 512; ++i) {
    result.push_back(static_cast<T>(i) / 512);
    result.push_back(std::pow(T(0.9), static_cast<T>(i)));
    result.push_back(1 - std::pow(T(0.95), static_cast<T>(i)));
  }
  return result;
}

TEST(PhaseSample, EveryInputGivesAnAngle) {
  for (const double g : {-0.99, -0.9, -0.5, -0.03, -1e-5, -1e-20, 0.0, 1e-30, 1e-5, 0.03, 0.3, 0.6,
                         0.9, 0.97, 0.99, 0.998, 0.9999}) {
    for (const double alpha : {0.0, 1e-20, 1e-4, 0.1, 1.0, 17.0, 32.0, 250.0, 1000.0}) {
      const float gF = static_cast<float>(g);
      const float alphaF = static_cast<float>(alpha);
      for (const float xi : extremeNumbers<float>()) {
        const float y = f32::sampleDraine(gF, 1 - gF, alphaF, xi);
        ASSERT_TRUE(y >= 0 && y <= 2) << g << " " << alpha << " " << xi;
        const float peak = f32::sampleHenyeyGreenstein(gF, 1 - gF, xi);
        ASSERT_TRUE(peak >= 0 && peak <= 2) << g << " " << xi;
      }
      for (const double xi : extremeNumbers<double>()) {
        const double y = f64::sampleDraine(g, 1 - g, alpha, xi);
        ASSERT_TRUE(y >= 0 && y <= 2) << g << " " << alpha << " " << xi;
      }
    }
  }
  std::vector<f32::FogPhase> blends = {f32::rayleighAsDraine(), f32::henyeyGreensteinOnly(0.9f),
                                       f32::henyeyGreensteinOnly(-0.9f)};
  for (const double d : diameters()) {
    blends.push_back(f32::fogPhaseFromDiameter(static_cast<float>(d)));
  }
  for (const f32::FogPhase& p : blends) {
    for (const float xi : extremeNumbers<float>()) {
      const float y = f32::sampleFogPhase(p, xi);
      ASSERT_TRUE(y >= 0 && y <= 2) << p.gHg << " " << xi;
      const float density = f32::fogPhase(p, y);
      ASSERT_TRUE(std::isfinite(density) && density > 0) << p.gHg << " " << xi;
    }
  }
}

// Normal deviate of a chi-square sum (Wilson and Hilferty 1931).
double deviate(double sum, double degrees) {
  const double spread = 2 / (9 * degrees);
  return (std::cbrt(sum / degrees) - (1 - spread)) / std::sqrt(spread);
}
constexpr double DEVIATE_LIMIT = 3.09;  // p > 1e-3

TEST(PhaseSample, AMillionSamplesHaveTheDensityOfTheBlend) {
  constexpr int SAMPLES = 1'000'000;
  constexpr size_t BINS = 200;
  std::vector<f64::FogPhase> blends = {f64::rayleighAsDraine(), f64::henyeyGreensteinOnly(-0.7)};
  for (const double d : {0.05, 0.16, 0.5, 2.0, 10.0, 50.0}) {
    blends.push_back(f64::fogPhaseFromDiameter(d));
  }
  std::mt19937 generator(2023);
  for (const f64::FogPhase& blend : blends) {
    const f32::FogPhase p = rounded(blend);
    std::vector<int> counts(BINS);
    for (int i = 0; i < SAMPLES; ++i) {
      const float xi = static_cast<float>(generator() >> 8) * 0x1p-24f;
      const float s = f32::phaseCoordinate(f32::sampleFogPhase(p, xi));
      ++counts[std::min(static_cast<size_t>(s * static_cast<float>(BINS)), BINS - 1)];
    }
    double sum = 0;
    double degrees = -1;
    double before = 0;
    double expected = 0;
    double found = 0;
    for (size_t i = 0; i < BINS; ++i) {
      const double edge = static_cast<double>(i + 1) / static_cast<double>(BINS);
      const double after = static_cast<double>(fogCdf(blend, f64::curveNode(edge)));
      expected += (after - before) * SAMPLES;
      found += counts[i];
      before = after;
      if (expected >= 20 || i + 1 == BINS) {  // few a bin are no normal distribution
        sum += (found - expected) * (found - expected) / std::max(expected, 1.0);
        degrees += 1;
        expected = 0;
        found = 0;
      }
    }
    EXPECT_GE(degrees, 90);
    EXPECT_LE(std::abs(deviate(sum, degrees)), DEVIATE_LIMIT)
        << blend.gHg << ": " << sum << " of " << degrees;
  }
}

TEST(DirectionFromY, IsAUnitVectorAtItsAngle) {
  std::mt19937 generator(5);
  std::normal_distribution<double> normal;
  std::vector<glm::dvec3> all = {{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {0, -1, 0}, {0.6, 0, -0.8}};
  for (int i = 0; i < 3000; ++i) {
    const double squeeze = std::pow(10.0, -(i % 8));  // many near both poles
    all.emplace_back(squeeze * normal(generator), squeeze * normal(generator), normal(generator));
  }
  std::uniform_real_distribution<float> uniform(0, 1);
  for (const glm::dvec3& one : all) {
    const glm::vec3 forward(glm::normalize(one));
    const float y = 2 * uniform(generator);
    const float azimuth = 2 * std::numbers::pi_v<float> * uniform(generator);
    const glm::dvec3 result(f32::directionFromY(forward, y, azimuth));
    // 12 roundings of numbers up to 2; the length of forward itself has 3.
    EXPECT_NEAR(glm::length(result), 1, (12 + 3) * EPS_FLOAT);
    EXPECT_NEAR(f64::oneMinusCosine(glm::dvec3(forward), result), static_cast<double>(y),
                2 * (12 + 3) * EPS_FLOAT);
  }
}

TEST(DirectionFromY, TurnsOnceAroundTheForwardDirection) {
  for (const glm::dvec3& one : {glm::dvec3(0, 0, 1), glm::dvec3(0, 0, -1), glm::dvec3(1, 2, -3)}) {
    const glm::dvec3 forward = glm::normalize(one);
    const glm::dvec3 side = f64::directionFromY(forward, 1.0, 0.0);
    const glm::dvec3 up = glm::cross(forward, side);
    for (int i = 0; i < 12; ++i) {
      const double azimuth = i * std::numbers::pi / 6;
      const glm::dvec3 found = f64::directionFromY(forward, 1.0, azimuth);
      const glm::dvec3 truth = std::cos(azimuth) * side + std::sin(azimuth) * up;
      EXPECT_LE(glm::length(found - truth), 20 * 0x1p-53);
    }
  }
  const glm::vec3 forward(0.6f, 0.0f, -0.8f);
  EXPECT_EQ(f32::directionFromY(forward, 0.0f, 1.0f), forward);
}

}  // namespace
