// SPDX-License-Identifier: MIT
// The bare planet hides volumes and surfaces that lie behind it, where it is drawn.
#include <gtest/gtest.h>

#include "support/surface_scene.hpp"

namespace welkin::test {
namespace {

// Under the ground, 20 km away; the eye looks at its middle from 2 m.
constexpr std::array<double, 3> LOW{-2000, -3500, -22000};
constexpr std::array<double, 3> EDGES{4000, 2000, 4000};

class PlanetHides : public ::testing::TestWithParam<uint64_t> {
 protected:
  PlanetHides() : scene(options()) {
    scene.setSky();
    scene.setSun(40, 160);
    scene.setCamera({0, 2, 0}, 0, -7);
  }
  static SceneOptions options() {
    SceneOptions options;
    options.layers = WLK_LAYER_ALL & ~GetParam();
    return options;
  }
  // Where the planet is not drawn the engine's ground is elsewhere, and it hides nothing.
  void expectHidden(const Image& bare, const Image& with) const {
    EXPECT_EQ(with.badValues(), 0u);
    EXPECT_TRUE(scene.messages().empty()) << scene.messages().front();
    if (GetParam() == 0) {
      EXPECT_TRUE(with == bare) << relativeRms(with, bare);
    } else {
      EXPECT_GT(relativeRms(with, bare), 0.1);
    }
  }
  const HeadlessScene scene;
};

TEST_P(PlanetHides, Volumes) {
  const Image bare = scene.render();
  const WlkVolume volume =
      scene.addVolume(scene.addMedium(), {2, 2, 2}, boxTransform(LOW, EDGES), 0.01f);
  scene.upload(volume, {2, 2, 2}, std::vector<float>(8, 1.0f));
  expectHidden(bare, scene.render());
  auto quality = make<WlkQuality>();
  quality.level = WLK_QUALITY_LOW;
  quality.volumeResolution = WLK_VOLUME_RESOLUTION_HALF;
  check(wlkSetQuality(scene.context, scene.view, &quality));
  expectHidden(bare, scene.render());
  quality.volumeResolution = 0;
  quality.batchSize = 8;
  check(wlkSetQuality(scene.context, scene.view, &quality));
  expectHidden(bare, scene.render());
}

TEST_P(PlanetHides, Surfaces) {
  const Image bare = scene.render();
  addSurface(scene, support::boxMesh(), scene.addMedium(), 0.01f,
             {EDGES[0] / 2, EDGES[1] / 2, EDGES[2] / 2},
             {LOW[0] + EDGES[0] / 2, LOW[1] + EDGES[1] / 2, LOW[2] + EDGES[2] / 2});
  expectHidden(bare, scene.render());
}

// What stands half in the ground ends there: the picture is that of its upper half.
TEST_P(PlanetHides, EndsRaysInTheMiddleOfAVolume) {
  if (GetParam() != 0) {
    return;
  }
  const auto render = [](double bottom) {
    const HeadlessScene own(options());
    own.setSky();
    own.setSun(40, 160);
    own.setCamera({0, 300, 0}, 0, -7);
    const WlkVolume volume =
        own.addVolume(own.addMedium(), {2, 2, 2},
                      boxTransform({-2000, bottom, -9000}, {4000, 800 - bottom, 4000}), 2e-4f);
    own.upload(volume, {2, 2, 2}, std::vector<float>(8, 1.0f));
    auto quality = make<WlkQuality>();
    quality.level = WLK_QUALITY_HIGH;
    quality.scattering = WLK_SCATTERING_SINGLE;  // the lower half scatters nothing upwards then
    check(wlkSetQuality(own.context, own.view, &quality));
    return own.render();
  };
  // The ground falls by up to 7 m under its tangent plane; slabs of either box are not the same.
  EXPECT_LT(relativeRms(render(-800), render(-7)), 0.01);
}

// Light maps of surfaces are not of the eye's rays.
TEST(PlanetHidesNothing, FromTheSun) {
  const auto render = [](uint64_t without) {
    SceneOptions options;
    options.layers = WLK_LAYER_ALL & ~without;
    const HeadlessScene scene(options);
    scene.setSky();
    scene.setSun(40, 160);
    scene.setCamera({0, 2, 0}, 0, 40);
    addSurface(scene, support::torusMesh(), scene.addMedium(), 0.01f, {900, 900, 900},
               {0, 3300, -4000});
    return scene.render();
  };
  EXPECT_TRUE(render(0) == render(WLK_LAYER_GROUND));
}

INSTANTIATE_TEST_SUITE_P(Layers, PlanetHides,
                         ::testing::Values(uint64_t{0}, uint64_t{WLK_LAYER_GROUND}));

}  // namespace
}  // namespace welkin::test
