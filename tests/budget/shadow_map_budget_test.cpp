// SPDX-License-Identifier: MIT
// A map of the volumes' shadow is recorded where it may have changed, and nowhere else: exact
// counts of commands, and the same texels.
#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "support/shadow_map_scene.hpp"

namespace welkin::test {
namespace {

constexpr uint32_t SIZE = 24;
constexpr uint32_t N = 8;      // voxels along an edge of the ball
constexpr int WARM_UP = 4;     // maxFramesInFlight + 1: every slot was recorded once
constexpr uint32_t FRAME = 1;  // the pass that writes the image
// Into the image's state and out of it, the sums cleared, and after each volume.
constexpr uint64_t BARRIERS = 4;

WlkCloudShadowInfo info() {
  auto value = make<WlkCloudShadowInfo>();
  value.width = SIZE;
  value.height = SIZE;
  value.extent[0] = value.extent[1] = 3000;
  value.center[1] = 1500;
  value.center[2] = -5000;
  return value;
}

class ShadowMapBudget : public ::testing::Test {
 protected:
  ShadowMapBudget() : s(info()) { s.scene.setSun(50, 20); }
  ~ShadowMapBudget() override {
    EXPECT_TRUE(s.scene.device().messages().empty()) << s.scene.device().messages().front();
  }

  void prepare() const { check(wlkPrepare(s.scene.context)); }
  void expectCounted(const ShadowFrame& frame) {
    EXPECT_EQ(frame.state.barriers, frame.counts.barriers);
    EXPECT_EQ(frame.state.descriptorWrites, frame.counts.descriptorWrites);
    EXPECT_EQ(frame.state.commands, frame.counts.dispatches);
    // The view of an image that is new.
    EXPECT_EQ(frame.counts.created, images == s.images ? 0u : 1u);
    images = s.images;
    EXPECT_EQ(frame.counts.destroyed + frame.counts.allocated, 0u);
  }
  ShadowFrame expectRecorded(uint32_t reason, uint32_t volumes, const char* after) {
    const ShadowFrame frame = s.record();
    expectCounted(frame);
    EXPECT_STREQ(wlkReasonName(frame.state.reason), wlkReasonName(reason)) << after;
    EXPECT_EQ(frame.state.volumes, volumes) << after;
    EXPECT_EQ(frame.counts.dispatches, FRAME + volumes) << after;
    EXPECT_EQ(frame.counts.barriers, BARRIERS + volumes) << after;
    EXPECT_EQ(frame.counts.copies, 1u) << after;
    EXPECT_EQ(frame.state.recorded, 1u) << after;
    return frame;
  }
  ShadowFrame expectKept(const char* after) {
    const std::vector<float> texels = s.read();
    const ShadowFrame frame = s.record();
    expectCounted(frame);
    EXPECT_STREQ(wlkReasonName(frame.state.reason), "WLK_REASON_UNCHANGED") << after;
    EXPECT_EQ(frame.counts.dispatches, 0u) << after;
    EXPECT_EQ(frame.counts.barriers, 0u) << after;
    EXPECT_EQ(frame.counts.copies, 0u) << after;
    EXPECT_EQ(frame.counts.descriptorWrites, 0u) << after;
    EXPECT_EQ(frame.state.recorded, 0u) << after;
    EXPECT_EQ(frame.state.invocations, 0u) << after;
    EXPECT_EQ(s.read(), texels) << after;
    return frame;
  }
  void fill(WlkVolume volume, float density) const {
    s.scene.upload(volume, {N, N, N}, std::vector<float>(size_t{N} * N * N, density));
  }
  void expectNoShadow(const char* after) const {
    EXPECT_EQ(s.read(), std::vector<float>(size_t{4} * SIZE * SIZE, 0.0f)) << after;
  }
  void expectShadow(const char* after) const {
    EXPECT_NE(s.read(), std::vector<float>(size_t{4} * SIZE * SIZE, 0.0f)) << after;
  }

