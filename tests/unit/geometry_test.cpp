// SPDX-License-Identifier: MIT
// shaders/model/geometry.glsl: boxes against a naive test of points, the planet against long
// double coordinates.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "model/model.hpp"
#include "support/tolerance.hpp"

namespace {

namespace f32 = welkin::model::f32;
namespace f64 = welkin::model::f64;
using welkin::test::EPS_FLOAT;

constexpr double RADIUS = 6.371e6;

bool inside(const f64::vec3& p, const f64::vec3& lo, const f64::vec3& hi) {
  return p.x > lo.x && p.y > lo.y && p.z > lo.z && p.x < hi.x && p.y < hi.y && p.z < hi.z;
}

TEST(RayBox, SpanHoldsExactlyThePointsInside) {
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const f64::vec3 lo(-2.0, -1.0, -3.0);
  const f64::vec3 hi(1.0, 4.0, 2.0);
  int hits = 0;
  for (int i = 0; i < 20000; ++i) {
    const f64::vec3 origin(8.0 * unit(generator), 8.0 * unit(generator), 8.0 * unit(generator));
    f64::vec3 d(unit(generator), unit(generator), unit(generator));
    // Every combination of vanishing components, with both zeros.
    d.x = (i & 1) != 0 ? ((i & 8) != 0 ? 0.0 : -0.0) : d.x;
    d.y = (i & 2) != 0 ? 0.0 : d.y;
    d.z = (i & 5) == 5 && (i & 2) != 0 ? 1.0 : ((i & 4) != 0 ? -0.0 : d.z);
    if (glm::dot(d, d) == 0.0) {
      continue;
    }
    d = glm::normalize(d);
    const f64::Span span = f64::rayBox(origin, d, lo, hi);
    ASSERT_FALSE(std::isnan(span.begin) || std::isnan(span.end));
    ASSERT_GE(span.begin, 0.0);
    hits += span.end > span.begin ? 1 : 0;
    for (double t = 0.013; t < 25.0; t += 0.37) {
      const double edge = std::fmin(std::fabs(t - span.begin), std::fabs(t - span.end));
      if (edge > 1e-9) {  // far coarser than rounding of numbers near 25, far finer than the steps
        ASSERT_EQ(inside(origin + d * t, lo, hi), t > span.begin && t < span.end) << i << " " << t;
      }
    }
  }
  EXPECT_GT(hits, 1000);
}

TEST(RayBox, ZeroDirectionOnAFaceIsNeverNaN) {
  const f32::vec3 lo(0.0f);
  const f32::vec3 hi(1.0f);
  for (const float x : {0.0f, 1.0f, 0.5f, -1e9f, 1e9f}) {
    for (const float zero : {0.0f, -0.0f, 1e-45f}) {
      const f32::Span span =
          f32::rayBox(f32::vec3(x, 0.5f, -2.0f), f32::vec3(zero, -zero, 1.0f), lo, hi);
      EXPECT_FALSE(std::isnan(span.begin) || std::isnan(span.end));
      if (x == 0.5f) {
        EXPECT_EQ(span.begin, 2.0f);
        EXPECT_EQ(span.end, 3.0f);
      }
      if (std::fabs(x) > 2.0f) {
        EXPECT_FALSE(span.end > span.begin);
      }
    }
  }
}

long double altitudeTruth(long double h, long double mu, long double radius, long double t) {
  const long double up = radius + h + mu * t;
  return std::sqrt(up * up + (1.0L - mu * mu) * t * t) - radius;
}

TEST(Planet, FloatAltitudeIsGoodToMillimetresNearTheGround) {
  std::mt19937 generator(5);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  for (int i = 0; i < 50000; ++i) {
    const float h = std::pow(10.0f, -2.0f + 7.0f * unit(generator));
    const float mu = (2.0f * unit(generator) - 1.0f) * (i % 2 == 0 ? 1.0f : 0.01f);
    const float t = std::pow(10.0f, 5.0f * unit(generator));
    const auto radius = static_cast<float>(RADIUS);
    const long double truth = altitudeTruth(h, mu, radius, t);
    // Terms of q / 2R: h, t mu, t^2 / 2R; each with up to 5 roundings, 3 more for the quotient.
    const double terms = h + t * std::fabs(mu) + t * t / (2 * RADIUS);
    EXPECT_NEAR(f32::altitudeAlongRay(h, mu, radius, t), static_cast<double>(truth),
                (5 + 3) * EPS_FLOAT * terms);
  }
}

TEST(Planet, GroundDistanceFindsTheSphereAndTheHorizon) {
  std::mt19937 generator(6);
  std::uniform_real_distribution<float> unit(-1.0f, 1.0f);
  const auto radius = static_cast<float>(RADIUS);
  int misjudged = 0;
  for (int i = 0; i < 100000; ++i) {
    const float h = std::pow(10.0f, 2.5f + 2.5f * unit(generator));
    const long double r = static_cast<long double>(radius) + h;
    const long double c = static_cast<long double>(h) * (2.0L * radius + h);
    // Half of the rays within 1e-3 of the horizon.
    const float spread = i % 2 == 0 ? 1e-3f : 0.5f;
    const float mu =
        std::fmax(static_cast<float>(-std::sqrt(c) / r) + spread * unit(generator), -1.0f);
    const long double disc = r * r * mu * mu - c;
    const bool hits = disc >= 0.0L && mu < 0.0f;
    const float t = f32::groundDistance(h, mu, radius);
    misjudged += hits == (t >= 0.0f) ? 0 : 1;
    if (hits && t >= 0.0f) {
      // Altitude at the hit, which stays well-conditioned where the ray grazes: terms as above,
      // 4 roundings in the horizon's cosine, 4 in the root, 4 in the quotient.
      const double terms = h + t * std::fabs(mu) + double{t} * t / (2 * RADIUS);
      EXPECT_NEAR(static_cast<double>(altitudeTruth(h, mu, radius, t)), 0.0,
                  (4 + 4 + 4) * EPS_FLOAT * terms);
    }
  }
  // The usual discriminant gets 2 % of such rays wrong at 2 m; only cosines equal in float may
  // fall on either side here.
  EXPECT_LE(misjudged, 100000 / 10000);
}

TEST(Planet, GroundDistanceAtSeaLevelAndBelow) {
  EXPECT_EQ(f64::groundDistance(0.0, 0.0, RADIUS), -1.0);
  EXPECT_EQ(f64::groundDistance(0.0, 0.5, RADIUS), -1.0);
  EXPECT_EQ(f64::groundDistance(0.0, -0.5, RADIUS), 0.0);
  EXPECT_EQ(f64::groundDistance(-100.0, -0.5, RADIUS), 0.0);
  EXPECT_EQ(f64::groundDistance(-100.0, 0.5, RADIUS), -1.0);
  EXPECT_DOUBLE_EQ(f64::groundDistance(1000.0, -1.0, RADIUS), 1000.0);
  EXPECT_EQ(f32::groundDistance(1e9f, 0.0f, 6.371e6f), -1.0f);
  EXPECT_FLOAT_EQ(f32::groundDistance(1e9f, -1.0f, 6.371e6f), 1e9f);
}

}  // namespace
