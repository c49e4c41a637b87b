// SPDX-License-Identifier: MIT
// What aerial perspective adds to a frame: nothing unless it is asked for, one dispatch for the
// froxels, and with volumes one per batch over the slices that they reach.
#include <gtest/gtest.h>

#include <cstring>

#include "support/aerial_scene.hpp"

namespace welkin::test {
namespace {

constexpr uint32_t W = 16;
constexpr uint32_t H = 8;
constexpr uint32_t DEPTH = 12;
constexpr int WARM_UP = 4;  // maxFramesInFlight + 1: every slot was recorded once
constexpr uint64_t BATCHES = 4;

WlkAerialPerspective info() {
  auto value = make<WlkAerialPerspective>();
  value.width = W;
  value.height = H;
  value.depth = DEPTH;
  value.exponent = 1;
  value.distance = 11000;  // slices 1 km apart
  return value;
}

class AerialBudget : public ::testing::Test {
 protected:
  AerialBudget() : s(info()) {
    auto quality = make<WlkQuality>();
    quality.level = WLK_QUALITY_LOW;
    quality.batchSize = 32 / BATCHES;
    check(wlkSetQuality(s.scene.context, s.scene.view, &quality));
    s.scene.setSky();
    s.scene.setSun(50, 20);
  }
  ~AerialBudget() override {
    EXPECT_TRUE(s.scene.device().messages().empty()) << s.scene.device().messages().front();
  }

  FrameCounts steady() {
    for (int i = 0; i < WARM_UP; ++i) {
      s.render();
    }
    return s.render();
  }
  WlkPassStats line() const {
    for (const WlkPassStats& pass : s.scene.passes()) {
      if (pass.pass == WLK_PASS_AERIAL_PERSPECTIVE) {
        EXPECT_STREQ(pass.name, "aerial perspective");
        return pass;
      }
    }
    ADD_FAILURE() << "no line";
    return {};
  }
  void expectCounted(const FrameCounts& counts) const {
    const WlkFrameStats stats = s.scene.stats();
    EXPECT_EQ(counts.view.dispatches, stats.dispatches);
    EXPECT_EQ(counts.view.barriers, stats.barriers);
    EXPECT_EQ(counts.view.descriptorWrites, stats.descriptorWrites);
    EXPECT_EQ(stats.nonFinitePixels, 0u);
    uint64_t commands = 0;
    for (const WlkPassStats& pass : s.scene.passes()) {
      commands += pass.commands;
    }
    EXPECT_EQ(commands, counts.view.dispatches);
  }

  AerialScene s;
};

TEST_F(AerialBudget, CostsNothingUnlessItIsAskedFor) {
  s.scene.addBall(0.002f);
  check(wlkPrepare(s.scene.context));
  s.asked = false;
  const FrameCounts without = steady();
  expectCounted(without);
  EXPECT_EQ(line().recorded, 0u);
  EXPECT_STREQ(wlkReasonName(line().reason), "WLK_REASON_LAYER_OFF");
  // The same as of a view that never had any.
  check(wlkSetAerialPerspective(s.scene.context, s.scene.view, nullptr));
  const FrameCounts never = steady();
  EXPECT_EQ(std::memcmp(&never.view, &without.view, sizeof never.view), 0);
  for (const WlkPassStats& pass : s.scene.passes()) {
    EXPECT_NE(pass.pass, uint32_t{WLK_PASS_AERIAL_PERSPECTIVE});
  }
}

TEST_F(AerialBudget, InAirAloneItIsOneDispatch) {
  check(wlkPrepare(s.scene.context));
  s.asked = false;
  const FrameCounts without = steady();
  s.asked = true;
  const FrameCounts with = steady();
  expectCounted(with);
  EXPECT_EQ(with.view.dispatches, without.view.dispatches + 1);
  // Both images there and back, and the order before the dispatch.
  EXPECT_EQ(with.view.barriers, without.view.barriers + 5);
  EXPECT_EQ(with.view.descriptorWrites, 0u);
  EXPECT_EQ(with.view.created + with.view.allocated + with.view.destroyed, 0u);
  EXPECT_EQ(line().commands, 1u);
  EXPECT_EQ(line().invocations, uint64_t{64} * (W / 8) * (H / 8) * DEPTH);
  EXPECT_GT(line().gpuTime_ns, 0u);
}

TEST_F(AerialBudget, VolumesAreMarchedInTheSlicesThatTheyReach) {
  s.scene.addBall(0.002f);  // from 4.0 km to 6.4 km, of its box's farthest corner
  check(wlkPrepare(s.scene.context));
  s.asked = false;
  const FrameCounts without = steady();
  s.asked = true;
  const FrameCounts with = steady();
  expectCounted(with);
  EXPECT_EQ(with.view.dispatches, without.view.dispatches + 1 + BATCHES);
  EXPECT_EQ(with.view.descriptorWrites, 0u);
  EXPECT_EQ(line().commands, 1 + BATCHES);
  // Slices 4.03 < 5, 6, 7 km: the last is that behind the farthest corner. The box covers one group
  // of 8 x 8 froxels or two.
  const uint64_t froxels = uint64_t{64} * (W / 8) * (H / 8) * DEPTH;
  const uint64_t marched = line().invocations - froxels;
  EXPECT_EQ(marched % (BATCHES * 3 * 64), 0u);
  EXPECT_LE(marched, BATCHES * 3 * 64 * 2);
  // Out of reach: nothing is marched for froxels.
  auto nearby = info();
  nearby.distance = 4000;
  check(wlkSetAerialPerspective(s.scene.context, s.scene.view, &nearby));
  const FrameCounts before = steady();
  EXPECT_EQ(before.view.dispatches, without.view.dispatches + 1);
  EXPECT_EQ(line().invocations, froxels);
}

TEST_F(AerialBudget, WithoutAnythingToSeeTheImagesSaySo) {
  s.scene.clearSky();
  check(wlkPrepare(s.scene.context));
  const FrameCounts counts = steady();
  expectCounted(counts);
  for (uint32_t slice = 0; slice < DEPTH; ++slice) {
    EXPECT_EQ(s.froxel(3, 2, slice).radiance, (std::array<double, 3>{0, 0, 0}));
    EXPECT_EQ(s.froxel(3, 2, slice).transmittance, (std::array<double, 3>{1, 1, 1}));
  }
}

TEST_F(AerialBudget, ImagesComeFromAndGoToTheStatesGiven) {
  check(wlkPrepare(s.scene.context));
  s.render();
  const std::vector<float> expected = s.texels(0);
  for (WlkVulkanImage& image : s.described) {
    image.before.layout = VK_IMAGE_LAYOUT_UNDEFINED;
    image.before.stages = VK_PIPELINE_STAGE_2_NONE;
    image.before.access = VK_ACCESS_2_NONE;
    image.after.layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
    image.after.stages = VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT;
    image.after.access = VK_ACCESS_2_SHADER_SAMPLED_READ_BIT;
  }
  s.render();  // reads them in that layout: validation has nothing to say
  EXPECT_EQ(s.texels(0), expected);
}

}  // namespace
}  // namespace welkin::test
