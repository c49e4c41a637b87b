// SPDX-License-Identifier: MIT
// Phase functions of shaders/model/phase against the papers, and their float against their double.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "model/model.hpp"
#include "reference/phase_reference.hpp"

namespace {

namespace f32 = welkin::model::f32;
namespace f64 = welkin::model::f64;
using reference::Real;

constexpr double EPS_FLOAT = 0x1p-24;  // half an ulp of 1: relative error of one rounding
constexpr double EPS_DOUBLE = 0x1p-53;
// Roundings on the way to a phase value: 5 in the exponent of gap, 5 in oneMinusExp, both doubled
// because the peak is gap^-2; 6 in henyeyGreenstein, 5 in drainePhase, 4 in y, 3 in the blend.
constexpr double PHASE_ROUNDINGS = 2 * (5 + 5) + 6 + 5 + 4 + 3;  // x EPS_FLOAT = 2.3e-6
constexpr double FLOAT_BOUND = 2e-6;                             // what fog.glsl states
static_assert(FLOAT_BOUND <= PHASE_ROUNDINGS * EPS_FLOAT);

double relative(double value, double truth) {
  return std::abs(value / truth - 1);
}

double yOf(Real theta) {
  const Real s = std::sin(theta / 2);
  return static_cast<double>(2 * s * s);
}

// The reference subtracts: 1 + g^2 - 2 g cos in long double has 4 roundings of numbers near 2,
// against at least (1 - |g|)^2, and the power 3/2 multiplies that.
double referenceError(double g) {
  const double gap = 1 - std::abs(g);
  return 1.5 * 4 * 2 * 0x1p-64 / (gap * gap);
}

// Angles that cover the peak, the bulk and both ends.
std::vector<double> angles() {
  std::vector<double> result = {0, std::numbers::pi};
  for (double t = 1e-7; t < 3; t *= 1.02) {
    result.push_back(t);
    result.push_back(std::numbers::pi - t);
  }
  for (int i = 1; i < 200; ++i) {
    result.push_back(std::numbers::pi * i / 200);
  }
  return result;
}

TEST(FogPhase, FloatMatchesDoubleForEveryDiameterAndAngle) {
  std::mt19937 generator(7);
  std::normal_distribution<double> normal;
  const std::vector<double> thetas = angles();
  double worst = 0;
  float worstDiameter = 0;
  double worstAngle = 0;
  size_t pairs = 0;
  for (int i = 0; i <= 600; ++i) {
    const float d = static_cast<float>(5 * std::pow(10.0, i / 600.0));
    const f32::FogPhase p32 = f32::fogPhaseFromDiameter(d);
    const f64::FogPhase p64 = f64::fogPhaseFromDiameter(static_cast<double>(d));
    for (const double theta : thetas) {
      const glm::dvec3 a =
          glm::normalize(glm::dvec3(normal(generator), normal(generator), normal(generator)));
      const glm::dvec3 helper(normal(generator), normal(generator), normal(generator));
      const glm::dvec3 side = glm::normalize(glm::cross(a, helper));
      const glm::vec3 af(a);
      glm::vec3 bf(a * std::cos(theta) + side * std::sin(theta));
      if (theta == 0) {
        bf = af;
      } else if (theta == std::numbers::pi) {
        bf = -af;
      }
      // Both precisions get the same float vectors, so that only the arithmetic differs.
      const float value = f32::fogPhase(p32, f32::oneMinusCosine(af, bf));
      const double truth = f64::fogPhase(p64, f64::oneMinusCosine(glm::dvec3(af), glm::dvec3(bf)));
      const double error = relative(value, truth);
      ++pairs;
      if (!(error <= worst)) {
        worst = error;
        worstDiameter = d;
        worstAngle = theta;
      }
    }
  }
  EXPECT_GE(pairs, 1'000'000U);
  EXPECT_LE(worst, FLOAT_BOUND) << "at diameter " << worstDiameter << " um, angle " << worstAngle;
  RecordProperty("worst", std::to_string(worst * 1e9) + "e-9");
}

TEST(FogPhase, MatchesThePaperForEveryDiameterAndAngle) {
  double worst = 0;
  for (double d = 5; d <= 50; d += 0.5) {
    const f64::FogPhase p = f64::fogPhaseFromDiameter(d);
    const reference::Fog paper(d);
    for (const double theta : angles()) {
      const Real truth = paper(std::cos(static_cast<Real>(theta)));
      worst = std::max(worst, relative(f64::fogPhase(p, yOf(theta)), static_cast<double>(truth)));
    }
  }
  // The smallest 1 - g of the sweep is 0.00205, at 50 um.
  EXPECT_LE(worst, PHASE_ROUNDINGS * EPS_DOUBLE + referenceError(0.998));
}

TEST(FogPhase, IntegratesToOneForEveryDiameter) {
  for (double d = 5; d <= 50; d += 1.25) {
    const f64::FogPhase p64 = f64::fogPhaseFromDiameter(d);
    const f32::FogPhase p32 = f32::fogPhaseFromDiameter(static_cast<float>(d));
    const Real sum64 = reference::integrateSphere(
        [&](Real theta) { return static_cast<Real>(f64::fogPhase(p64, yOf(theta))); });
    const Real sum32 = reference::integrateSphere([&](Real theta) {
      return static_cast<Real>(f32::fogPhase(p32, static_cast<float>(yOf(theta))));
    });
    const double quadrature = 1e-10;  // 8 points on panels of 0.3 theta
    EXPECT_NEAR(static_cast<double>(sum64), 1, quadrature) << d;
    EXPECT_NEAR(static_cast<double>(sum32), 1, FLOAT_BOUND) << d;
  }
}

TEST(FogPhase, DiametersOutsideTheFitAreClamped) {
  EXPECT_EQ(f64::fogPhaseFromDiameter(1.0).gHg, f64::fogPhaseFromDiameter(5.0).gHg);
  EXPECT_EQ(f64::fogPhaseFromDiameter(1e3).gapHg, f64::fogPhaseFromDiameter(50.0).gapHg);
  EXPECT_NE(f64::fogPhaseFromDiameter(5.5).gHg, f64::fogPhaseFromDiameter(5.0).gHg);
}

TEST(HenyeyGreenstein, MatchesTheClassicalFormForBothSignsOfG) {
  for (const double g : {-0.9, -0.5, 0.0, 0.1, 0.85, 0.99}) {
    for (const double theta : angles()) {
      const Real truth = reference::henyeyGreenstein(g, std::cos(static_cast<Real>(theta)));
      // yOf has 3 roundings of numbers up to 2, which a backward peak sees as they are: power 3/2
      // of h^2 + 2 |g| (2 - y). Everything else is 10 roundings.
      const double condition = g < 0 ? 1.5 * 2 * -g * 3 * 2 / ((1 + g) * (1 + g)) : 0;
      EXPECT_NEAR(f64::henyeyGreenstein(g, 1 - g, yOf(theta)) / static_cast<double>(truth), 1,
                  (10 + condition) * EPS_DOUBLE + referenceError(g))
          << g << " " << theta;
    }
  }
}

TEST(HenyeyGreenstein, BackwardPeakIsTheMirroredForwardPeak) {
  for (const double y : {0.0, 0.3, 1.0, 1.7, 2.0}) {
    const double forward = f64::henyeyGreenstein(0.7, 0.3, y);
    EXPECT_NEAR(f64::henyeyGreenstein(-0.7, 1.7, 2 - y) / forward, 1, 100 * EPS_DOUBLE);
  }
}

TEST(HenyeyGreenstein, FloatIsAccurateAndPositiveForExtremeG) {
  for (const float g : {-0.999f, -0.99f, -0.3f, 0.3f, 0.99f, 0.999f}) {
    const f32::FogPhase p32 = f32::henyeyGreensteinOnly(g);
    const f64::FogPhase p64 = f64::henyeyGreensteinOnly(static_cast<double>(g));
    for (const double theta : angles()) {
      const float y = static_cast<float>(yOf(theta));
      const double truth = f64::fogPhase(p64, static_cast<double>(y));
      // 12 roundings; for the mirrored peak also 1 + g, which is exact from |g| = 1/2 on.
      EXPECT_NEAR(f32::fogPhase(p32, y) / truth, 1, 14 * EPS_FLOAT) << g << " " << theta;
    }
    // |a - b|^2 / 2 of vectors that are unit to float rounding reaches 2 (1 + 4 eps).
    const float beyond = 2 * (1 + 8 * static_cast<float>(EPS_FLOAT));
    const float value = f32::fogPhase(p32, beyond);
    EXPECT_TRUE(std::isfinite(value) && value > 0) << g;
  }
}

TEST(Draine, IsHenyeyGreensteinAtAlphaZeroAndCornetteShanksAtAlphaOne) {
  for (const double g : {-0.4, 0.2, 0.6, 0.95}) {
    for (const double theta : angles()) {
      const Real c = std::cos(static_cast<Real>(theta));
      const double y = yOf(theta);
      EXPECT_EQ(f64::drainePhase(g, 1 - g, 0.0, y), f64::henyeyGreenstein(g, 1 - g, y));
      const double truth = static_cast<double>(reference::cornetteShanks(g, c));
      EXPECT_NEAR(f64::drainePhase(g, 1 - g, 1.0, y) / truth, 1, 30 * EPS_DOUBLE);
    }
  }
}

TEST(Rayleigh, MatchesThePaperAndIntegratesToOne) {
  const f64::FogPhase draine = f64::rayleighAsDraine();
  for (const double theta : angles()) {
    const double truth =
        static_cast<double>(reference::rayleigh(std::cos(static_cast<Real>(theta))));
    const double y = yOf(theta);
    EXPECT_NEAR(f64::rayleighPhase(y) / truth, 1, 6 * EPS_DOUBLE);
    EXPECT_NEAR(f64::fogPhase(draine, y) / truth, 1, 12 * EPS_DOUBLE);
    EXPECT_NEAR(f32::rayleighPhase(static_cast<float>(y)) / truth, 1, 6 * EPS_FLOAT);
  }
  const Real sum = reference::integrateSphere(
      [](Real theta) { return static_cast<Real>(f64::rayleighPhase(yOf(theta))); });
  EXPECT_NEAR(static_cast<double>(sum), 1, 1e-12);  // polynomial: quadrature is exact
}

TEST(OneMinusCosine, IsAccurateForTinyAngles) {
  std::mt19937 generator(11);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 20000; ++i) {
    const glm::dvec3 a =
        glm::normalize(glm::dvec3(normal(generator), normal(generator), normal(generator)));
    const glm::dvec3 side(normal(generator), normal(generator), normal(generator));
    const glm::vec3 af(a);
    const glm::vec3 bf(glm::normalize(a + side * std::pow(10.0, -(i % 70) / 10.0)));
    const glm::dvec3 difference = glm::dvec3(af) - glm::dvec3(bf);
    const double truth = 0.5 * glm::dot(difference, difference);
    if (truth > 0) {
      // One rounding per difference, doubled by the square, and three for the sum.
      EXPECT_NEAR(f32::oneMinusCosine(af, bf) / truth, 1, (2 + 3) * EPS_FLOAT);
    }
  }
  const glm::vec3 up(0.6f, 0.0f, 0.8f);
  EXPECT_EQ(f32::oneMinusCosine(up, up), 0.0f);
  EXPECT_EQ(f32::oneMinusCosine(up, -up), 2.0f);
}

}  // namespace
