// SPDX-License-Identifier: MIT
// Volumes of extreme shape and views exactly along and against the sun: no pixel stands out of its
// neighbours where the scene is smooth.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "support/headless_scene.hpp"
#include "support/on_gpu.hpp"

namespace welkin::test {
namespace {

constexpr uint32_t SIZE = 40;

SceneOptions square() {
  SceneOptions options;
  options.width = options.height = SIZE;
  options.layers = WLK_LAYER_VOLUMES;
  return options;
}

// By how much a pixel is brighter than the brightest of its eight neighbours, over that one, and
// the same of the darkest; at pixels whose neighbours are alike within `smooth`. Sharp edges, where
// a pixel may be anything, have neighbours that are not.
double worstSpeckle(const Image& image, double smooth, uint32_t& counted) {
  double worst = 0;
  // What is black is alike; on a GPU also where all is, since a lit cloud has 0.1: tails of e^-46
  // end elsewhere there.
  const double floor = std::max(1e-3 * image.mean(), onGpu() ? 1e-7 : 0.0);
  for (uint32_t y = 1; y + 1 < image.height; ++y) {
    for (uint32_t x = 1; x + 1 < image.width; ++x) {
      double low = 1e30;
      double high = 0;
      for (uint32_t k = 0; k < 9; ++k) {
        if (k != 4) {
          const double value = static_cast<double>(image.at(x + k % 3 - 1, y + k / 3 - 1)[1]);
          low = std::min(low, value);
          high = std::max(high, value);
        }
      }
      if (high - low > smooth * high + floor) {
        continue;
      }
      ++counted;
      const double value = static_cast<double>(image.at(x, y)[1]);
      worst = std::max(worst, std::max(value - high, low - value) / (high + floor));
    }
  }
  return worst;
}

struct Shape {
  const char* name;
  std::array<uint32_t, 3> voxels;
  float depth;  // optical, across the box
};

// A smooth hump of density, nowhere 0.
std::vector<float> hump(const std::array<uint32_t, 3>& n) {
  std::vector<float> values;
  for (uint32_t z = 0; z < n[2]; ++z) {
    for (uint32_t y = 0; y < n[1]; ++y) {
      for (uint32_t x = 0; x < n[0]; ++x) {
        const auto at = [](uint32_t i, uint32_t count) { return (i + 0.5) / count - 0.5; };
        const double square =
            at(x, n[0]) * at(x, n[0]) + at(y, n[1]) * at(y, n[1]) + at(z, n[2]) * at(z, n[2]);
        values.push_back(static_cast<float>(0.2 + 0.8 * std::exp(-6 * square)));
      }
    }
  }
  return values;
}

class Speckles : public ::testing::TestWithParam<uint32_t> {};

TEST_P(Speckles, StandInNoPictureOfASmoothVolume) {
  // Neighbours within 20 %; a pixel may stand out of them by a tenth.
  constexpr double SMOOTH = 0.2;
  constexpr double BOUND = 0.1;
  const HeadlessScene scene(square());
  auto quality = make<WlkQuality>();
  quality.level = WLK_QUALITY_LOW;
  quality.scattering = GetParam();
  check(wlkSetQuality(scene.context, scene.view, &quality));
  const WlkMedium medium = scene.addMedium();
  uint32_t counted = 0;
  for (const Shape& shape :
       {Shape{"cube", {16, 16, 16}, 8}, Shape{"one voxel thin", {24, 1, 24}, 1},
        Shape{"odd", {17, 5, 31}, 8}, Shape{"one voxel", {1, 1, 1}, 4},
        Shape{"opaque", {12, 12, 12}, 1e5f}}) {
    const WlkVolume volume =
        scene.addVolume(medium, shape.voxels, boxTransform({-400, 1600, -1900}, {800, 800, 800}),
                        shape.depth / 800);
    scene.upload(volume, shape.voxels, hump(shape.voxels));
    // The eye looks level at the box's middle along -z: azimuth 0 is the light exactly ahead, 180
    // behind.
    scene.setCamera({0, 2000, 0}, 0, 0);
    for (const double azimuth : {0.0, 90.0, 180.0}) {
      scene.setSun(azimuth == 90 ? 90 : 0, azimuth);
      const Image image = scene.render();
      EXPECT_EQ(image.badValues(), 0u);
      if (shape.depth < 100) {  // all orders leave opaque volumes dark, see docs/models.md
        EXPECT_GT(image.mean(), 0) << shape.name << ", sun " << azimuth;
      }
      const double worst = worstSpeckle(image, SMOOTH, counted);
      std::printf("scattering %u, %s, sun %g: %.3f\n", GetParam(), shape.name, azimuth, worst);
      EXPECT_LT(worst, BOUND) << shape.name << ", sun " << azimuth;
    }
    check(wlkDestroyVolume(scene.context, volume));
  }
  EXPECT_GT(counted, 1000u);
  EXPECT_TRUE(scene.messages().empty()) << scene.messages().front();
}

INSTANTIATE_TEST_SUITE_P(Forms, Speckles,
                         ::testing::Values(WLK_SCATTERING_FORWARD, WLK_SCATTERING_ALL_ORDERS),
                         [](const ::testing::TestParamInfo<uint32_t>& one) {
                           return one.param == WLK_SCATTERING_FORWARD ? "Forward" : "AllOrders";
                         });

}  // namespace
}  // namespace welkin::test
