// SPDX-License-Identifier: MIT
#include "tables/slab_steps.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "reference/quadrature.hpp"

namespace {

using namespace welkin;

// Integral over [0, 1] in panels that are dense at 0.
template <typename Function>
double integral(Function f) {
  static const auto rule = reference::gaussLegendre(20);
  long double sum = 0;
  double end = 1;
  for (int panel = 0; panel < 60; ++panel) {
    const double begin = panel < 59 ? end / 2 : 0;
    for (size_t i = 0; i < rule.node.size(); ++i) {
      const auto width = static_cast<long double>(end - begin);
      const double y = static_cast<double>(static_cast<long double>(begin) + width * rule.node[i]);
      sum += width * rule.weight[i] * static_cast<long double>(f(y));
    }
    end = begin;
  }
  return static_cast<double>(sum);
}

TEST(SlabSteps, DecayMomentsAreTheirIntegrals) {
  for (const double x : {0.0, 1e-9, 0.1, 1.4999, 1.5001, 4.0, 40.0, 1e4}) {
    const auto moments = decayMoments(x);
    for (int p = 0; p < 5; ++p) {
      const double expected = integral([&](double y) { return std::pow(y, p) * std::exp(-x * y); });
      // The recurrence divides p! roundings by x^p, x > 1.5: 24 / 5 of some 20.
      EXPECT_NEAR(moments[static_cast<size_t>(p)] / expected, 1, 2e-14) << x << " " << p;
    }
  }
}

TEST(SlabSteps, IntegratesParabolasExactly) {
  const auto source = [](double y) { return 3 - 2 * y + 0.7 * y * y; };  // from the end back
  for (const double length : {1e-3, 0.5, 3.0, 50.0}) {
    for (const std::array<double, 3> node :
         {std::array<double, 3>{0, 1, 2}, {0, 1, -1}, {1, -0.4, 2.5}}) {
      const SlabStep step = slabStep(length, node);
      EXPECT_EQ(step.decay, std::exp(-length));
      for (int p = 0; p < 3; ++p) {
        double found = 0;
        for (size_t j = 0; j < 3; ++j) {
          found += step.weight[static_cast<size_t>(p)][j] * source(node[j]);
        }
        const double expected = integral([&](double y) {
          return length * std::pow(y * length, p) * std::exp(-y * length) * source(y);
        });
        EXPECT_NEAR(found / expected, 1, 1e-12) << length << " " << p;
      }
    }
  }
}

TEST(SlabSteps, DepthsRiseFromFaceToFaceInCellsWithAMiddle) {
  for (const double thickness : {1e-3, 0.1, 1.0, 30.0, 1e4}) {
    const auto depth = slabDepths(thickness);
    EXPECT_EQ(depth.front(), 0);
    EXPECT_NEAR(depth.back(), thickness, 1e-12 * thickness);
    ASSERT_EQ(depth.size() % 2, 1U);
    for (size_t i = 1; i + 1 < depth.size(); i += 2) {
      EXPECT_LT(depth[i - 1], depth[i]);
      EXPECT_NEAR(depth[i], (depth[i - 1] + depth[i + 1]) / 2, 1e-12 * thickness);
      // The other half's nodes are its mirror image: one matrix serves both directions.
      EXPECT_NEAR(depth[i], thickness - depth[depth.size() - 1 - i], 1e-12 * thickness);
    }
    EXPECT_LE(depth[1], 0.0011);
    EXPECT_GT(slabDepths(thickness, 2).size(), depth.size() * 4 / 3);
  }
}

}  // namespace
