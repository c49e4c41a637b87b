// SPDX-License-Identifier: MIT
// The light of sky and ground inside a volume is computed where it may have changed, and nowhere
// else; without it nothing is recorded and the picture is as before.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "support/engine_scene.hpp"
#include "support/library_allocations.hpp"

namespace welkin::test {
namespace {

constexpr int WARM_UP = 4;  // maxFramesInFlight + 1: every slot was recorded once
constexpr uint32_t SHOWN = 1;
constexpr uint32_t COMPUTED_AT_LEAST = 50;  // rounds over all levels of the grid

SceneOptions small() {
  SceneOptions options;
  options.width = 24;
  options.height = 16;
  return options;
}

class VolumeAmbientBudget : public ::testing::Test {
 protected:
  VolumeAmbientBudget() : scene(small()) {
    scene.setCamera({0, 2, 0}, 0, 12);
    scene.setSun(30, 20);
    scene.setSky();
    scene.addBall(0.01f);
  }
  ~VolumeAmbientBudget() override {
    EXPECT_TRUE(scene.device().messages().empty()) << scene.device().messages().front();
  }

  void setAmbient(uint32_t mode, float sky = 0) const {
    auto ambient = make<WlkAmbient>();
    ambient.mode = mode;
    std::fill_n(ambient.sky, 3, sky);
    check(wlkSetAmbient(scene.context, &ambient));
  }
  void prepare() const { check(wlkPrepare(scene.context)); }
  void render() {
    const FrameCounts counts = scene.renderFrame();
    EXPECT_EQ(scene.stats().dispatches, counts.view.dispatches);
    EXPECT_EQ(scene.stats().barriers, counts.view.barriers);
    EXPECT_EQ(scene.stats().nonFinitePixels, 0u);
  }
  // Lines of the pass in the frame that was rendered last.
  std::vector<WlkPassStats> lines() const {
    std::vector<WlkPassStats> found;
    for (const WlkPassStats& pass : scene.passes()) {
      if (pass.pass == WLK_PASS_VOLUME_AMBIENT) {
        EXPECT_STREQ(pass.name, "volume ambient");
        found.push_back(pass);
      }
    }
    return found;
  }
  void expect(uint32_t reason, uint32_t least, uint32_t most, const char* after) {
    render();
    ASSERT_EQ(lines().size(), 1u) << after;
    EXPECT_STREQ(wlkReasonName(lines()[0].reason), wlkReasonName(reason)) << after;
    EXPECT_GE(lines()[0].commands, least) << after;
    EXPECT_LE(lines()[0].commands, most) << after;
    EXPECT_EQ(lines()[0].recorded, most > 0 ? 1u : 0u) << after;
  }
  void expectComputed(const char* after) {
    expect(WLK_REASON_NEEDED, COMPUTED_AT_LEAST, 10000, after);
  }
  void expectKept(const char* after) { expect(WLK_REASON_UNCHANGED, SHOWN, SHOWN, after); }

