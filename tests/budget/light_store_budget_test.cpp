// SPDX-License-Identifier: MIT
// The light of a volume is recorded where it may have changed and nowhere else, once for all views,
// and a picture from kept light is that of light just computed.
#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "support/engine_scene.hpp"

namespace welkin::test {
namespace {

constexpr int WARM_UP = 4;  // maxFramesInFlight + 1: every slot was recorded once
constexpr uint32_t N = 8;   // voxels along an edge of the ball

SceneOptions small() {
  SceneOptions options;
  options.width = 24;
  options.height = 16;
  return options;
}

std::vector<WlkPassStats> lightOf(const SceneBuilder& scene) {
  std::vector<WlkPassStats> found;
  for (const WlkPassStats& pass : scene.passes()) {
    if (pass.pass == WLK_PASS_LIGHT_SLICES) {
      found.push_back(pass);
    }
  }
  return found;
}

class LightStoreBudget : public ::testing::Test {
 protected:
  LightStoreBudget() : scene(small()) {
    scene.setCamera({0, 2, 0}, 0, 12);
    scene.setSun(30, 20);
  }
  ~LightStoreBudget() override {
    EXPECT_TRUE(scene.device().messages().empty()) << scene.device().messages().front();
  }

  void expect(uint32_t reason, uint32_t commands, const char* after) {
    scene.renderFrame();
    const std::vector<WlkPassStats> light = lightOf(scene);
    ASSERT_EQ(light.size(), 1u) << after;
    EXPECT_STREQ(wlkReasonName(light[0].reason), wlkReasonName(reason)) << after;
    EXPECT_EQ(light[0].commands, commands) << after;
    EXPECT_EQ(light[0].recorded, commands > 0 ? 1u : 0u) << after;
    EXPECT_EQ(scene.stats().nonFinitePixels, 0u) << after;
  }
  void expectKept(const char* after) { expect(WLK_REASON_UNCHANGED, 0, after); }
  void expectComputed(const char* after) { expect(WLK_REASON_NEEDED, 1, after); }
  void prepare() const { check(wlkPrepare(scene.context)); }
  void ask(const WlkQuality& quality) const {
    check(wlkSetQuality(scene.context, scene.view, &quality));
    prepare();
  }

