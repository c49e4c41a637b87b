// SPDX-License-Identifier: MIT
// A layer 10000 times as wide as high, seen far from its middle: where stretches between samples
// are shorter than floats of the distance from the middle lie apart, rays still come to their end.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "slicing_scene.hpp"
#include "support/tolerance.hpp"

namespace {

using namespace image_test;
using welkin::test::EPS_FLOAT;

constexpr int SIZE = 16;
constexpr double WIDTH = 100e3;
constexpr double HEIGHT = 10;
constexpr double EXTINCTION = 0.03;

// Homogeneous, the sun at the zenith: transmittance and light scattered once in closed form.
TEST(WideVolume, EndsItsRaysFarFromItsMiddle) {
  SlicingScene scene(SIZE, true);
  VoxelField box;
  box.size = {2, 2, 2};
  box.extinction.assign(8, static_cast<double>(static_cast<float>(EXTINCTION)));
  box.worldFromBox = {WIDTH, 0, 0, -WIDTH / 2, 0, HEIGHT, 0, -HEIGHT / 2, 0, 0, WIDTH, -WIDTH / 2};
  scene.addVolume(box, scene.henyeyGreenstein(0));
  scene.setLight({0, 1, 0});
  Camera camera;
  camera.position = {44e3, 500, 44e3};
  camera.forward = normalized({1, -0.5, 1});
  camera.tangent = 0.1;
  scene.setCamera(camera);
  Quality quality;
  quality.slices = 2048;
  quality.lightSize = 64;
  scene.setQuality(quality);
  const Picture picture = scene.render();
  EXPECT_EQ(picture.nonFinite, 0u);
  const RayMarch march(box);
  // Both ends of the ray, each rounded three times as a distance from the middle.
  const double ends = 6 * EPS_FLOAT * std::numbers::sqrt2 * WIDTH / 2;  // m
  double worst = 0;
  double worstLight = 0;
  for (int i = 0; i < SIZE * SIZE; ++i) {
    const auto k = static_cast<size_t>(i);
    const Point ray = camera.ray(i % SIZE, i / SIZE, SIZE);
    const double clear = std::exp(-march.opticalDepth(camera.position, ray));
    const double mu = -ray[1];
    const double light =
        (1 - clear * std::exp(-EXTINCTION * HEIGHT)) / (1 + mu) / (4 * std::numbers::pi);
    worst = std::max(worst, std::abs(picture.transmittance[k][0] - clear));
    worstLight = std::max(worstLight, std::abs(picture.radiance[k][0] - light) / light);
  }
  std::printf("wide layer: transmittance within %.2g, light within %.2g\n", worst, worstLight);
  EXPECT_LT(worst, EXTINCTION * ends);
  EXPECT_LT(worstLight, 0.01);
  EXPECT_TRUE(scene.messages().empty()) << scene.messages().front();
}

}  // namespace
