// SPDX-License-Identifier: MIT
// peakRows of src/tables/transport_phase: blurred light against its definition by moments and
// against random walks.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "tables/angular_moments.hpp"
#include "transport_truth.hpp"

namespace {

using namespace transport_test;

std::vector<double> rowOf(const SourceRows& rows, size_t channel, size_t row) {
  std::vector<double> values;
  for (size_t j = 0; j < rows.angles; ++j) {
    values.push_back(std::exp(
        static_cast<double>(rows.logSource[(channel * kPhaseDepths + row) * rows.angles + j])));
  }
  return values;
}

double nodeOf(size_t row) {
  return depthNode(static_cast<double>(row) / (kPhaseDepths - 1));
}

// Moment of what only the peak has turned, k + 1 times: sum of p^(k + 1) x^k / (k + 1)! e^(-x f).
double onlyTurned(double x, double peak, double f) {
  return x > 0 ? (std::exp(x * (peak - f)) - std::exp(-x * f)) / x : peak;
}

TEST(PeakRows, ArePAtZeroAndHaveTheEnergyOfTheirDefinition) {
  for (const Named& medium : media()) {
    const SourceRows rows = peakRows(medium.curve);
    ASSERT_EQ(rows.logSource.size(), SOURCE_CHANNELS * kPhaseDepths * medium.curve.y.size());
    for (size_t c = 0; c < SOURCE_CHANNELS; ++c) {
      const std::vector<double>& p = medium.curve.value[c];
      for (size_t j = 0; j < p.size(); ++j) {
        const size_t at = c * kPhaseDepths * rows.angles + j;
        ASSERT_EQ(rows.logSource[at], static_cast<float>(std::log(p[j]))) << medium.name;
      }
      const double f = 1 - Truth{curveAt(medium.curve, c)}.share;
      // A convolution of the rest with a positive peak keeps its least value, which is that of P,
      // but for what the series drops and the lines between its nodes, 2e-4 at 50 um.
      const double least = *std::min_element(p.begin(), p.end());
      for (size_t row = 0; row < kPhaseDepths; ++row) {
        const std::vector<double> values = rowOf(rows, c, row);
        EXPECT_NEAR(sphereIntegral(medium.curve.y, values), 1 - f + onlyTurned(nodeOf(row), f, f),
                    CHORD)
            << medium.name << row;
        EXPECT_GT(*std::min_element(values.begin(), values.end()), (1 - 1e-3) * least - 1e-7)
            << medium.name << " row " << row;
      }
    }
  }
}

// Funk-Hecke: each turn multiplies moment l by that of the peak, p_l / f.
TEST(PeakRows, HaveTheMomentsOfTheirDefinition) {
  for (const double g : {0.0, 0.5, 0.85, 0.95}) {
    const PhaseCurve curve = henyeyGreensteinCurve(g);
    const SourceRows rows = peakRows(curve);
    const Truth truth{henyeyGreenstein(g)};
    for (int l = 1; l <= 3; ++l) {
      const Real f = 1 - truth.share;
      const Real peak = Truth::integral([&](Real t) {
        return (truth.p(yOf(t)) - truth.kept(yOf(t))) * legendre(l, std::cos(t));
      });
      for (size_t row = 0; row < kPhaseDepths; row += 3) {
        const double x = nodeOf(row);
        const double rest = static_cast<double>(std::pow(static_cast<Real>(g), l) - peak);
        const double chi = rest * std::exp(-x * static_cast<double>(f - peak)) +
                           onlyTurned(x, static_cast<double>(peak), static_cast<double>(f));
        std::vector<double> moments(4);
        legendreMoments(curve.y, rowOf(rows, 1, row), moments);
        EXPECT_NEAR(moments[static_cast<size_t>(l)], chi, CHORD) << g << " row " << row;
      }
    }
  }
}

// Light that is scattered by P once and turned by the peak a Poisson number of times, walked turn
// by turn: knows no moments. Where the peak has done all k turns the path is met at each of them:
// weight 1 / k. Parts of the energy in cones.
TEST(PeakRows, AreTheDistributionsOfRandomWalks) {
  constexpr int WALKS = 200000;
  constexpr Real CONES[] = {0.01L, 0.03L, 0.1L, 0.2L, 0.4L, 0.8L, 1.5L, 2.5L};
  const double g = 0.95;
  const PhaseCurve curve = henyeyGreensteinCurve(g);
  const SourceRows rows = peakRows(curve);
  const Truth truth{henyeyGreenstein(g)};
  const double f = 1 - truth.share;
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto scatter = [&] {  // cosine of one scattering by P
    const double root = (1 - g * g) / (1 - g + 2 * g * uniform(generator));
    return std::clamp((1 + g * g - root * root) / (2 * g), -1.0, 1.0);
  };
  const auto byPeak = [&](double c) {
    const double p = truth.p(1 - c);
    return 1 - c < truth.edge && uniform(generator) * p < p - truth.level;
  };
  const auto turn = [&] {  // cosine of one by the peak, by rejection
    for (;;) {
      const double c = scatter();
      if (byPeak(c)) {
        return c;
      }
    }
  };
  for (const size_t row : {6u, 14u, 22u}) {
    std::poisson_distribution<int> turns(f * nodeOf(row));
    std::array<double, std::size(CONES)> inside{};
    std::array<double, std::size(CONES)> squares{};
    for (int walk = 0; walk < WALKS; ++walk) {
      double c = scatter();
      const bool peakOnly = byPeak(c);
      const int count = turns(generator);
      const double weight = peakOnly ? 1.0 / (count + 1) : 1;
      for (int k = count; k > 0; --k) {
        const double t = turn();
        const double side = std::sqrt(std::max((1 - c * c) * (1 - t * t), 0.0));
        c = std::clamp(c * t + side * std::cos(2 * PI * uniform(generator)), -1.0, 1.0);
      }
      for (size_t i = 0; i < inside.size(); ++i) {
        const double one = c > static_cast<double>(std::cos(CONES[i])) ? weight : 0;
        inside[i] += one / WALKS;
        squares[i] += one * one / WALKS;
      }
    }
    const std::vector<double> p = rowOf(rows, 0, row);
    for (size_t i = 0; i < inside.size(); ++i) {
      const double part = static_cast<double>(::reference::integrateSphere(
          [&](Real t) { return curveValue(curve.y, p, yOf(t)); }, 0, CONES[i]));
      const double sigma = std::sqrt((squares[i] - inside[i] * inside[i]) / WALKS);
      EXPECT_NEAR(inside[i], part, 4.5 * sigma) << row << " cone " << static_cast<double>(CONES[i]);
    }
  }
}

}  // namespace
