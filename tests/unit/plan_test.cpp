// SPDX-License-Identifier: MIT
// src/frame/plan: where boxes lie before the eye.
#include "frame/plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory_resource>
#include <random>
#include <welkin/welkin.hpp>

namespace {

using namespace welkin;

// A volume before an eye at the origin that looks along -z; `scale`: of the projection.
PlannedVolume planned(const glm::dmat4x3& box, double scale = 1) {
  PlanVolume volume;
  volume.worldFromBox = box;
  PlanInput in;
  in.layers = WLK_LAYER_ALL;
  in.planet = make<WlkPlanet>();
  in.quality = resolveQuality(make<WlkQuality>());
  in.width = 320;
  in.height = 200;
  in.clipFromEye = scale * glm::dmat4(1.2, 0, 0, 0, 0, -2, 0, 0, 0, 0, 0, -1, 0, 0, 0.1, 0);
  in.volumes = {&volume, 1};
  Plan plan(std::pmr::get_default_resource());
  makePlan(in, plan);
  return plan.volumes[0];
}

// Least value of a convex function on [0, 1], by thirds.
template <typename F>
double least(const F& f) {
  double a = 0;
  double b = 1;
  for (int i = 0; i < 45; ++i) {
    const double third = (b - a) / 3;
    if (f(a + third) < f(b - third)) {
      b -= third;
    } else {
      a += third;
    }
  }
  return f(0.5 * (a + b));
}

// From the origin to the nearest point of the box, one coordinate inside another.
double distanceByThirds(const glm::dmat4x3& box) {
  return least([&](double x) {
    return least([&](double y) {
      return least([&](double z) { return glm::length(box * glm::dvec4(x, y, z, 1)); });
    });
  });
}

TEST(Plan, DistanceIsThatOfTheNearestPoint) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> side(-1, 1);
  double worst = 0;
  for (int i = 0; i < 30; ++i) {
    glm::dmat4x3 box;
    do {
      for (int c = 0; c < 4; ++c) {
        box[c] = (c < 3 ? 10.0 : 25.0) * glm::dvec3(side(random), side(random), side(random));
      }
    } while (std::abs(glm::determinant(glm::dmat3(box))) < 30);
    const double truth = distanceByThirds(box);
    worst = std::max(worst, std::abs(planned(box).distance - truth));
  }
  // Two points of one distance differ by the root of its rounding.
  EXPECT_LT(worst, 1e-5);
  const glm::dmat4x3 sheared(10, 0, 0, 9, 1, 0, 0, 0, 10, -27, -3, -5);
  EXPECT_NEAR(planned(sheared).distance, distanceByThirds(sheared), 1e-5);
}

// Along the axes of a box with right angles, as it always was: equal distances stay equal.
TEST(Plan, DistanceToRightAnglesIsAlongTheAxes) {
  const glm::dmat4x3 lower(100, 0, 0, 0, 20, 0, 0, 0, 50, 30, -20, -400);
  const glm::dmat4x3 upper(100, 0, 0, 0, 70, 0, 0, 0, 50, 30, 0, -400);
  EXPECT_EQ(planned(lower).distance, planned(upper).distance);
  EXPECT_DOUBLE_EQ(planned(lower).distance, std::sqrt(30.0 * 30 + 350.0 * 350));
  const glm::dmat4x3 around(4, 0, 0, 1, 4, 0, 0, 1, 4, -2, -2, -2);
  EXPECT_EQ(planned(around).distance, 0);
}

// Clip space may have any scale.
TEST(Plan, PixelsDoNotDependOnTheScaleOfTheProjection) {
  const glm::dmat4x3 beside(3, 0, 0, 0, 2, 0, 0, 0, 7, 1, -1, -5);
  const PixelRect usual = planned(beside).rect;
  EXPECT_FALSE(usual.empty());
  for (const double scale : {1e-5, 1e5}) {
    const PixelRect scaled = planned(beside, scale).rect;
    EXPECT_EQ(scaled.x0, usual.x0) << scale;
    EXPECT_EQ(scaled.y0, usual.y0) << scale;
    EXPECT_EQ(scaled.x1, usual.x1) << scale;
    EXPECT_EQ(scaled.y1, usual.y1) << scale;
  }
}

}  // namespace