  ShadowMapScene s;
  uint32_t images = 0;  // that the library has seen
};

TEST_F(ShadowMapBudget, KeepsWhatHasNotChanged) {
  s.scene.addBall(0.01f);
  prepare();
  expectRecorded(WLK_REASON_NEEDED, 1, "the first frame");
  expectShadow("the first frame");
  const ShadowFrame kept = expectKept("nothing");
  EXPECT_GT(kept.state.gpuTime_ns, 0u);
  auto moved = info();
  moved.center[0] = 2;  // of texels of 125 m
  check(wlkSetCloudShadow(s.scene.context, s.map, &moved));
  expectKept("the middle moved within its texel");
}

TEST_F(ShadowMapBudget, RecordsWhatLightVolumesAreaOrImageHaveChanged) {
  const WlkVolume volume = s.scene.addBall(0.01f);
  prepare();
  expectRecorded(WLK_REASON_NEEDED, 1, "the first frame");
  s.scene.setSun(50.01, 20);
  expectRecorded(WLK_REASON_NEEDED, 1, "the sun rose");
  expectKept("nothing");
  fill(volume, 0.5f);
  expectRecorded(WLK_REASON_NEEDED, 1, "an upload");
  expectKept("nothing");
  const auto moved = boxTransform({-900, 510, -6100}, {2000, 2000, 2100});
  check(wlkSetVolumeTransform(s.scene.context, volume, moved.data()));
  expectRecorded(WLK_REASON_NEEDED, 1, "the box moved");
  expectKept("nothing");
  auto value = info();
  value.center[0] = 300;
  check(wlkSetCloudShadow(s.scene.context, s.map, &value));
  expectRecorded(WLK_REASON_NEEDED, 1, "the middle moved");
  value.maxSamples = 8;
  check(wlkSetCloudShadow(s.scene.context, s.map, &value));
  expectRecorded(WLK_REASON_NEEDED, 1, "fewer samples");
  expectKept("nothing");
  const std::vector<float> before = s.read();
  s.replaceImage();
  expectRecorded(WLK_REASON_NEEDED, 1, "another image");
  EXPECT_EQ(s.read(), before);
  s.described.before.layout = VK_IMAGE_LAYOUT_UNDEFINED;
  expectRecorded(WLK_REASON_NEEDED, 1, "its contents are gone");
  EXPECT_EQ(s.read(), before);
  // A map of its own, which was never skipped, has the same texels.
  check(wlkDestroyCloudShadow(s.scene.context, s.map));
  check(wlkCreateCloudShadow(s.scene.context, &value, &s.map));
  prepare();
  expectRecorded(WLK_REASON_NEEDED, 1, "another map");
  EXPECT_EQ(s.read(), before);
}

TEST_F(ShadowMapBudget, WithoutShadowSaysSoOnce) {
  prepare();
  expectRecorded(WLK_REASON_NOTHING_TO_DRAW, 0, "no volume");
  expectKept("no volume");
  expectNoShadow("no volume");
  const WlkVolume volume = s.scene.addBall(0.01f);
  prepare();
  expectRecorded(WLK_REASON_NEEDED, 1, "a volume");
  expectShadow("a volume");
  fill(volume, 0.0f);
  expectRecorded(WLK_REASON_ZERO_DENSITY, 0, "an empty one");
  expectNoShadow("an empty one");
  expectKept("an empty one");
  fill(volume, 1.0f);
  expectRecorded(WLK_REASON_NEEDED, 1, "full again");
  s.scene.clearLights();
  expectRecorded(WLK_REASON_NO_LIGHT, 0, "night");
  expectNoShadow("night");
  expectKept("night");
  s.scene.setSun(50, 20);
  expectRecorded(WLK_REASON_NEEDED, 1, "day");
  const auto away = boxTransform({-90000, 500, -6000}, {2000, 2000, 2000});
  check(wlkSetVolumeTransform(s.scene.context, volume, away.data()));
  expectRecorded(WLK_REASON_OUTSIDE_VIEW, 0, "out of the map");
  expectNoShadow("out of the map");
  check(wlkDestroyVolume(s.scene.context, volume));
  expectKept("destroyed");
}

// Inputs that toggle every frame: each frame is what an unskipped one would be.
TEST_F(ShadowMapBudget, FollowsInputsThatToggleEveryFrame) {
  const WlkVolume volume = s.scene.addBall(0.01f);
  prepare();
  std::array<std::vector<float>, 2> texels;
  for (int i = 0; i < 12; ++i) {
    const auto turn = static_cast<size_t>(i % 2);
    fill(volume, turn == 0 ? 1.0f : 0.25f);
    expectRecorded(WLK_REASON_NEEDED, 1, "an upload");
    const std::vector<float> now = s.read();
    EXPECT_TRUE(i < 2 || now == texels[turn]) << i;
    texels[turn] = now;
  }
  EXPECT_NE(texels[0], texels[1]);
}

TEST_F(ShadowMapBudget, ASteadyFrameThatRecordsWritesNoDescriptor) {
  s.scene.addBall(0.01f);
  s.scene.addBall(0.02f);
  prepare();
  for (int i = 0; i < WARM_UP + 4; ++i) {
    s.scene.setSun(50 + i, 20);
    const ShadowFrame frame = expectRecorded(WLK_REASON_NEEDED, 2, "the sun rose");
    if (i >= WARM_UP) {
      EXPECT_EQ(frame.counts.descriptorWrites, 0u) << i;
    }
  }
}

// A tenth of the map's edge along each axis: the work follows what the volume covers.
TEST_F(ShadowMapBudget, WorkFollowsTheTexelsThatAVolumeCovers) {
  const WlkVolume volume = s.scene.addBall(0.01f);
  const auto small = boxTransform({-100, 1400, -5100}, {200, 200, 200});
  check(wlkSetVolumeTransform(s.scene.context, volume, small.data()));
  prepare();
  const ShadowFrame frame = expectRecorded(WLK_REASON_NEEDED, 1, "a small volume");
  const uint64_t image = uint64_t{SIZE} * SIZE;
  EXPECT_EQ(frame.state.invocations, image + 64u);
}

TEST_F(ShadowMapBudget, OtherLayoutsCostOneBarrier) {
  s.scene.addBall(0.01f);
  prepare();
  s.described.after.layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
  expectRecorded(WLK_REASON_NEEDED, 1, "the first frame");
  s.described.before.layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
  s.described.after.layout = VK_IMAGE_LAYOUT_GENERAL;
  const ShadowFrame frame = s.record();
  expectCounted(frame);
  EXPECT_STREQ(wlkReasonName(frame.state.reason), "WLK_REASON_UNCHANGED");
  EXPECT_EQ(frame.counts.barriers, 1u);
  EXPECT_EQ(frame.counts.dispatches, 0u);
  expectShadow("a change of layout");
}

// The engine may write its volume at any time, and Welkin does not see it.
TEST_F(ShadowMapBudget, AVolumeInTheEnginesImageIsRecordedEachFrame) {
  const WlkVolume volume = s.scene.addBall(0.01f);
  fill(volume, 0.5f);
  prepare();
  expectRecorded(WLK_REASON_NEEDED, 1, "the first frame");
  const std::vector<float> uploaded = s.read();
  const SpyImage image(s.scene.device(), VK_FORMAT_R32_SFLOAT, {N, N, N},
                       VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT);
  const auto write = [&](float density) {
    const std::vector<float> values(size_t{N} * N * N, density);
    std::memcpy(image.bytes(), values.data(), values.size() * sizeof(float));
    image.write(VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  };
  write(0.2f);
  const WlkVulkanImage described =
      s.scene.describe(image, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  check(wlkVulkanSetVolumeImage(s.scene.context, volume, 0, &described));
  expectRecorded(WLK_REASON_NEEDED, 1, "the image");
  const std::vector<float> thin = s.read();
  write(1.0f);
  expectRecorded(WLK_REASON_NEEDED, 1, "the image was written");
  EXPECT_NE(s.read(), thin);
  check(wlkVulkanSetVolumeImage(s.scene.context, volume, 0, nullptr));
  expectRecorded(WLK_REASON_NEEDED, 1, "the uploaded field is back");
  EXPECT_EQ(s.read(), uploaded);
  expectKept("nothing");
  check(wlkVulkanForgetImage(s.scene.context, image.handle));
}

}  // namespace
}  // namespace welkin::test
