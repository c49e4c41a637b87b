// SPDX-License-Identifier: MIT
// A frame records what the scene needs and nothing else, says why, and looks the same as one that
// records everything.
#include <gtest/gtest.h>

#include "support/engine_scene.hpp"

namespace welkin::test {
namespace {

SceneOptions small() {
  SceneOptions options;
  options.width = 24;
  options.height = 16;
  options.scattering = WLK_SCATTERING_FORWARD;  // volume_light_budget_test.cpp has all orders
  return options;
}

// LOW: one batch of 32 slices, so one dispatch per pass and volume.
constexpr uint64_t COMPOSITE_ONLY = 1;
constexpr uint64_t EYE_AND_COMPOSITE = 2;
constexpr uint64_t ALL_OF_ONE_VOLUME = 3;
// Air in the sun: light scattered more than once, whose table a new view needs.
constexpr uint64_t SKY_TABLE = 1;

class Skip : public ::testing::Test {
 protected:
  Skip() : scene(small()) { scene.setCamera({0, 2, 0}, 0, 12); }
  ~Skip() override {
    EXPECT_TRUE(scene.device().messages().empty()) << scene.device().messages().front();
  }

  // Prepares, renders, and holds the statistics against the calls that were seen.
  FrameCounts render() {
    check(wlkPrepare(scene.context));
    const FrameCounts counts = scene.renderFrame();
    const WlkFrameStats stats = scene.stats();
    EXPECT_EQ(stats.frameIndex, scene.frame());
    EXPECT_EQ(stats.dispatches, counts.view.dispatches);
    EXPECT_EQ(stats.draws, counts.view.draws);
    EXPECT_EQ(stats.barriers, counts.view.barriers);
    EXPECT_EQ(stats.descriptorWrites, counts.view.descriptorWrites);
    EXPECT_EQ(stats.nonFinitePixels, 0u);
    uint64_t commands = 0;
    for (const WlkPassStats& pass : scene.passes()) {
      EXPECT_EQ(pass.recorded != 0, pass.commands > 0) << pass.name;
      EXPECT_EQ(pass.recorded != 0, pass.invocations > 0) << pass.name;
      const bool runs = pass.reason == WLK_REASON_NEEDED || pass.reason == WLK_REASON_NO_SKIP_FLAG;
      EXPECT_EQ(pass.recorded != 0, runs) << pass.name << ": " << wlkReasonName(pass.reason);
      commands += pass.commands;
    }
    EXPECT_EQ(commands, counts.view.dispatches + counts.view.draws);
    return counts;
  }

  uint32_t reasonOf(uint32_t kind) const {
    uint32_t reason = 0xffffffffu;
    uint32_t found = 0;
    for (const WlkPassStats& pass : scene.passes()) {
      if (pass.pass == kind) {
        reason = pass.reason;
        ++found;
      }
    }
    EXPECT_EQ(found, 1u);
    return reason;
  }

  void expectReasons(uint32_t light, uint32_t eye, uint32_t composite) const {
    EXPECT_STREQ(wlkReasonName(reasonOf(WLK_PASS_LIGHT_SLICES)), wlkReasonName(light));
    EXPECT_STREQ(wlkReasonName(reasonOf(WLK_PASS_EYE_SLICES)), wlkReasonName(eye));
    EXPECT_STREQ(wlkReasonName(reasonOf(WLK_PASS_COMPOSITE)), wlkReasonName(composite));
  }

  // The picture with everything recorded is the same, bit for bit: what was skipped adds exact
  // zeros, and multiplies by exact ones.
  void expectSameWithoutSkipping() {
    const Image skipped = scene.read();
    scene.setQuality(WLK_QUALITY_LOW, WLK_QUALITY_FLAG_NO_SKIP);
    const FrameCounts counts = render();
    EXPECT_GE(counts.view.dispatches, COMPOSITE_ONLY);
    const Image full = scene.read();
    EXPECT_TRUE(full == skipped) << "relative RMS " << relativeRms(full, skipped);
    scene.setQuality(WLK_QUALITY_LOW);
  }