  EngineScene scene;
};

TEST_F(LightStoreBudget, KeepsWhatHasNotChangedAndWritesNoDescriptor) {
  scene.addBall(0.01f);
  prepare();
  expectComputed("the first frame");
  for (int i = 0; i < WARM_UP + 4; ++i) {
    scene.setCamera({20.0 * i, 2, -10.0 * i}, 1.0 * i, 12);
    expectKept("the camera moved");
    EXPECT_TRUE(i < WARM_UP || scene.stats().descriptorWrites == 0) << i;
  }
}

TEST_F(LightStoreBudget, ComputesAnewWhatSunFieldsOrQualityHaveChanged) {
  const WlkVolume volume = scene.addBall(0.01f);
  prepare();
  expectComputed("the first frame");
  scene.setSun(30.01, 20);
  expectComputed("the sun rose");
  expectKept("nothing");
  scene.upload(volume, {N, N, N}, std::vector<float>(size_t{N} * N * N, 0.5f));
  expectComputed("an upload");
  expectKept("nothing");
  const auto longer = boxTransform({-1000, 500, -6000}, {2000, 2000, 2100});
  ASSERT_EQ(wlkSetVolumeTransform(scene.context, volume, longer.data()), WLK_SUCCESS);
  expectComputed("the box grew");
  const auto moved = boxTransform({-900, 510, -6100}, {2000, 2000, 2100});
  ASSERT_EQ(wlkSetVolumeTransform(scene.context, volume, moved.data()), WLK_SUCCESS);
  expectKept("the box moved as it is");
  auto quality = make<WlkQuality>();
  quality.level = WLK_QUALITY_LOW;
  quality.sliceCount = 40;
  ask(quality);
  expectComputed("more slabs");
  expectKept("nothing");
  quality.flags = WLK_QUALITY_FLAG_VOLUME_SHADOWS;
  ask(quality);
  expectKept("what the volumes' light does not depend on");
}

// What goes and comes back may not find what was kept for something else.
TEST_F(LightStoreBudget, InputsThatToggleGiveThePictureOfLightComputedEachFrame) {
  const WlkVolume volume = scene.addBall(0.01f);
  prepare();
  const std::vector<float> thin(size_t{N} * N * N, 0.3f);
  const std::vector<float> thick(size_t{N} * N * N, 1.0f);
  EngineScene other(small());
  other.setCamera({0, 2, 0}, 0, 12);
  const WlkVolume twin = other.addBall(0.01f);
  other.setQuality(WLK_QUALITY_LOW, WLK_QUALITY_FLAG_NO_SKIP);
  check(wlkPrepare(other.context));
  for (int i = 0; i < 16; ++i) {
    for (EngineScene* each : {&scene, &other}) {
      each->setSun(i % 2 == 0 ? 30 : 50, 20);
      if (i % 3 == 0) {
        each->upload(each == &scene ? volume : twin, {N, N, N}, i % 2 == 0 ? thin : thick);
      }
      if (i % 5 == 4) {
        each->clearLights();
      }
      each->renderFrame();
    }
    EXPECT_TRUE(scene.read() == other.read()) << i;
  }
  EXPECT_TRUE(other.device().messages().empty()) << other.device().messages().front();
}

TEST_F(LightStoreBudget, WithoutSkippingIsComputedEachFrame) {
  scene.addBall(0.01f);
  prepare();
  expectComputed("the first frame");
  const Image computed = scene.read();
  expectKept("nothing");
  EXPECT_TRUE(scene.read() == computed);
  scene.setQuality(WLK_QUALITY_LOW, WLK_QUALITY_FLAG_NO_SKIP);
  prepare();
  for (int i = 0; i < 2; ++i) {
    expect(WLK_REASON_NO_SKIP_FLAG, 1, "no skipping");
    EXPECT_TRUE(scene.read() == computed);
  }
}

// The engine may write its image at any time, and Welkin does not see it.
TEST_F(LightStoreBudget, AnImageOfTheEnginesIsComputedEachFrame) {
  const WlkVolume volume = scene.addBall(0.01f);
  scene.upload(volume, {N, N, N}, std::vector<float>(size_t{N} * N * N, 0.5f));
  prepare();
  expectComputed("the first frame");
  const Image uploaded = scene.read();
  const SpyImage image(scene.device(), VK_FORMAT_R32_SFLOAT, {N, N, N},
                       VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT);
  const auto fill = [&](float density) {
    const std::vector<float> values(size_t{N} * N * N, density);
    std::memcpy(image.bytes(), values.data(), values.size() * sizeof(float));
    image.write(VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  };
  const WlkVulkanImage described = scene.describe(image, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  ASSERT_EQ(wlkVulkanSetVolumeImage(scene.context, volume, 0, &described), WLK_SUCCESS);
  fill(0.2f);
  expectComputed("the image");
  const Image thin = scene.read();
  fill(1.0f);
  expectComputed("the image was written");
  EXPECT_FALSE(scene.read() == thin);
  ASSERT_EQ(wlkVulkanSetVolumeImage(scene.context, volume, 0, nullptr), WLK_SUCCESS);
  expectComputed("the uploaded field is back");
  EXPECT_TRUE(scene.read() == uploaded);
  check(wlkVulkanForgetImage(scene.context, image.handle));
}

TEST_F(LightStoreBudget, OfTwoVolumesOnlyTheOneThatChangedIsComputed) {
  const WlkVolume left = scene.addBall(0.01f);
  const WlkVolume right = scene.addBall(0.01f);
  const auto beside = boxTransform({1100, 500, -6000}, {1000, 1000, 1000});
  ASSERT_EQ(wlkSetVolumeTransform(scene.context, right, beside.data()), WLK_SUCCESS);
  prepare();
  scene.renderFrame();
  scene.upload(left, {N, N, N}, std::vector<float>(size_t{N} * N * N, 0.5f));
  scene.renderFrame();
  ASSERT_EQ(lightOf(scene).size(), 2u);
  for (const WlkPassStats& pass : lightOf(scene)) {
    EXPECT_STREQ(wlkReasonName(pass.reason),
                 pass.volume.id == left.id ? "WLK_REASON_NEEDED" : "WLK_REASON_UNCHANGED");
  }
  // Nor does a volume that goes take the other's light along, and one that comes back is new.
  ASSERT_EQ(wlkDestroyVolume(scene.context, left), WLK_SUCCESS);
  expectKept("the other volume went");
}

TEST_F(LightStoreBudget, BatchesAndSlabsThatTurnWithTheViewKeepNothing) {
  scene.addBall(0.01f);
  auto quality = make<WlkQuality>();
  quality.level = WLK_QUALITY_LOW;
  quality.batchSize = 16;
  ask(quality);
  expect(WLK_REASON_NEEDED, 2, "batches");
  expect(WLK_REASON_NEEDED, 2, "batches again");
  quality.batchSize = 0;
  quality.slicing = WLK_SLICING_HALF_ANGLE;
  ask(quality);
  expect(WLK_REASON_NEEDED, 1, "half-angle");
  expect(WLK_REASON_NEEDED, 1, "half-angle again");
  quality.slicing = WLK_SLICING_LIGHT_ALIGNED;
  ask(quality);
  expectComputed("light-aligned");
  expectKept("nothing");
}

TEST_F(LightStoreBudget, WhatWouldNeedTooMuchMemoryIsDrawnInBatches) {
  scene.addBall(0.01f);
  auto quality = make<WlkQuality>();
  quality.level = WLK_QUALITY_LOW;  // batches of 32
  quality.sliceCount = 1056;
  quality.lightBufferSize = 256;  // 69e6 texels, of at most 67e6
  ask(quality);
  expect(WLK_REASON_NEEDED, 33, "batches");
  scene.renderFrame();
  EXPECT_LT(scene.stats().deviceMemory, uint64_t{128} << 20) << "a store would take 528 MiB";
}

// Each of them alone would fit.
TEST_F(LightStoreBudget, VolumesThatFindNoRoomLeftAreDrawnInBatches) {
  auto quality = make<WlkQuality>();
  quality.level = WLK_QUALITY_LOW;
  quality.scattering = WLK_SCATTERING_FORWARD;
  quality.sliceCount = 1000;
  quality.lightBufferSize = 192;  // 295 MiB with two channels: one of 512
  for (int i = 0; i < 2; ++i) {
    scene.addBall(0.01f);
  }
  ask(quality);
  scene.renderFrame();
  scene.renderFrame();
  const std::vector<WlkPassStats> light = lightOf(scene);
  ASSERT_EQ(light.size(), 2u);
  const uint32_t kept = light[0].reason == WLK_REASON_UNCHANGED ? 0 : 1;
  EXPECT_EQ(light[kept].commands, 0u);
  EXPECT_EQ(light[1 - kept].commands, 32u);
}

// Two views, one scene; what either shows is what it shows alone.
TEST(LightStore, IsSharedByViewsThatAskForTheSame) {
  HeadlessScene scene(small());
  scene.setSun(30, 20);
  scene.setCamera({0, 2, 0}, 0, 12);
  scene.addBall(0.01f);
  const WlkView first = scene.view;
  const WlkView second = scene.addView(small());
  scene.view = second;
  scene.setCamera({600, 2, 0}, -5, 12);
  const Image alone = scene.render();
  ASSERT_EQ(lightOf(scene).size(), 1u);
  EXPECT_EQ(lightOf(scene)[0].commands, 1u);
  for (int i = 0; i < 2; ++i) {
    scene.view = first;
    scene.render();
    EXPECT_STREQ(wlkReasonName(lightOf(scene)[0].reason), "WLK_REASON_UNCHANGED");
    EXPECT_EQ(lightOf(scene)[0].commands, 0u);
    scene.view = second;
    EXPECT_TRUE(scene.render() == alone);
    EXPECT_EQ(lightOf(scene)[0].commands, 0u);
  }
  // Another number of slabs is other light, kept beside.
  scene.view = first;
  scene.setQuality(WLK_QUALITY_MEDIUM);
  scene.render();
  EXPECT_EQ(lightOf(scene)[0].commands, 1u);
  scene.view = second;
  EXPECT_TRUE(scene.render() == alone);
  EXPECT_EQ(lightOf(scene)[0].commands, 0u);
  EXPECT_TRUE(scene.messages().empty()) << scene.messages().front();
}

// A view that had found no room keeps its light once another one's has gone, in every second pixel
// as it would have from the start.
TEST(LightStore, IsTakenUpByAViewThatHadFoundNoRoom) {
  SceneOptions options = small();
  options.level = WLK_QUALITY_HIGH;
  options.volumeResolution = WLK_VOLUME_RESOLUTION_DEFAULT;
  HeadlessScene scene(options);
  scene.setSun(30, 20);
  scene.setCamera({0, 2, 0}, 0, 12);
  scene.addBall(0.01f);
  const WlkView first = scene.view;
  auto large = make<WlkQuality>();
  large.scattering = WLK_SCATTERING_FORWARD;
  large.sliceCount = 250;
  large.lightBufferSize = 512;  // 502 MiB of 512
  check(wlkSetQuality(scene.context, first, &large));
  check(wlkPrepare(scene.context));
  scene.view = scene.addView(options);
  scene.setCamera({0, 2, 0}, 0, 12);
  scene.render();
  EXPECT_GT(lightOf(scene)[0].commands, 1u) << "in batches";
  const auto usual = make<WlkQuality>();
  check(wlkSetQuality(scene.context, first, &usual));
  const Image kept = scene.render();
  EXPECT_EQ(lightOf(scene)[0].commands, 1u);
  HeadlessScene fresh(options);
  fresh.setSun(30, 20);
  fresh.setCamera({0, 2, 0}, 0, 12);
  fresh.addBall(0.01f);
  EXPECT_TRUE(kept == fresh.render());
  EXPECT_TRUE(scene.messages().empty()) << scene.messages().front();
}

}  // namespace
}  // namespace welkin::test
