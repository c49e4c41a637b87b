// SPDX-License-Identifier: MIT
// src/particles/phase_curve and shaders/model/phase/curve.glsl against closed forms, quadrature and
// the functions they tabulate.
#include "particles/phase_curve.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "model/model.hpp"
#include "particles/fog_phase.hpp"
#include "reference/phase_reference.hpp"
#include "tables/multiscatter.hpp"

namespace {

using namespace welkin;
using reference::Real;
namespace f32 = model::f32;
namespace f64 = model::f64;

constexpr double PI = std::numbers::pi;
constexpr double EPS = 0x1p-53;
constexpr double EPS_FLOAT = 0x1p-24;
constexpr size_t NODES = f64::CURVE_NODES;

PhaseCurve curveOf(const FogPhaseParams& p) {
  return makePhaseCurve([&](size_t, double y) { return evalPhase(p, y); });
}

FogPhaseParams fog(double diameter_um) {
  return phaseParameters(PhaseKind::HgDraine, diameter_um, 0);
}

FogPhaseParams henyeyGreenstein(double g) {
  return phaseParameters(PhaseKind::HenyeyGreenstein, 0, g);
}

double yOf(Real theta) {
  const Real s = std::sin(theta / 2);
  return static_cast<double>(2 * s * s);
}

// y of a sample, in [0, 2]; the double keeps what the float counts from behind.
double yOf(AxisAngleF a) {
  EXPECT_TRUE(a.y >= 0 && a.y <= 1.002f) << a.y;
  const auto y = static_cast<double>(a.y);
  return a.backward ? 2 - y : y;
}

// A rainbow of 2 degrees width, 20 times its surroundings, a glory and a forward peak; 1/sr up to a
// factor.
double rainbow(double y) {
  const double theta = 2 * std::asin(std::sqrt(std::min(y / 2, 1.0))) * 180 / PI;
  const double bow = (theta - 138) / 2;
  const double back = (180 - theta) / 1.5;
  return f64::henyeyGreenstein(0.97, 0.03, y) + 0.005 + 0.1 * std::exp(-bow * bow) +
         0.05 * std::exp(-back * back);
}

TEST(PhaseCurve, NodesInvertTheTableCoordinate) {
  for (size_t i = 0; i < NODES; ++i) {
    const double s = static_cast<double>(i) / (NODES - 1);
    const double y = f64::curveNode(s);
    // Forward: ds/s = dy / (4 y). Backward y itself is rounded near 2, where s goes by its root.
    const double rounding = s < 0.5 ? 16 * EPS : std::min(8 * EPS / std::pow(1.002 - s, 3), 2e-4);
    EXPECT_NEAR(f64::phaseCoordinate(y), s, rounding) << i;
    EXPECT_NEAR(f64::curveNode(1 - s), 2 - y, 32 * EPS) << i;  // 20 roundings, fourfold
    EXPECT_NEAR(phaseNode(s), y, 1e-12 * y) << i;              // cancels near s = 0
    const float sF = static_cast<float>(s);
    const double same = f64::curveNode(static_cast<double>(sF));
    // 20 roundings, those of a fourfold: 2e-6, as curve.glsl states.
    EXPECT_NEAR(f32::curveNode(sF), same, 2e-6 * std::min(same, 1.0)) << i;
  }
  EXPECT_EQ(f64::curveNode(0.0), 0.0);
  EXPECT_EQ(f64::curveNode(1.0), 2.0);
}

// The integral of a piecewise linear function, added up independently in long double.
TEST(PhaseCurve, IntegratesToOneAndItsEnergiesMeet) {
  for (const double d : {0.0, 0.3, 5.0, 50.0}) {
    const PhaseCurve curve = curveOf(fog(d));
    for (size_t c = 0; c < kCurveChannels; ++c) {
      Real sum = 0;
      for (size_t i = 0; i + 1 < NODES; ++i) {
        const Real width = static_cast<Real>(curve.y[i + 1]) - static_cast<Real>(curve.y[i]);
        const Real mean =
            (static_cast<Real>(curve.value[c][i]) + static_cast<Real>(curve.value[c][i + 1])) / 2;
        EXPECT_NEAR(curve.cdf[c][i], static_cast<double>(2 * reference::PI * sum), NODES * EPS);
        EXPECT_NEAR(curve.cdf[c][i] + curve.tail[c][i], 1, 2 * NODES * EPS) << i;
        EXPECT_LE(curve.cdf[c][i], curve.cdf[c][i + 1]);
        EXPECT_GE(curve.tail[c][i], curve.tail[c][i + 1]);
        sum += width * mean;
      }
      EXPECT_NEAR(static_cast<double>(2 * reference::PI * sum), 1, NODES * EPS) << d;
      EXPECT_EQ(curve.cdf[c][NODES - 1], 1.0);
      EXPECT_EQ(curve.tail[c][NODES - 1], 0.0);
    }
  }
}

// 1 - g by the closed form of the medium, the backward part by that of the convolution's tables.
TEST(PhaseCurve, KeepsTheMomentsOfTheFunction) {
  std::vector<FogPhaseParams> all = {henyeyGreenstein(0.95),
                                     henyeyGreenstein(-0.8),
                                     henyeyGreenstein(0),
                                     fog(0),
                                     fog(0.5),
                                     fog(2)};
  for (const double d : {5.0, 8.0, 12.0, 20.0, 30.0, 50.0}) {
    all.push_back(fog(d));
  }
  double worstGap = 0;
  double worstBackward = 0;
  for (const FogPhaseParams& p : all) {
    const PhaseCurve curve = curveOf(p);
    const double gap = 1 - meanCosine(p);
    const double backward = 1 - welkin::forwardFraction(p, 0);
    worstGap = std::max(worstGap, std::abs(meanOneMinusCosine(curve, 1) / gap - 1));
    worstBackward =
        std::max(worstBackward, std::abs((1 - forwardFraction(curve, 1)) / backward - 1));
    EXPECT_EQ(meanCosine(curve, 2), 1 - meanOneMinusCosine(curve, 2));
  }
  EXPECT_LE(worstGap, 3e-7);  // of two points per cell; the fit itself is exact
  EXPECT_LE(worstBackward, 3e-7);
  RecordProperty("gap", std::to_string(worstGap * 1e9) + "e-9");
  RecordProperty("backward", std::to_string(worstBackward * 1e9) + "e-9");
}

TEST(PhaseCurve, FollowsTheFunction) {
  double worst = 0;
  for (const FogPhaseParams& p :
       {fog(0), fog(1), fog(5), fog(20), fog(50), henyeyGreenstein(0.95)}) {
    const PhaseCurve curve = curveOf(p);
    for (double theta = 1e-4; theta < PI; theta *= 1.003) {
      const double y = yOf(theta);
      worst = std::max(worst, std::abs(evalPhaseCurve(curve, 0, y) / evalPhase(p, y) - 1));
    }
  }
  // Chords of y^-1.5 over cells of 4 / i of y: 1.5 * 2.5 / 8 (4 / i)^2 at node i; 1 - g is 0.002 at
  // 50 um, y 2e-6, i 16: 3 %, and half of that for the fit between the chord and the tangent.
  EXPECT_LE(worst, 0.015);
  RecordProperty("worst", std::to_string(worst * 1e6) + "e-6");
}

TEST(PhaseCurve, HoldsEveryChannelAndStraightLinesExactly) {
  const PhaseCurve curve = makePhaseCurve([](size_t channel, double y) {
    return channel == 0 ? 7 : (channel == 1 ? 2 - y : y * 1e-30);
  });
  for (double y = 0; y <= 2; y += 0.01) {
    const double slack = 1e-9;  // the elimination's rounding, over cells from 3e-11 to 4e-3
    EXPECT_NEAR(evalPhaseCurve(curve, 0, y), 1 / (4 * PI), slack);
    EXPECT_NEAR(evalPhaseCurve(curve, 1, y), (2 - y) / (4 * PI), slack);
    EXPECT_NEAR(evalPhaseCurve(curve, 2, y), y / (4 * PI), slack);
  }
  EXPECT_NEAR(meanCosine(curve, 0), 0, 1e-12);
  EXPECT_NEAR(meanCosine(curve, 1), 1.0 / 3, 1e-12);
  EXPECT_NEAR(meanCosine(curve, 2), -1.0 / 3, 1e-12);
  EXPECT_NEAR(forwardFraction(curve, 0), 0.5, 1e-12);
  EXPECT_NEAR(forwardFraction(curve, 1), 0.75, 1e-12);
  EXPECT_NEAR(forwardFraction(curve, 2), 0.25, 1e-12);
}

TEST(PhaseCurve, SamplesInvertTheEnergyFromBothEnds) {
  const std::vector<PhaseCurve> curves = {
      curveOf(fog(50)), curveOf(fog(0)), curveOf(henyeyGreenstein(-0.9)),
      makePhaseCurve([](size_t, double y) { return rainbow(y); })};
  for (const PhaseCurve& curve : curves) {
    const PhaseCurveF small = roundPhaseCurve(curve);
    for (int i = 0; i <= 5000; ++i) {
      const double xi = i / 5000.0;
      const double y = samplePhaseCurve(curve, 1, xi);
      ASSERT_TRUE(y >= 0 && y <= 2);
      // The sums of 1023 energies, and y near 2, which moves the energy by 2 pi P of an ulp.
      const double density = 2 * PI * evalPhaseCurve(curve, 1, y);
      EXPECT_NEAR(phaseCurveCdf(curve, 1, y), xi, 2 * NODES * EPS + 4 * density * EPS) << xi;
      const AxisAngleF a = samplePhaseCurve(small, 1, static_cast<float>(xi));
      // 6 roundings of energies near 1, those of xi, and the density times 4 of y from its end of
      // the axis, each up to its own size; a peak's density times that y is below 1.
      const double slack = 7 + 4 * density * std::max(std::min(y, 2 - y), 1e-12);
      EXPECT_NEAR(phaseCurveCdf(curve, 1, yOf(a)), xi, slack * EPS_FLOAT) << xi;
      const double exact = evalPhaseCurve(curve, 1, yOf(a));
      EXPECT_NEAR(evalPhaseCurve(small, 1, a) / exact, 1, 64 * EPS_FLOAT) << xi;
    }
    // Tiny energies at either end: y (or 2 - y) is the energy over 2 pi P. As long as they are
    // below the first cell's.
    const double first = curve.cdf[1][1] / 1000;
    EXPECT_NEAR(samplePhaseCurve(curve, 1, first) * 2 * PI * curve.value[1][0] / first, 1, 1e-3);
    const float firstF = static_cast<float>(first);
    EXPECT_NEAR(yOf(samplePhaseCurve(small, 1, firstF)) * 2 * PI * curve.value[1][0] / first, 1,
                1e-3);
    EXPECT_NEAR(
        curve.tail[1][NODES - 3] / ((2 - curve.y[NODES - 3]) * 2 * PI * curve.value[1][NODES - 2]),
        1, 0.05);
  }
}

TEST(PhaseCurve, AMillionSamplesHaveTheDensityOfARainbow) {
  constexpr int SAMPLES = 1'000'000;
  constexpr size_t BINS = 250;
  const PhaseCurve curve = makePhaseCurve([](size_t, double y) { return rainbow(y); });
  const PhaseCurveF small = roundPhaseCurve(curve);
  std::vector<int> counts(BINS);
  std::mt19937 generator(137);
  for (int i = 0; i < SAMPLES; ++i) {
    const float xi = static_cast<float>(generator() >> 8) * 0x1p-24f;
    const double s = f64::phaseCoordinate(yOf(samplePhaseCurve(small, 0, xi)));
    ++counts[std::min(static_cast<size_t>(s * static_cast<double>(BINS)), BINS - 1)];
  }
  // Energies of the function itself, not of the curve.
  std::vector<double> energy(BINS);
  double total = 0;
  for (size_t i = 0; i < BINS; ++i) {
    const auto angle = [](size_t edge) {
      const double y = f64::curveNode(static_cast<double>(edge) / static_cast<double>(BINS));
      return 2 * std::asin(static_cast<Real>(std::sqrt(std::min(y / 2, 1.0))));
    };
    energy[i] = static_cast<double>(reference::integrateSphere(
        [](Real theta) { return static_cast<Real>(rainbow(yOf(theta))); }, angle(i), angle(i + 1)));
    total += energy[i];
  }
  double sum = 0;
  double degrees = -1;
  double expected = 0;
  double found = 0;
  for (size_t i = 0; i < BINS; ++i) {
    expected += energy[i] / total * SAMPLES;
    found += counts[i];
    if (expected >= 20 || i + 1 == BINS) {  // few a bin are no normal distribution
      sum += (found - expected) * (found - expected) / std::max(expected, 1.0);
      degrees += 1;
      expected = 0;
      found = 0;
    }
  }
  // Wilson and Hilferty 1931; 3.09 standard deviations: p > 1e-3.
  const double spread = 2 / (9 * degrees);
  EXPECT_GE(degrees, 150);
  EXPECT_LE(std::abs(std::cbrt(sum / degrees) - (1 - spread)) / std::sqrt(spread), 3.09)
      << sum << " of " << degrees;
}

TEST(PhaseCurve, FloatValuesFollowTheDouble) {
  const PhaseCurve curve = makePhaseCurve([](size_t, double y) { return rainbow(y); });
  const PhaseCurveF small = roundPhaseCurve(curve);
  for (double theta = 1e-5; theta < PI; theta += theta < 1e-2 ? theta / 50 : 1e-3) {
    const float y = static_cast<float>(yOf(theta));
    const double truth = evalPhaseCurve(curve, 0, static_cast<double>(y));
    // Roundings: 2 of the values, 6 of the arithmetic; and of y and the cell's ends, which the
    // slope of P amplifies: most at the glory, where 2 - y is small.
    const double ends = 3 * 2 * EPS_FLOAT * static_cast<double>(y);
    const double above = evalPhaseCurve(curve, 0, std::min(static_cast<double>(y) + ends, 2.0));
    const double below = evalPhaseCurve(curve, 0, static_cast<double>(y) - ends);
    const double slope = std::max(std::abs(above / truth - 1), std::abs(below / truth - 1));
    EXPECT_NEAR(evalPhaseCurve(small, 0, y) / truth, 1, 8 * EPS_FLOAT + slope) << theta;
  }
}

// A halo's inner edge: dark up to 22 degrees, then 40 times as bright.
TEST(PhaseCurve, JumpsDoNotRing) {
  const double edge = yOf(22 * PI / 180);
  const auto halo = [&](double y) { return y < edge ? 0.5 : 20.0; };
  const PhaseCurve curve = makePhaseCurve([&](size_t, double y) { return halo(y); });
  const double scale = evalPhaseCurve(curve, 0, 2.0) / 20;
  for (size_t i = 0; i < NODES; ++i) {
    const bool inside = i > 0 && i + 1 < NODES && curve.y[i - 1] < edge && curve.y[i + 1] > edge;
    const double value = curve.value[0][i] / scale;
    if (inside) {
      EXPECT_GE(value, 0.25) << i;
      EXPECT_LE(value, 20 + 0.25 * 19.5) << i;
    } else {
      EXPECT_NEAR(value / halo(curve.y[i]), 1, 1e-6) << i;
    }
  }
}

TEST(PhaseCurve, EveryFunctionGivesAValidCurve) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const PhaseCurve curve = makePhaseCurve([&](size_t channel, double y) {
    if (channel == 0) {
      return y < 1 ? nan : -1;
    }
    if (channel == 1) {
      return y < 1.2 ? infinity : 3;
    }
    return y > 0.1 && y < 0.2 ? 1e-200 : 0;
  });
  EXPECT_EQ(evalPhaseCurve(curve, 0, 0.3), 1 / (4 * PI));
  EXPECT_NEAR(evalPhaseCurve(curve, 1, 0.5), 0, 1e-12);
  EXPECT_NEAR(evalPhaseCurve(curve, 1, 1.7) * 2 * PI * 0.8, 1, 0.01);
  const PhaseCurveF small = roundPhaseCurve(curve);
  for (size_t c = 0; c < kCurveChannels; ++c) {
    for (size_t i = 0; i <= 4096; ++i) {
      const double xi = static_cast<double>(i) / 4096;
      const double y = samplePhaseCurve(curve, c, xi);
      const double yF = yOf(samplePhaseCurve(small, c, static_cast<float>(xi)));
      ASSERT_TRUE(y >= 0 && y <= 2 && yF >= 0 && yF <= 2) << c << " " << xi;
      EXPECT_TRUE(c != 2 || (y > 0.095 && y < 0.205)) << xi;
      const double value = evalPhaseCurve(curve, c, 2 * xi);
      ASSERT_TRUE(std::isfinite(value) && value >= 0) << c << " " << xi;
    }
    for (const float xi : {0x1p-149f, 0x1p-126f, 1 - 0x1p-24f}) {
      const double y = yOf(samplePhaseCurve(small, c, xi));
      ASSERT_TRUE(y >= 0 && y <= 2) << c << " " << xi;
    }
  }
}

TEST(PhaseCurve, IsTheSameEveryTime) {
  const PhaseCurve first = curveOf(fog(12));
  const PhaseCurve second = curveOf(fog(12));
  EXPECT_EQ(first.value, second.value);
  EXPECT_EQ(first.cdf, second.cdf);
}

TEST(PhaseCurve, EmptyCellsAndEndsAreHarmless) {
  EXPECT_EQ(f32::curveCellValue(2.0f, 2.0f, 3.0f, 4.0f, 2.0f), 4.0f);
  EXPECT_EQ(f32::curveCellInvert(0.5f, 0.7f, 0.0f, 0.0f, 0.5f), 0.5f);
  EXPECT_EQ(f32::curveCellInvert(0.5f, 0.5f, 1.0f, 9.0f, 0.3f), 0.5f);
  EXPECT_EQ(f64::curveCellInvert(1.0, 2.0, 3.0, 3.0, 0.25), 1.25);
  EXPECT_EQ(f64::curveCellInvert(0.0, 1.0, 0.0, 1.0, 0.25), 0.5);  // t^2 = q
  EXPECT_EQ(f64::curveCellInvert(0.0, 1.0, 1.0, 0.0, 1.0), 1.0);
}

}  // namespace