  EngineScene scene;
};

// The engine's next pass waits for what wrote the image before, drawn or not.
TEST_F(Skip, AnImageThatNothingIsDrawnOnTakesOneBarrierToAnotherState) {
  scene.inPlace = true;
  WlkVulkanImage color = EngineScene::describe(scene.target(), VK_IMAGE_LAYOUT_GENERAL);
  scene.addTargets = [&](WlkVulkanViewTargets& targets) {
    targets.color = targets.colorInput = &color;
  };
  const WlkVulkanImageState same = color.after;
  EXPECT_EQ(render().view.barriers, 0u);
  color.after.stages = VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
  EXPECT_EQ(render().view.barriers, 1u);
  color.after = same;
  color.after.access = VK_ACCESS_2_MEMORY_READ_BIT;
  EXPECT_EQ(render().view.barriers, 1u);
  color.after = same;
  EXPECT_EQ(render().view.barriers, 0u);
  color.after.layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
  const FrameCounts counts = render();
  EXPECT_EQ(counts.view.barriers, 1u);
  EXPECT_EQ(counts.view.dispatches + counts.view.draws, 0u);
}

TEST_F(Skip, AnEmptySceneOnTheEnginesImageRecordsNothingAtAll) {
  scene.inPlace = true;
  const FrameCounts counts = render();
  EXPECT_EQ(counts.view.dispatches + counts.view.draws, 0u);
  EXPECT_EQ(counts.view.barriers + counts.view.copies, 0u);
  EXPECT_EQ(counts.view.descriptorWrites, 0u);
  EXPECT_EQ(reasonOf(WLK_PASS_COMPOSITE), uint32_t{WLK_REASON_NOTHING_TO_DRAW});
  EXPECT_EQ(scene.passes().size(), 2u);
  expectSameWithoutSkipping();
}

TEST_F(Skip, AnEmptySceneStillWritesATargetOfItsOwn) {
  const FrameCounts counts = render();
  EXPECT_EQ(counts.view.dispatches, COMPOSITE_ONLY);
  EXPECT_EQ(reasonOf(WLK_PASS_COMPOSITE), uint32_t{WLK_REASON_NEEDED});
  EXPECT_EQ(scene.read().mean(), 0.0);
  expectSameWithoutSkipping();
}

TEST_F(Skip, ACloudInTheSunNeedsEveryPass) {
  scene.setSky();
  scene.setSun(30, 20);
  scene.addBall(0.01f);
  const FrameCounts counts = render();
  EXPECT_EQ(counts.view.dispatches, SKY_TABLE + ALL_OF_ONE_VOLUME);
  expectReasons(WLK_REASON_NEEDED, WLK_REASON_NEEDED, WLK_REASON_NEEDED);
  EXPECT_GT(scene.read().mean(), 0.0);
  expectSameWithoutSkipping();
}

TEST_F(Skip, TheSkysTableIsMadeAnewOnlyWhereEyeLightOrAirHaveChanged) {
  scene.setSky();
  scene.setSun(30, 20);
  EXPECT_EQ(render().view.dispatches, SKY_TABLE + COMPOSITE_ONLY);
  EXPECT_EQ(reasonOf(WLK_PASS_SKY_TABLE), uint32_t{WLK_REASON_NEEDED});
  scene.setCamera({0, 2, 0}, 120, -5);
  EXPECT_EQ(render().view.dispatches, COMPOSITE_ONLY) << "the camera turned";
  EXPECT_EQ(reasonOf(WLK_PASS_SKY_TABLE), uint32_t{WLK_REASON_UNCHANGED});
  scene.setCamera({0, 2.01, 0}, 120, -5);
  EXPECT_EQ(render().view.dispatches, SKY_TABLE + COMPOSITE_ONLY) << "the camera rose";
  scene.setSun(30.01, 20);
  EXPECT_EQ(render().view.dispatches, SKY_TABLE + COMPOSITE_ONLY) << "the sun rose";
  auto sky = make<WlkSky>();
  sky.scaleHeight = 7000;
  ASSERT_EQ(wlkSetSky(scene.context, &sky), WLK_SUCCESS);
  EXPECT_EQ(render().view.dispatches, SKY_TABLE + COMPOSITE_ONLY) << "the air changed";
  EXPECT_EQ(render().view.dispatches, COMPOSITE_ONLY);
  auto quality = make<WlkQuality>();
  quality.scattering = WLK_SCATTERING_SINGLE;
  ASSERT_EQ(wlkSetQuality(scene.context, scene.view, &quality), WLK_SUCCESS);
  EXPECT_EQ(render().view.dispatches, COMPOSITE_ONLY) << "single scattering";
  EXPECT_EQ(reasonOf(WLK_PASS_SKY_TABLE), uint32_t{WLK_REASON_NOTHING_TO_DRAW});
}

TEST_F(Skip, AVolumeOfZeroDensityIsNotMarched) {
  scene.setSky();
  scene.setSun(30, 20);
  const WlkVolume volume = scene.addBall(0.01f);
  scene.upload(volume, {8, 8, 8}, std::vector<float>(512, 0.0f));
  EXPECT_EQ(render().view.dispatches, SKY_TABLE + COMPOSITE_ONLY);
  expectReasons(WLK_REASON_ZERO_DENSITY, WLK_REASON_ZERO_DENSITY, WLK_REASON_NEEDED);
  expectSameWithoutSkipping();
}

TEST_F(Skip, AVolumeThatWasNeverFilledOrDoesNotExtinguishIsNotMarched) {
  scene.setSky();
  scene.setSun(30, 20);
  const WlkMedium medium = scene.addMedium();
  const auto box = boxTransform({-1000, 500, -6000}, {2000, 2000, 2000});
  const WlkVolume empty = scene.addVolume(medium, {4, 4, 4}, box, 0.01f);
  EXPECT_EQ(render().view.dispatches, SKY_TABLE + COMPOSITE_ONLY);
  expectReasons(WLK_REASON_ZERO_DENSITY, WLK_REASON_ZERO_DENSITY, WLK_REASON_NEEDED);
  expectSameWithoutSkipping();
  ASSERT_EQ(wlkDestroyVolume(scene.context, empty), WLK_SUCCESS);
  const WlkVolume clear = scene.addVolume(medium, {4, 4, 4}, box, 0.0f);
  scene.upload(clear, {4, 4, 4}, std::vector<float>(64, 1.0f));
  EXPECT_EQ(render().view.dispatches, SKY_TABLE + COMPOSITE_ONLY);
  expectReasons(WLK_REASON_ZERO_DENSITY, WLK_REASON_ZERO_DENSITY, WLK_REASON_NEEDED);
  expectSameWithoutSkipping();
}

TEST_F(Skip, AVolumeOutsideTheViewIsNotMarched) {
  scene.setSky();
  scene.setSun(30, 20);
  scene.addBall(0.01f);
  for (const double yaw_deg : {180.0, 90.0, -120.0}) {
    scene.setCamera({0, 2, 0}, yaw_deg, 12);
    EXPECT_EQ(render().view.dispatches, SKY_TABLE + COMPOSITE_ONLY) << yaw_deg;
    expectReasons(WLK_REASON_OUTSIDE_VIEW, WLK_REASON_OUTSIDE_VIEW, WLK_REASON_NEEDED);
    expectSameWithoutSkipping();
  }
}

TEST_F(Skip, AVolumeAtTheEdgeOfTheViewIsMarchedInItsRectangleOnly) {
  scene.setSky();
  scene.setSun(30, 20);
  scene.addBall(0.01f);
  const uint64_t pixels = uint64_t{24} * 16;
  bool first = true;  // the others find the light there
  for (const double yaw_deg : {-48.0, 0.0, 41.0}) {
    scene.setCamera({0, 2, 0}, yaw_deg, 12);
    const uint64_t needed = first ? ALL_OF_ONE_VOLUME : EYE_AND_COMPOSITE;
    EXPECT_EQ(render().view.dispatches, SKY_TABLE + needed) << yaw_deg;
    first = false;
    EXPECT_LT(scene.passes()[2].invocations, pixels) << yaw_deg;
    expectSameWithoutSkipping();
  }
}

TEST_F(Skip, WithTheSunFarBelowTheHorizonLightIsNotMarched) {
  scene.setSky();
  scene.addBall(0.01f);
  for (const double elevation_deg : {-40.0, -90.0}) {
    scene.setSun(elevation_deg, 20);
    EXPECT_EQ(render().view.dispatches, EYE_AND_COMPOSITE);
    expectReasons(WLK_REASON_NO_LIGHT, WLK_REASON_NEEDED, WLK_REASON_NEEDED);
    expectSameWithoutSkipping();
  }
}

TEST_F(Skip, ThroughTwilightNothingIsLostBeforeItIsBlack) {
  scene.setSky();
  scene.setFog(1e-5f, 2000.0f);
  scene.addBall(0.01f);
  for (const double elevation_deg :
       {1.0, -1.0, -3.0, -7.0, -9.0, -12.0, -16.0, -20.0, -25.0, -35.0}) {
    SCOPED_TRACE(elevation_deg);
    scene.setSun(elevation_deg, 20);
    render();
    expectSameWithoutSkipping();
  }
}

TEST_F(Skip, AVolumeInTheNightBehindAirInTheSunKeepsThatAir) {
  // From 300 km up, down to a cloud for which the sun has set; the air halfway still has it.
  scene.setSky();
  const WlkVolume volume = scene.addBall(0.001f);
  const auto below = boxTransform({-40e3, 500, -40e3}, {80e3, 4e3, 80e3});
  ASSERT_EQ(wlkSetVolumeTransform(scene.context, volume, below.data()), WLK_SUCCESS);
  scene.setCamera({0, 300e3, 0}, 0, -90);
  for (const double elevation_deg : {-4.0, -7.0}) {
    scene.setSun(elevation_deg, 20);
    render();
    EXPECT_GT(scene.read().mean(), 0.0);
    expectSameWithoutSkipping();
  }
  // And obliquely: the cloud lies 16 degrees of the globe away from the sun, deep in the night.
  const auto aside = boxTransform({-150e3, -262e3, -1786e3}, {300e3, 40e3, 60e3});
  ASSERT_EQ(wlkSetVolumeTransform(scene.context, volume, aside.data()), WLK_SUCCESS);
  scene.setCamera({0, 300e3, 0}, 0, -15.4);  // half a row of pixels above it
  scene.setSun(-2.5, 180);
  render();
  EXPECT_GT(scene.read().mean(), 0.0);
  expectSameWithoutSkipping();
}

TEST_F(Skip, WithoutALightOrWithABlackOneLightIsNotMarched) {
  scene.setSky();
  scene.addBall(0.01f);
  scene.clearLights();
  EXPECT_EQ(render().view.dispatches, EYE_AND_COMPOSITE);
  expectReasons(WLK_REASON_NO_LIGHT, WLK_REASON_NEEDED, WLK_REASON_NEEDED);
  expectSameWithoutSkipping();
  auto black = make<WlkLight>();
  black.irradiance[0] = black.irradiance[1] = black.irradiance[2] = 0.0f;
  ASSERT_EQ(wlkSetLights(scene.context, 1, sizeof black, &black), WLK_SUCCESS);
  EXPECT_EQ(render().view.dispatches, EYE_AND_COMPOSITE);
  expectReasons(WLK_REASON_NO_LIGHT, WLK_REASON_NEEDED, WLK_REASON_NEEDED);
}

TEST_F(Skip, AVolumeLayerThatIsOffIsNotMarchedEvenWithoutSkipping) {
  scene.setSky();
  scene.setSun(30, 20);
  scene.addBall(0.01f);
  auto info = make<WlkViewInfo>();
  info.width = 24;
  info.height = 16;
  info.targetFormat = WLK_TARGET_RGBA32_FLOAT;
  info.layers = WLK_LAYER_ALL & ~uint32_t{WLK_LAYER_VOLUMES};
  ASSERT_EQ(wlkUpdateView(scene.context, scene.view, &info), WLK_SUCCESS);
  EXPECT_EQ(render().view.dispatches, SKY_TABLE + COMPOSITE_ONLY);
  expectReasons(WLK_REASON_LAYER_OFF, WLK_REASON_LAYER_OFF, WLK_REASON_NEEDED);
  expectSameWithoutSkipping();
  expectReasons(WLK_REASON_LAYER_OFF, WLK_REASON_LAYER_OFF, WLK_REASON_NEEDED);
}

TEST_F(Skip, FogOfZeroExtinctionIsNoFogAndNeedsNoOtherPrepare) {
  scene.setSky();
  scene.setSun(30, 20);
  EXPECT_EQ(render().view.dispatches, SKY_TABLE + COMPOSITE_ONLY);
  const Image clear = scene.read();
  scene.setFog(0.0f, 100.0f);
  EXPECT_EQ(render().view.dispatches, SKY_TABLE + COMPOSITE_ONLY);
  EXPECT_TRUE(scene.read() == clear);
  expectSameWithoutSkipping();
}

TEST_F(Skip, OfTwoVolumesOnlyTheOneInViewIsMarched) {
  scene.setSky();
  scene.setSun(30, 20);
  const WlkVolume front = scene.addBall(0.01f);
  const WlkVolume back = scene.addBall(0.01f);
  const auto behind = boxTransform({-1000, 500, 4000}, {2000, 2000, 2000});
  ASSERT_EQ(wlkSetVolumeTransform(scene.context, back, behind.data()), WLK_SUCCESS);
  EXPECT_EQ(render().view.dispatches, SKY_TABLE + ALL_OF_ONE_VOLUME);
  for (const WlkPassStats& pass : scene.passes()) {
    const uint32_t expected =
        pass.volume.id == back.id ? uint32_t{WLK_REASON_OUTSIDE_VIEW} : uint32_t{WLK_REASON_NEEDED};
    EXPECT_EQ(pass.reason, expected) << pass.name;
    EXPECT_TRUE(pass.pass == WLK_PASS_COMPOSITE || pass.pass == WLK_PASS_SKY_TABLE
                    ? pass.volume.id == 0
                    : pass.volume.id == back.id || pass.volume.id == front.id);
  }
  expectSameWithoutSkipping();
}

}  // namespace
}  // namespace welkin::test
