// SPDX-License-Identifier: MIT
// Phase functions of shaders/model/phase against the papers, and their float against their double.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "model/model.hpp"
#include "particles/mie_average.hpp"
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
  EXPECT_EQ(f64::fogPhaseFromDiameter(-1.0).weightD, f64::fogPhaseFromDiameter(0.0).weightD);
  EXPECT_EQ(f64::fogPhaseFromDiameter(1e3).gapHg, f64::fogPhaseFromDiameter(50.0).gapHg);
  EXPECT_NE(f64::fogPhaseFromDiameter(5.5).gHg, f64::fogPhaseFromDiameter(5.0).gHg);
}

// [J23], supplemental, Eq. 7-22, as printed; diameter in um.
struct SmallFog {
  Real gHg, gD, alpha, weight;
  explicit SmallFog(Real d) {
    const Real l = std::log(d);
    if (d <= 0.1L) {
      gHg = 13.8L * d * d;
      gD = 1.1456L * d * std::sin(9.29044L * d);
      alpha = 250;
      weight = 0.252977L - 312.983L * std::pow(d, 4.3L);
    } else if (d < 1.5L) {
      gHg = 0.862L - 0.143L * l * l;
      const Real inner = (l - 0.238604L) * (l + 1.00667L) / (0.507522L - 0.15677L * l);
      gD = 0.379685L * std::cos(1.19692L * std::cos(inner) + 1.37932L * l + 0.0625835L) + 0.344213L;
      alpha = 250;
      weight = 0.146209L * std::cos(3.38707L * l + 2.11193L) + 0.316072L + 0.0778917L * l;
    } else {
      gHg = 0.0604931L * std::log(l) + 0.940256L;
      gD = 0.500411L - 0.081287L / (-2 * l + std::tan(l) + 1.27551L);
      alpha = 7.30354L * l + 6.31675L;
      weight = 0.026914L * (l - std::cos(5.68947L * (std::log(l) - 0.0292149L))) + 0.376475L;
    }
  }
};

TEST(SmallDroplets, ParametersAreThePapersOutsideTheBands) {
  for (const double d : {1e-3, 0.02, 0.05, 0.099, 0.131, 0.1436, 0.16, 0.1744, 0.3, 0.7, 1.0, 1.19,
                         1.51, 2.0, 3.0, 3.99}) {
    const SmallFog paper(d);
    const f64::FogPhase p = f64::fogPhaseFromDiameter(d);
    // 20 roundings, of numbers up to 20 (the argument of the cosine); those of alpha up to 250.
    EXPECT_NEAR(p.gHg, static_cast<double>(paper.gHg), 20 * EPS_DOUBLE) << d;
    EXPECT_NEAR(p.gapHg, static_cast<double>(1 - paper.gHg), 20 * EPS_DOUBLE) << d;
    EXPECT_NEAR(p.gD, static_cast<double>(paper.gD), 400 * EPS_DOUBLE) << d;
    EXPECT_NEAR(p.gapD, static_cast<double>(1 - paper.gD), 400 * EPS_DOUBLE) << d;
    EXPECT_NEAR(p.alpha, static_cast<double>(paper.alpha), 250 * EPS_DOUBLE) << d;
    EXPECT_NEAR(p.weightD, static_cast<double>(paper.weight), 100 * EPS_DOUBLE) << d;
  }
}

TEST(SmallDroplets, DoNotPopAsTheDiameterChanges) {
  constexpr double STEP = 2e-3;  // of ln d
  double steepest = 0;
  std::vector<double> before;
  for (double d = 0.05; d < 7; d *= std::exp(STEP)) {
    const f64::FogPhase p = f64::fogPhaseFromDiameter(d);
    std::vector<double> now;
    for (int i = 0; i <= 90; ++i) {
      now.push_back(std::log(f64::fogPhase(p, 1 - std::cos(i * std::numbers::pi / 90))));
    }
    for (size_t i = 0; i < before.size(); ++i) {
      steepest = std::max(steepest, std::abs(now[i] - before[i]) / STEP);
    }
    before = now;
  }
  // The forward peak of 1.5..5 um grows by 3.1 per unit of ln d, and the bands may add half of
  // that.
  EXPECT_LE(steepest, 1.5 * 3.1);
  RecordProperty("steepest", std::to_string(steepest));
  for (const double edge : {0.1, 0.13, 1.2, 1.5, 4.0, 5.0}) {
    const f64::FogPhase left = f64::fogPhaseFromDiameter(edge * (1 - 1e-7));
    const f64::FogPhase right = f64::fogPhaseFromDiameter(edge * (1 + 1e-7));
    for (const double y : {0.0, 0.1, 1.0, 2.0}) {
      EXPECT_NEAR(f64::fogPhase(left, y) / f64::fogPhase(right, y), 1, 1e-6) << edge << " " << y;
    }
  }
}

// The two fits that meet in the band at or next to d.
std::pair<f64::FogPhase, f64::FogPhase> fitsAbout(double d) {
  const double l = std::log(d);
  if (d < 1) {
    return {f64::fogFitTiny(d), f64::fogFitSmall(l)};
  }
  return d < 4 ? std::pair(f64::fogFitSmall(l), f64::fogFitMiddle(l))
               : std::pair(f64::fogFitMiddle(l), f64::fogFitLarge(d));
}

