// SPDX-License-Identifier: MIT
#include "reference/layers.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "reference/planet.hpp"
#include "reference/statistics.hpp"

namespace welkin::reference {
namespace {

Climb climbAt(double radius, double altitude, double mu) {
  return {altitude, mu, 1 / (radius + altitude)};
}

ExponentialLayer layerOf(double extinction, double base, double scaleHeight) {
  ExponentialLayer layer;
  layer.base = base;
  layer.scaleHeight = scaleHeight;
  layer.extinction = {extinction, extinction, extinction};
  return layer;
}

TEST(GlobeReference, AltitudesAgreeWithLongDouble) {
  constexpr double DIGITS = 1e-9;  // m: of 1e6 m, ten units in the last place
  for (const double radius : {6.371e6, 1e5}) {
    Globe globe;
    globe.radius = radius;
    globe.seaLevelPoint = {3, -5, 7};
    globe.up = normalized({0.1, 1, -0.2});
    const Point origin = along(globe.seaLevelPoint, globe.up, 1234.5);
    const Point direction = normalized({1, 0.05, 0.3});
    const Climb climb = globe.climb(origin, direction);
    EXPECT_NEAR(climb.altitude, 1234.5, DIGITS);
    for (const double t : {0.0, 1.0, 1e4, 1e6}) {
      const Point p = along(origin, direction, t);
      long double square = 0;
      for (size_t k = 0; k < 3; ++k) {
        const long double d = static_cast<long double>(p[k]) - globe.seaLevelPoint[k] +
                              static_cast<long double>(radius) * globe.up[k];
        square += d * d;
      }
      const auto altitude = static_cast<double>(std::sqrt(square) - radius);
      EXPECT_NEAR(climb.after(t).altitude, altitude, 2 * DIGITS + 1e-15 * t) << t;
      EXPECT_NEAR(globe.climb(p, direction).altitude, altitude, 2 * DIGITS + 1e-15 * t) << t;
      EXPECT_NEAR(globe.climb(p, direction).mu, climb.after(t).mu, 1e-13) << t;
    }
  }
}

TEST(GlobeReference, ShellsAndGroundAreMetAtTheirAltitude) {
  constexpr double RELATIVE = 1e-12;
  for (const double radius : {6.371e6, 1e5, FAR}) {
    const double curvature = radius == FAR ? 0 : 1 / (radius + 900);
    for (const double mu : {-1.0, -0.5, -0.3, 0.2, 1.0}) {
      const Climb climb{900, mu, curvature};
      const double ground = climb.ground();
      EXPECT_EQ(ground < FAR, mu < 0) << radius << " " << mu;
      if (mu < 0) {
        EXPECT_NEAR(climb.after(ground).altitude, 0, radius == FAR ? 1e-9 : RELATIVE * radius);
      }
      for (const double top : {500.0, 2000.0}) {
        const Climb::Interval part = climb.below(top);
        if (top < 900 && mu > 0) {
          EXPECT_LE(part.end, part.begin);
        } else if (top < 900) {
          EXPECT_NEAR(climb.after(part.begin).altitude, top, 1e-8);
        } else if (part.end < FAR) {
          EXPECT_EQ(part.begin, 0);
          EXPECT_NEAR(climb.after(part.end).altitude, top, 1e-8);
        } else {
          EXPECT_TRUE(radius == FAR && mu < 0);
        }
      }
    }
  }
}

TEST(LayersReference, DepthAgreesWithFineQuadrature) {
  constexpr double BOTH = 1e-8 + 1e-9;  // of planet.hpp, and of the layer
  for (const double radius : {6.371e6, 1e5}) {
    for (const double scaleHeight : {8000.0, 100.0}) {
      Planet planet;
      planet.radius = radius;
      planet.airScaleHeight = scaleHeight;
      const ExponentialLayer layer = layerOf(1, 0, scaleHeight);
      for (const double altitude : {0.0, 500.0, 20000.0}) {
        for (const double mu : {-0.2, -0.05, -0.01, 0.0, 0.003, 0.1, 1.0}) {
          for (const double length : {1e3, 1e5, FAR}) {
            const Climb climb = climbAt(radius, altitude, mu);
            if (climb.ground() < length) {
              continue;
            }
            const double expected = columns(planet, altitude, mu, length).air;
            const double depth = layer.opticalDepth(climb, 0, length);
            EXPECT_NEAR(depth, expected, BOTH * expected + 1e-30)
                << radius << " " << scaleHeight << " " << altitude << " " << mu << " " << length;
          }
        }
      }
    }
  }
}

TEST(LayersReference, FlatDepthIsItsClosedForm) {
  const ExponentialLayer layer = layerOf(0.002, 50, 300);
  constexpr double ROUNDING = 1e-12;
  for (const double mu : {-0.9, -1e-3, -1e-15, 0.0, 1e-9, 0.4}) {
    const Climb climb{120, mu, 0};
    double expected = 0;  // Simpson's rule in 2000 steps: error below 1e-13 of it
    constexpr int STEPS = 2000;
    for (int i = 0; i <= STEPS; ++i) {
      const double weight = i == 0 || i == STEPS ? 1 : (i % 2 == 1 ? 4 : 2);
      expected += weight / 3 * (500.0 / STEPS) * 0.002 *
                  std::exp(-(120 + mu * 500.0 * i / STEPS - 50) / 300);
    }
    EXPECT_NEAR(layer.opticalDepth(climb, 0, 500) / expected, 1, ROUNDING) << mu;
  }
  EXPECT_NEAR(layer.opticalDepth({50, 0.5, 0}, 0, FAR), 0.002 * 300 / 0.5, ROUNDING);
}

// e^-depth at the collisions is uniform; what escapes fills the rest up.
template <typename Layer>
double collisionUniformity(const Layer& layer, const Climb& climb, double length) {
  constexpr uint64_t COUNT = 100000;
  const double through = std::exp(-layer.opticalDepth(climb, 0, length));
  std::vector<double> values;
  for (uint64_t i = 0; i < COUNT; ++i) {
    Random random(7, 0, i, 0);
    const double t = layer.collision(climb, 0, length, random);
    values.push_back(t == FAR ? through * random.uniform()
                              : std::exp(-layer.opticalDepth(climb, 0, t)));
  }
  return uniformityOf(values);
}

TEST(LayersReference, CollisionsFollowTheDepth) {
  struct Case {
    double radius, altitude, mu, length;
  };
  const Case cases[] = {{6.371e6, 0, 0.0, FAR},      {6.371e6, 100, 0.7, FAR},
                        {6.371e6, 9000, -0.04, FAR}, {6.371e6, 4e5, -0.33, FAR},
                        {6.371e6, 5000, -0.9, 4000}, {1e5, 3000, -0.2, FAR},
                        {1e5, 2000, 0.0, 3e4},       {FAR, 2000, 0.0, 5e4},
                        {FAR, 2000, -0.3, 6000},     {FAR, 2000, 0.01, FAR}};
  for (const Case& c : cases) {
    const Climb climb{c.altitude, c.mu, c.radius == FAR ? 0 : 1 / (c.radius + c.altitude)};
    ExponentialLayer layer = layerOf(1, 200, c.radius == 1e5 ? 1500 : 8000);
    layer.extinction.fill(0.7 / layer.opticalDepth(climb, 0, c.length));  // depth 0.7
    EXPECT_LT(collisionUniformity(layer, climb, c.length), UNIFORMITY)
        << c.radius << " " << c.altitude << " " << c.mu;
  }
}

TEST(LayersReference, UniformLayerIsALengthTimesTheExtinction) {
  UniformLayer layer;
  layer.bottom = 10;
  layer.top = 30;
  layer.extinction = {0.1, 0.2, 0.3};
  constexpr double ROUNDING = 1e-14;
  EXPECT_NEAR(layer.opticalDepth({0, 0.5, 0}, 1, FAR), 0.2 * 40, 8 * ROUNDING);
  EXPECT_NEAR(layer.opticalDepth({20, -0.5, 0}, 2, FAR), 0.3 * 20, 6 * ROUNDING);
  EXPECT_EQ(layer.opticalDepth({40, 0.5, 0}, 1, FAR), 0);
  EXPECT_NEAR(layer.opticalDepth({20, 0, 0}, 0, 5), 0.5, ROUNDING);
  EXPECT_LT(collisionUniformity(layer, {0, 0.7, 0}, FAR), UNIFORMITY);
  EXPECT_LT(collisionUniformity(layer, {25, -0.7, 0}, 12), UNIFORMITY);
}

}  // namespace
}  // namespace welkin::reference