  EngineScene scene;
};

TEST_F(VolumeAmbientBudget, KeepsWhatHasNotChangedAndWritesNoDescriptor) {
  setAmbient(WLK_AMBIENT_AUTOMATIC);
  prepare();
  expectComputed("the first frame");
  for (int i = 0; i < WARM_UP + 4; ++i) {
    scene.setCamera({20.0 * i, 2, -10.0 * i}, 1.0 * i, 12);
    const uint64_t before = libraryAllocations();
    expectKept("the camera moved");
    if (i >= WARM_UP) {
      EXPECT_EQ(scene.stats().descriptorWrites, 0u) << i;
      EXPECT_EQ(libraryAllocations(), before) << i;
    }
  }
  const uint64_t before = libraryAllocations();
  scene.setSun(31, 20);
  expectComputed("the sun rose");
  EXPECT_EQ(libraryAllocations(), before);
  scene.setSun(31, 20);
  expectKept("the same sun");
}

TEST_F(VolumeAmbientBudget, GivenLightDoesNotDependOnTheSun) {
  setAmbient(WLK_AMBIENT_GIVEN, 0.1f);
  prepare();
  expectComputed("the first frame");
  scene.setSun(31, 20);
  expectKept("the sun rose");
  setAmbient(WLK_AMBIENT_GIVEN, 0.2f);
  expectComputed("another light");
}

TEST_F(VolumeAmbientBudget, IsDarkWithoutAnotherPrepare) {
  setAmbient(WLK_AMBIENT_AUTOMATIC);
  prepare();
  expectComputed("the first frame");
  setAmbient(WLK_AMBIENT_GIVEN, 0.0f);
  expect(WLK_REASON_NO_LIGHT, 0, 0, "no light is given");
}

TEST_F(VolumeAmbientBudget, NothingIsRecordedWithoutIt) {
  setAmbient(WLK_AMBIENT_OFF);
  prepare();
  render();
  EXPECT_TRUE(lines().empty());
  const Image off = scene.read();
  setAmbient(WLK_AMBIENT_GIVEN);
  prepare();
  expect(WLK_REASON_NO_LIGHT, 0, 0, "black light");
  EXPECT_TRUE(scene.read() == off);
  setAmbient(WLK_AMBIENT_AUTOMATIC);
  scene.setCamera({0, 2, 0}, 180, 12);
  expect(WLK_REASON_OUTSIDE_VIEW, 0, 0, "the camera turned away");
  scene.clearLights();
  scene.setCamera({0, 2, 0}, 0, 12);
  expect(WLK_REASON_NO_LIGHT, 0, 0, "the sun is gone");
}

TEST_F(VolumeAmbientBudget, WithoutSkippingComputesEachFrameTheSamePicture) {
  setAmbient(WLK_AMBIENT_AUTOMATIC);
  prepare();
  expectComputed("the first frame");
  const Image computed = scene.read();
  expectKept("nothing");
  EXPECT_TRUE(scene.read() == computed);
  scene.setQuality(WLK_QUALITY_LOW, WLK_QUALITY_FLAG_NO_SKIP);
  prepare();
  for (int i = 0; i < 2; ++i) {
    render();
    ASSERT_EQ(lines().size(), 1u);
    EXPECT_GE(lines()[0].commands, COMPUTED_AT_LEAST);
    EXPECT_TRUE(scene.read() == computed);
  }
}

TEST_F(VolumeAmbientBudget, IsAutomaticWhereNothingWasSet) {
  SceneOptions options = small();
  options.ambient = true;
  EngineScene own(options);
  own.setCamera({0, 2, 0}, 0, 12);
  own.setSun(30, 20);
  own.setSky();
  own.addBall(0.01f);
  check(wlkPrepare(own.context));
  own.renderFrame();
  setAmbient(WLK_AMBIENT_AUTOMATIC);
  prepare();
  render();
  EXPECT_TRUE(own.read() == scene.read());
  setAmbient(WLK_AMBIENT_OFF);
  prepare();
  render();
  EXPECT_FALSE(own.read() == scene.read());
}

TEST_F(VolumeAmbientBudget, WithoutAirItNeedsNothing) {
  scene.clearSky();
  prepare();
  render();
  EXPECT_TRUE(lines().empty());
  setAmbient(WLK_AMBIENT_AUTOMATIC);
  expect(WLK_REASON_NOTHING_TO_DRAW, 0, 0, "no wlkPrepare between");
  setAmbient(WLK_AMBIENT_OFF);
  render();
  EXPECT_TRUE(lines().empty());
  setAmbient(WLK_AMBIENT_AUTOMATIC);
  scene.setFog(1e-4f, 300);
  prepare();
  expectComputed("fog");
}

// Views of one frame may see different images in a field: what the first computes from the engine's
// image is not kept as that of the upload.
TEST_F(VolumeAmbientBudget, OfAnImageOfTheEnginesIsNotThatOfTheUpload) {
  constexpr uint32_t N = 8;  // voxels along the ball's edges
  setAmbient(WLK_AMBIENT_AUTOMATIC);
  const WlkView first = scene.view;
  // Filled to its faces, as an image counts: the grid has the same place.
  const WlkVolume volume = scene.addBall(0.01f);
  scene.upload(volume, {N, N, N}, std::vector<float>(size_t{N} * N * N, 1.0f));
  const std::array views{first, scene.addView(small())};
  scene.view = views[1];
  scene.setCamera({0, 2, 0}, 0, 12);
  scene.view = first;
  prepare();
  scene.renderFrame();
  const Image uploaded = scene.read();
  const SpyImage image(scene.device(), VK_FORMAT_R32_SFLOAT, {N, N, N},
                       VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT);
  std::fill_n(reinterpret_cast<float*>(image.bytes()), size_t{N} * N * N, 0.25f);
  image.write(VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  const WlkVulkanImage described = scene.describe(image, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  check(wlkVulkanSetVolumeImage(scene.context, volume, 0, &described));
  scene.betweenViews = [&] { check(wlkVulkanSetVolumeImage(scene.context, volume, 0, nullptr)); };
  scene.renderFrames(views);
  EXPECT_TRUE(scene.read() == uploaded) << "the second view";
  scene.renderFrame();
  EXPECT_TRUE(scene.read() == uploaded) << "the next frame";
  check(wlkVulkanForgetImage(scene.context, image.handle));
}

TEST_F(VolumeAmbientBudget, SingleScatteringHasNone) {
  setAmbient(WLK_AMBIENT_AUTOMATIC);
  auto quality = make<WlkQuality>();
  quality.level = WLK_QUALITY_LOW;
  quality.scattering = WLK_SCATTERING_SINGLE;
  check(wlkSetQuality(scene.context, scene.view, &quality));
  prepare();
  expect(WLK_REASON_LAYER_OFF, 0, 0, "single scattering");
}

}  // namespace
}  // namespace welkin::test
