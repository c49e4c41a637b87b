// SPDX-License-Identifier: MIT
// Failures that users of other renderers reported, asked of Welkin; docs/reliability.md has the
// list.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/headless_scene.hpp"

namespace welkin::test {
namespace {

// 9: an exactly black picture stays so where nothing shines, and takes light where something does.
TEST(Reported, BlackPicturesAreNoTrouble) {
  const HeadlessScene scene;
  scene.addBall(0.01f);
  const std::vector<float> black(size_t{scene.options().width} * scene.options().height * 4, 0.0f);
  auto targets = make<WlkHeadlessInputs>();
  targets.color = black.data();
  targets.colorSize = black.size() * sizeof(float);
  const Image dark = scene.render(&targets);
  EXPECT_EQ(dark.badValues(), 0u);
  EXPECT_EQ(dark.mean(), 0);
  scene.setSky();
  scene.setSun(40, 30);
  const Image day = scene.render(&targets);
  EXPECT_EQ(day.badValues(), 0u);
  EXPECT_GT(day.mean(), 0);
}

// 5: a slab of one voxel, seen from a camera that creeps past, changes as little as its way.
TEST(Reported, ThinVolumesDoNotFlicker) {
  const HeadlessScene scene;
  scene.setSun(50, 20);
  const WlkVolume slab = scene.addVolume(
      scene.addMedium(), {32, 1, 32}, boxTransform({-2000, 1500, -6000}, {4000, 15, 4000}), 0.02f);
  scene.upload(slab, {32, 1, 32}, std::vector<float>(1024, 1.0f));
  double last = 0;
  for (int i = 0; i < 40; ++i) {
    scene.setCamera({0.02 * i, 2, 0.05 * i}, 0, 12);
    const double mean = scene.render().mean();
    EXPECT_GT(mean, 0);
    if (i > 0) {
      // 5 cm of at least 1500 m, three times over.
      EXPECT_NEAR(mean / last, 1, 1e-4) << i;
    }
    last = mean;
  }
}

// 23: the sky is the same on both sides of the sun's azimuth, across which nothing jumps.
TEST(Reported, NoSeamAtTheSunsAzimuth) {
  SceneOptions options;
  options.width = 64;
  // The steps of a ray are sums of floats of either sign: below 3e-6 seen.
  constexpr float MIRRORED = 1e-5f;
  const HeadlessScene scene(options);
  scene.setSky();
  for (const double elevation : {2.0, 20.0, 60.0}) {
    scene.setSun(elevation, 0);
    scene.setCamera({0, 2, 0}, 0, 80);  // over the zenith, the sun's disk out of view
    const Image image = scene.render();
    for (uint32_t y = 0; y < image.height; ++y) {
      for (uint32_t x = 0; x < image.width / 2; ++x) {
        const float left = image.at(x, y)[2];
        const float right = image.at(image.width - 1 - x, y)[2];
        EXPECT_NEAR(left / right, 1, MIRRORED) << elevation << ' ' << x << ' ' << y;
      }
    }
  }
}

// Largest change of the light's slope from row to row, over the light, in the middle column and
// over the horizon, which is in the picture's middle: under it the ground begins.
double roughness(const Image& image) {
  double worst = 0;
  for (uint32_t y = 1; y + 1 < image.height / 2; ++y) {
    const auto value = [&](uint32_t row) {
      return static_cast<double>(image.at(image.width / 2, row)[1]);
    };
    worst = std::max(
        worst, std::abs(value(y - 1) - 2 * value(y) + value(y + 1)) / std::max(value(y), 1e-9));
  }
  return worst;
}

// A smooth picture's falls at least by half with twice the rows, a step's stays. Half of what eyes
// tell apart, 2 per thousand, is no trouble.
void expectSmooth(const Image& image, const Image& fine) {
  EXPECT_EQ(image.badValues(), 0u);
  EXPECT_GT(image.mean(), 0);
  EXPECT_LT(roughness(fine), 0.6 * roughness(image) + 0.001);
}

// 7: fog of 50 m of sight, from just over the ground to just under its top.
TEST(Reported, DenseFogNearTheGroundHasNoBands) {
  const auto render = [](double height, uint32_t rows) {
    SceneOptions options;
    options.height = rows;
    options.layers = WLK_LAYER_SKY | WLK_LAYER_FOG;
    const HeadlessScene scene(options);
    scene.setSky();
    scene.setFog(0.08f, 30);
    scene.setSun(35, 180);  // behind the eye
    scene.setCamera({0, height, 0}, 0, 0);
    return scene.render();
  };
  for (const double height : {0.01, 1.7, 29.0, 90.0}) {
    SCOPED_TRACE(height);
    expectSmooth(render(height, 96), render(height, 192));
  }
}

// 16: a wall across the horizon has no stripe there.
TEST(Reported, NoStripeOnObjectsAtTheHorizon) {
  const auto render = [](double distance, uint32_t rows) {
    SceneOptions options;
    options.height = rows;
    const HeadlessScene scene(options);
    scene.setSky();
    scene.setSun(30, 140);
    const auto camera = make<WlkCamera>();
    const auto* m = camera.clipFromView;
    const double depth = (static_cast<double>(m[10]) * -distance + static_cast<double>(m[14])) /
                         (static_cast<double>(m[11]) * -distance + static_cast<double>(m[15]));
    const std::vector<float> pixels(size_t{options.width} * rows, static_cast<float>(depth));
    auto targets = make<WlkHeadlessInputs>();
    targets.depth = pixels.data();
    targets.depthSize = pixels.size() * sizeof(float);
    scene.setCamera({0, 100, 0}, 0, 0);
    return scene.render(&targets);
  };
  for (const double distance : {2e3, 2e4, 1e5}) {
    SCOPED_TRACE(distance);
    expectSmooth(render(distance, 96), render(distance, 192));
  }
}

// 30 and 31: no asymmetry of 1 is taken; the largest that are give a picture without black dots.
TEST(Reported, SharpestPhaseFunctionsAreFinite) {
  const HeadlessScene scene;
  scene.setSun(20, 0);
  auto info = make<WlkMediumInfo>();
  info.particle = WLK_PARTICLE_HENYEY_GREENSTEIN;
  for (const float g : {1.0f, -1.0f, 0.9999f}) {
    info.asymmetry = g;
    WlkMedium none{};
    EXPECT_EQ(wlkCreateMedium(scene.context, &info, &none), WLK_ERROR_INVALID_ARGUMENT) << g;
  }
  for (const float g : {0.999f, -0.999f}) {
    const WlkVolume slab =
        scene.addVolume(scene.addHenyeyGreenstein(g), {4, 4, 4},
                        boxTransform({-1000, 500, -5000}, {2000, 2000, 2000}), 0.002f);
    scene.upload(slab, {4, 4, 4}, std::vector<float>(64, 1.0f));
    for (const double pitch : {20.0, 19.9, -20.0}) {
      scene.setCamera({0, 2, 0}, 0, pitch);
      const Image image = scene.render();
      EXPECT_EQ(image.badValues(), 0u) << g << ' ' << pitch;
    }
    check(wlkDestroyVolume(scene.context, slab));
  }
}

// 41: fog keeps its altitude when the camera rises: what is over it falls off as its density.
TEST(Reported, FogStaysWhereItIs) {
  SceneOptions options;
  options.composite = WLK_COMPOSITE_SEPARATE;
  options.width = options.height = 9;
  options.layers = WLK_LAYER_FOG;
  const HeadlessScene scene(options);
  constexpr double EXTINCTION = 0.002;
  constexpr double HEIGHT = 200;
  scene.setFog(static_cast<float>(EXTINCTION), static_cast<float>(HEIGHT));
  for (const double y : {2.0, 100.0, 400.0, 1500.0}) {
    scene.setCamera({0, y, 0}, 0, 90);
    scene.render();
    const Image image = scene.read(WLK_IMAGE_TRANSMITTANCE);
    const double depth = EXTINCTION * HEIGHT * std::exp(-y / HEIGHT);
    // Four half units of a float below 1: of the depth, its exponential, the volume's share and
    // the product.
    EXPECT_NEAR(static_cast<double>(image.at(4, 4)[0]), std::exp(-depth), 4 * std::exp2(-25)) << y;
  }
}

}  // namespace
}  // namespace welkin::test
