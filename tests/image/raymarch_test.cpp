// SPDX-License-Identifier: MIT
// The reference itself: against closed forms, and its own convergence.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "cloud_scene.hpp"

namespace {

using namespace image_test;

constexpr double ROUNDING = 1e-12;  // of sums over a few hundred pieces in double

TEST(RayMarch, IsExactInAHomogeneousBox) {
  const VoxelField box = cubeField(3, std::vector<float>(27, 1.0f), 0.0078125, 128, {0, 0, -200});
  const RayMarch march(box);
  EXPECT_NEAR(march.opticalDepth({0, 0, 0}, {0, 0, -1}), 1.0, ROUNDING);
  EXPECT_NEAR(march.opticalDepth({0, 0, 0}, {0, 0, -1}, 168.0), 0.25, ROUNDING);
  EXPECT_EQ(march.opticalDepth({0, 70, 0}, {0, 0, -1}), 0.0);
  // Lit along the view from behind: every path has depth 1 in all. From in front: 1 - e^-2 over 2.
  // Three Gauss points on 4 pieces of depth x = 1/4 have the
  // error x^7 f(6) / 2016000, f(6) <= 64 for f = e^-2x (6 derivatives, the factor 2 each).
  const double quadrature = 4 * std::pow(0.25, 7) * 64 / 2016000;
  EXPECT_NEAR(march.march({0, 0, 0}, {0, 0, -1}, 1e30, {0, 0, -1}).scattered, std::exp(-1.0),
              quadrature);
  EXPECT_NEAR(march.march({0, 0, 0}, {0, 0, -1}, 1e30, {0, 0, 1}).scattered,
              (1 - std::exp(-2.0)) / 2, quadrature);
}

TEST(RayMarch, IntegratesATrilinearRampExactly) {
  // Values 0, 1, 2, 3 along x on centres 0.125 ... 0.875, constant beyond: mean 1.5 over [0, 1].
  VoxelField ramp;
  ramp.size = {4, 1, 1};
  ramp.extinction = {0, 1, 2, 3};
  ramp.worldFromBox = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  const RayMarch march(ramp);
  EXPECT_NEAR(march.opticalDepth({-1, 0.3, 0.6}, {1, 0, 0}), 1.5, ROUNDING);
  // 0 up to 0.125, then 4 (x - 0.125) up to x = 0.625: 4 / 2 * 0.25.
  EXPECT_NEAR(march.opticalDepth({-1, 0.3, 0.6}, {1, 0, 0}, 1.625), 0.5, ROUNDING);
  EXPECT_NEAR(march.opticalDepth({0.5, 0.5, 2}, {0, 0, -1}), 1.5, ROUNDING);
}

TEST(RayMarch, ConvergesInItsEyeIntegral) {
  for (const bool steep : {false, true}) {
    const RayMarch march(steep ? steepCloudField() : noiseCloudField());
    const Camera camera = cloudCamera();
    const auto picture = [&](int refinement) {
      return marchPicture(march, camera, 16, lightAtAngle(135), CLOUD_G, refinement);
    };
    const std::vector<double> fine = picture(4);
    const double difference = relativeRms(picture(1), fine);
    std::printf("reference, %s field: refinement 1 against 4: relative RMS %.1e\n",
                steep ? "steep" : "noise", difference);
    EXPECT_LT(difference, 5e-5);
  }
}

TEST(RayMarch, CloudsHaveTheDepthsTheyPromise) {
  const RayMarch noise(noiseCloudField());
  const RayMarch steep(steepCloudField());
  double deepest = 0;
  double deepestSteep = 0;
  for (int i = 0; i < 64 * 64; ++i) {
    const Point top{CLOUD_CENTRE[0] + (i % 64 - 31.5) * 10, 2000,
                    CLOUD_CENTRE[2] + (i / 64 - 31.5) * 10};
    deepest = std::max(deepest, noise.opticalDepth(top, {0, -1, 0}));
    deepestSteep = std::max(deepestSteep, steep.opticalDepth(top, {0, -1, 0}));
  }
  std::printf("densest column: noise %.2f, steep %.2f\n", deepest, deepestSteep);
  EXPECT_NEAR(deepest, 12, 1.5);
  EXPECT_GT(deepestSteep, 30);
}

}  // namespace
