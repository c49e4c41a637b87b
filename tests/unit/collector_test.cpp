// SPDX-License-Identifier: MIT
// The search for collectors, shaders/model/surface/collector.glsl: maps on which the plain
// iteration of [B08] 6.1 fails.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "model/model.hpp"

namespace {

namespace f64 = welkin::model::f64;

struct Search {
  double centre;
  double residual;
};

Search search(const std::function<double(double)>& map, double start, double width, int steps) {
  f64::vec2 centre(start, 0);
  for (int i = 0; i < steps; ++i) {
    centre = f64::collectorStep(centre, f64::vec2(map(centre.x), 0), width);
  }
  return {centre.x, f64::collectorResidual(centre, f64::vec2(map(centre.x), 0), width)};
}

TEST(Collector, SearchFindsWhatThePlainIterationCircles) {
  const Search turned = search([](double x) { return 1 - x; }, 0.1, 1, 10);
  EXPECT_NEAR(turned.centre, 0.5, 1e-12);
  EXPECT_LT(turned.residual, 1e-12);
  // Slope 2.8 at the fixed point 0.390: too steep for any step of this length, and it says so.
  const Search steep = search([](double x) { return std::cos(3 * x); }, 0.1, 1, 10);
  EXPECT_NEAR(steep.centre, 0.39, 0.25);
  EXPECT_GT(steep.residual, 0.01);
}

TEST(Collector, NoStepIsLongerThanAWidth) {
  const f64::vec2 next = f64::collectorStep(f64::vec2(1, 2), f64::vec2(301, 402), 0.5);
  EXPECT_NEAR(std::hypot(next.x - 1, next.y - 2), 0.5, 1e-12);
  EXPECT_NEAR((next.x - 1) / (next.y - 2), 0.75, 1e-12);
  const f64::vec2 none = f64::collectorStep(f64::vec2(1, 2), f64::vec2(1, 2), 0);
  EXPECT_EQ(none.x, 1);
  EXPECT_EQ(none.y, 2);
}

TEST(Collector, LevelsHaveTheSpreadOfTheFootprint) {
  // Variance of a box and of the tent that filters it, both of width w.
  for (const double sigma : {0.5, 1.0, 3.7, 100.0}) {
    const double width = std::exp2(f64::footprintLevel(sigma, 0.25)) * 0.25;
    EXPECT_NEAR(width * width * (1.0 / 12 + 1.0 / 6), sigma * sigma, 1e-9 * sigma * sigma);
  }
  EXPECT_EQ(f64::footprintLevel(0, 1), 0);
  EXPECT_EQ(f64::footprintLevel(0.1, 1), 0);
  EXPECT_EQ(f64::footprintMean(0.6, 0.3), 2);
  EXPECT_EQ(f64::footprintMean(0.6, 0), 0);
}

// Wherever the first set's level lies between two whole ones.
TEST(Collector, ThreeRungsHoldTheLevelOfASet) {
  for (int set = 0; set < f64::SURFACE_DIFFUSE; ++set) {
    const double above = f64::footprintSetLevel(set, {}) - f64::footprintSetLevel(0, {});
    EXPECT_EQ(f64::footprintRung(set), std::floor(above)) << set;
    EXPECT_LT(f64::footprintRung(set) + 2, f64::SURFACE_RUNGS) << set;
  }
}

TEST(Collector, LevelsOfSetsAreThoseOfTheirSpread) {
  for (int set = 0; set < f64::SURFACE_SETS; ++set) {
    for (const double muLight : {0.01, 0.4, 1.0}) {
      for (const double texel : {0.003, 0.7, 90.0}) {
        const f64::TangentSlab local{40, 9, muLight, 0.5, 1};
        const double level =
            f64::footprintMapLevel(local, texel) + f64::footprintSetLevel(set, local);
        EXPECT_NEAR(std::max(level, 0.0),
                    f64::footprintLevel(f64::footprintSpread(set, local), texel), 1e-12);
      }
    }
  }
}

}  // namespace
