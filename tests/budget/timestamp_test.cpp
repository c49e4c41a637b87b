// SPDX-License-Identifier: MIT
// Times of the GPU on queues whose timestamps have few bits, or none.
#include <gtest/gtest.h>

#include "support/shadow_map_scene.hpp"

namespace welkin::test {
namespace {

constexpr int WARM_UP = 4;  // maxFramesInFlight + 1: every slot was recorded once

WlkCloudShadowInfo info() {
  auto value = make<WlkCloudShadowInfo>();
  value.width = value.height = 16;
  value.extent[0] = value.extent[1] = 3000;
  value.center[1] = 1500;
  value.center[2] = -5000;
  return value;
}

void fill(const EngineScene& scene) {
  scene.setSky();
  scene.setSun(30, 20);
  scene.addBall(0.01f);
  check(wlkPrepare(scene.context));
}

// Of the view's passes in the frame before, ns.
uint64_t viewTime(const EngineScene& scene) {
  uint64_t sum = 0;
  for (const WlkPassStats& pass : scene.passes()) {
    sum += pass.gpuTime_ns;
  }
  return sum;
}

// lavapipe's ticks are nanoseconds.
TEST(Timestamps, OfViewsThatPassTheirLastBitAreMeasured) {
  SpyDevice::fakeTimestamps(36);
  EngineScene scene;
  fill(scene);
  uint64_t written = 0;
  for (int i = 0; i < WARM_UP; ++i) {
    written = scene.renderFrame().view.timestamps;
  }
  EXPECT_GT(written, 2u);
  SpyDevice::fakeTimestamps(36);  // the clock is at its end again
  scene.renderFrame();
  EXPECT_EQ(viewTime(scene), SpyDevice::TICK * (written - 1));
  EXPECT_TRUE(scene.device().messages().empty());
}

TEST(Timestamps, OfCloudShadowsThatPassTheirLastBitAreMeasured) {
  SpyDevice::fakeTimestamps(36);
  ShadowMapScene shadow(info());
  fill(shadow.scene);
  EXPECT_EQ(shadow.record().counts.timestamps, 2u);
  EXPECT_EQ(shadow.record().state.gpuTime_ns, SpyDevice::TICK);
}

TEST(Timestamps, AreNotWrittenByViewsWhereTheQueueHasNone) {
  SpyDevice::fakeTimestamps(0);
  EngineScene scene;
  fill(scene);
  for (int i = 0; i < WARM_UP; ++i) {
    const VulkanCounts counts = scene.renderFrame().view;
    EXPECT_GT(counts.dispatches, 0u);
    EXPECT_EQ(counts.timestamps, 0u);
  }
  EXPECT_EQ(viewTime(scene), 0u);
}

TEST(Timestamps, AreNotWrittenByCloudShadowsWhereTheQueueHasNone) {
  SpyDevice::fakeTimestamps(0);
  ShadowMapScene shadow(info());
  fill(shadow.scene);
  const ShadowFrame first = shadow.record();
  EXPECT_GT(first.counts.dispatches, 0u);
  EXPECT_EQ(first.counts.timestamps, 0u);
  EXPECT_EQ(shadow.record().state.gpuTime_ns, 0u);
}

}  // namespace
}  // namespace welkin::test
