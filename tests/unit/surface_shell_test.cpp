// SPDX-License-Identifier: MIT
// Depth under a face from how much cloud is around a point, against the kernel's integral under
// planes of any direction; density of the shell.
#include <gtest/gtest.h>

#include <cmath>

#include "model/model.hpp"

namespace welkin {
namespace {

using namespace model;

// Part of a kernel (a box, and 1 2 1 to both neighbours, in each axis) that lies under a plane
// `depth` above its middle, by counting points.
double filledAt(const f64::vec3& normal, double depth) {
  constexpr int FINE = 8;  // points of a cell along an axis
  double sum = 0;
  for (int i = -FINE * 3 / 2; i < FINE * 3 / 2; ++i) {
    for (int j = -FINE * 3 / 2; j < FINE * 3 / 2; ++j) {
      for (int k = -FINE * 3 / 2; k < FINE * 3 / 2; ++k) {
        const f64::vec3 p = (f64::vec3(i, j, k) + 0.5) / double{FINE};
        double weight = 1;
        for (int axis = 0; axis < 3; ++axis) {
          weight *= std::abs(p[axis]) < 0.5 ? 0.5 : 0.25;
        }
        sum += weight * std::clamp((depth - glm::dot(p, normal)) * FINE + 0.5, 0.0, 1.0);
      }
    }
  }
  return sum / (FINE * FINE * FINE);
}

TEST(SurfaceShell, CellsTellDepths) {
  double across = 0;
  double most = 0;
  double least = 0;
  for (const f64::vec3& direction :
       {f64::vec3(1, 0, 0), f64::vec3(1, 1, 0), f64::vec3(1, 1, 1), f64::vec3(3, 2, 1)}) {
    const f64::vec3 normal = glm::normalize(direction);
    for (double depth = -1.25; depth <= 1.25; depth += 0.05) {
      const double error = f64::shellDepth(filledAt(normal, depth)) - depth;
      (direction.y > 0 ? most : across) =
          std::max(direction.y > 0 ? most : across, std::abs(error));
      least = std::min(least, error * (depth < 0 ? -1 : 1));
    }
  }
  EXPECT_LT(across, 0.02);
  EXPECT_LT(most, 0.17);
}

TEST(SurfaceShell, DepthsAreOddAndRise) {
  EXPECT_EQ(f64::shellDepth(0.5), 0);
  EXPECT_EQ(f64::shellDepth(1), 1.5);
  EXPECT_EQ(f64::shellDepth(0), -1.5);
  EXPECT_EQ(f64::shellDepth(-3), -1.5);
  EXPECT_EQ(f64::shellDepth(7), 1.5);
  double before = -2;
  for (double f = 0; f <= 1; f += 1.0 / 512) {
    EXPECT_GT(f64::shellDepth(f), before) << f;
    EXPECT_NEAR(f64::shellDepth(f), -f64::shellDepth(1 - f), 1e-12);
    before = f64::shellDepth(f);
  }
}

TEST(SurfaceShell, DensityRunsFromFaceToCore) {
  for (const double noise : {0.0, 0.3, 0.7, 1.0}) {
    for (const double softness : {0.05, 0.3, 1.0}) {
      EXPECT_EQ(f64::shellDensity(0, noise, softness), 0);
      EXPECT_EQ(f64::shellDensity(-1, noise, softness), 0);
      EXPECT_NEAR(f64::shellDensity(1, noise, softness), 1, 1e-12);
      EXPECT_EQ(f64::shellDensity(2, noise, softness), 1);
      // Half way in the edge that the noise has moved.
      EXPECT_NEAR(f64::shellDensity((1 - softness) * noise + softness / 2, noise, softness), 0.5,
                  1e-12);
    }
  }
}

}  // namespace
}  // namespace welkin