TEST(SmallDroplets, BandsStayBetweenTheirFits) {
  for (const auto& [begin, end] :
       {std::pair(0.1, 0.13), std::pair(1.2, 1.5), std::pair(4.0, 5.0)}) {
    for (double d = begin; d < end; d *= 1.01) {
      const auto [a, b] = fitsAbout(d);
      const f64::FogPhase p = f64::fogPhaseFromDiameter(d);
      for (double y = 0; y <= 2; y += 0.01) {
        const auto [low, high] = std::minmax({f64::fogPhase(a, y), f64::fogPhase(b, y)});
        EXPECT_GE(f64::fogPhase(p, y), low / 1.05) << d << " " << y;
        EXPECT_LE(f64::fogPhase(p, y), high * 1.05) << d << " " << y;
      }
    }
  }
}

TEST(SmallDroplets, AreNormalisedAndAccurateInFloat) {
  for (double d = 0; d < 5; d = d * 1.07 + 1e-3) {
    const f64::FogPhase p = f64::fogPhaseFromDiameter(d);
    EXPECT_TRUE(p.weightD > 0 && p.weightD < 1 && p.gHg >= 0 && p.gHg < 1 && p.gD > -0.04) << d;
    const Real sum = reference::integrateSphere(
        [&](Real theta) { return static_cast<Real>(f64::fogPhase(p, yOf(theta))); });
    EXPECT_NEAR(static_cast<double>(sum), 1, 1e-10) << d;
    const float dF = static_cast<float>(d);
    const f32::FogPhase p32 = f32::fogPhaseFromDiameter(dF);
    const f64::FogPhase p64 = f64::fogPhaseFromDiameter(static_cast<double>(dF));
    for (int i = 0; i <= 90; ++i) {
      const float y = static_cast<float>(1 - std::cos(i * std::numbers::pi / 90));
      // gapHg has 1 / 0.04 ulp (4 um), doubled at the peak; the rest as above 5 um.
      EXPECT_NEAR(f32::fogPhase(p32, y) / f64::fogPhase(p64, static_cast<double>(y)), 1,
                  (2 * 25 + PHASE_ROUNDINGS) * EPS_FLOAT)
          << d << " " << i;
    }
  }
}

TEST(SmallDroplets, AreRayleighScatterersInTheLimit) {
  for (const double theta : angles()) {
    const double truth = f64::rayleighPhase(yOf(theta));
    EXPECT_NEAR(f64::fogPhase(f64::fogPhaseFromDiameter(0.0), yOf(theta)) / truth, 1, 2e-4);
    // g = 13.8 d^2 = 1.4e-3, of which 3 g cos theta is the first order; and gD = 1.1e-3.
    EXPECT_NEAR(f64::fogPhase(f64::fogPhaseFromDiameter(0.01), yOf(theta)) / truth, 1, 0.01);
  }
}

// Integral of |cos| sin (ln P / Mie)^2 over the angle, [J23] Eq. 1: water of index 1.333, mean of
// the phase functions of 12 wavelengths in 400..700 nm, diameters log-normal with spread 0.25.
class MieError {
 public:
  explicit MieError(double diameter_um) {
    for (size_t i = 0; i < COUNT; ++i) {
      angles_.push_back((static_cast<double>(i) + 0.5) * std::numbers::pi / COUNT);
    }
    welkin::MieSettings settings;
    settings.nodesPerSpread = 64;  // E is within 1 % of that with 512
    const welkin::SizeDistribution sizes = {welkin::SizeKind::LogNormal, diameter_um / 2, 0.25};
    mie_.assign(COUNT, 0);
    for (welkin::SpectralSample sample : welkin::waterSamples(0.4, 0.7, 12, 10)) {
      sample.index = 1.333;
      const auto mie = averageMie(sizes, std::span(&sample, 1), angles_, settings);
      for (size_t i = 0; i < COUNT; ++i) {
        mie_[i] += mie.phase[i] / 12;
      }
    }
  }

  double of(const f64::FogPhase& p) const {
    double sum = 0;
    for (size_t i = 0; i < COUNT; ++i) {
      const double t = angles_[i];
      const double error = std::log(f64::fogPhase(p, yOf(t)) / mie_[i]);
      sum += std::abs(std::cos(t)) * std::sin(t) * error * error * std::numbers::pi / COUNT;
    }
    return sum;
  }

 private:
  static constexpr size_t COUNT = 900;
  std::vector<double> angles_, mie_;
};

TEST(SmallDroplets, AreAsCloseToMieAsTheFitsArePublished) {
  // E of the published maps, computed with another Mie code and 0.1 degrees.
  const std::vector<std::pair<double, double>> known = {{0.2, 0.0105}, {0.5, 0.0532}, {1, 0.0174},
                                                        {2, 0.0368},   {3, 0.0666},   {4, 0.0754}};
  for (const auto& [d, truth] : known) {
    EXPECT_NEAR(MieError(d).of(f64::fogPhaseFromDiameter(d)) / truth, 1, 0.1) << d;
  }
  EXPECT_LE(MieError(0.1).of(f64::fogPhaseFromDiameter(0.1)), 1e-4);
}

TEST(SmallDroplets, AreNoWorseInTheBandsThanTheWorseFit) {
  for (const double d : {0.11, 0.12, 1.28, 1.35, 1.42, 4.5}) {
    const MieError error(d);
    const auto [a, b] = fitsAbout(d);
    EXPECT_LE(error.of(f64::fogPhaseFromDiameter(d)), 1.3 * std::max(error.of(a), error.of(b)))
        << d;
  }
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
