// SPDX-License-Identifier: MIT
// Devices whose buffers of texels are too small for a view's pixels: shaders read words in their
// place (Device::texels), and the picture is the same bit for bit.
#include <gtest/gtest.h>

#include "support/engine_scene.hpp"
#include "support/surface_scene.hpp"

namespace welkin::test {
namespace {

constexpr uint32_t LEAST_TEXELS = 65536;  // that Vulkan promises

struct Picture {
  Image image;
  uint64_t created = 0;  // objects of Vulkan
};

Picture drawn(EngineScene& scene) {
  check(wlkPrepare(scene.context));
  const uint64_t created = SpyDevice::counts().created;
  scene.renderFrame();
  EXPECT_TRUE(scene.device().messages().empty()) << scene.device().messages().front();
  return {scene.read(), created};
}

// From inside a thin cloud that fills the view, whose rays the ground ends: each pixel has its row
// of the cover and a word behind those of all, and their number is odd and larger than the light
// map's.
Picture pictureFromInside() {
  SceneOptions options;
  options.width = 131;
  options.height = 127;
  EngineScene scene(options);
  scene.setSky();
  scene.setSun(40, 70);
  addSurface(scene, support::sphereMesh(3), scene.addHenyeyGreenstein(0.8f), 3e-4f,
             {3000, 3000, 3000}, {0, 1000, 0});
  scene.setCamera({0, 500, 0}, 0, -60);
  return drawn(scene);
}

// Half resolution, as the levels choose it: its pixels' rays are rows, like what the view's volumes
// and surfaces leave. A surface in front of a volume and another behind both, so that each reads
// what the ones before have left; all of them in fog over the ground. The nearer one has detail,
// whose cells are rows as well.
Picture pictureOf(const SceneOptions& options) {
  EngineScene scene(options);
  scene.setSky();
  scene.setSun(40, 70);
  scene.setFog(1e-5f, 1000);
  scene.addBall(0.002f);
  const WlkMedium medium = scene.addHenyeyGreenstein(0.8f);
  const WlkSurface near = addSurface(scene, support::sphereMesh(3), medium, 0.01f, {300, 300, 300},
                                     {-500, 1700, -3000});
  auto detail = make<WlkSurfaceDetail>();
  detail.depth = 60;
  detail.size = 180;
  check(wlkSetSurfaceDetail(scene.context, near, &detail));
  addSurface(scene, support::torusMesh(), medium, 0.01f, {900, 900, 900}, {600, 1300, -7000});
  scene.setCamera({0, 1400, 0}, 0, 0);
  return drawn(scene);
}

class Texels : public ::testing::TestWithParam<uint32_t> {};

TEST_P(Texels, DevicesWithoutThemDrawTheSame) {
  SceneOptions options;
  options.width = 96;
  options.height = 64;
  options.volumeResolution = WLK_VOLUME_RESOLUTION_DEFAULT;
  options.level = WLK_QUALITY_HIGH;
  options.volumeCells = 8;
  options.composite = GetParam();
  const Picture with = pictureOf(options);
  SpyDevice::fakeTexels(LEAST_TEXELS);
  const Picture without = pictureOf(options);
  EXPECT_GT(with.created, without.created) << "views of texels";
  EXPECT_TRUE(with.image == without.image);
  EXPECT_EQ(with.image.badValues(), 0u);
  EXPECT_GT(with.image.mean(), 0.0);
}

TEST(TexelRows, AreThereToTheLastPixel) {
  const Picture with = pictureFromInside();
  SpyDevice::fakeTexels(LEAST_TEXELS);
  const Picture without = pictureFromInside();
  EXPECT_GT(with.created, without.created) << "views of texels";
  EXPECT_TRUE(with.image == without.image);
  EXPECT_GT(with.image.mean(), 0.0);
}

INSTANTIATE_TEST_SUITE_P(Of, Texels, ::testing::Values(WLK_COMPOSITE_COMPUTE, WLK_COMPOSITE_BLEND));

}  // namespace
}  // namespace welkin::test
