// SPDX-License-Identifier: MIT
// Times of the GPU on queues whose timestamps have few bits, or none.
#include <gtest/gtest.h>

#include "support/shadow_map_scene.hpp"
#include "support/surface_scene.hpp"

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

// All that a surface can ask for in one frame is as much as queries have room for
// (SURFACE_DISPATCHES of frame/surface_record.hpp); the layer reports more.
TEST(Timestamps, OfASurfaceThatAsksForEverythingHaveRoom) {
  constexpr uint32_t MOST = 32;
  SceneOptions options;
  options.level = WLK_QUALITY_HIGH;
  options.volumeResolution = WLK_VOLUME_RESOLUTION_HALF;
  options.ambient = true;
  EngineScene scene(options);
  scene.setSky();
  scene.setSun(30, 20);
  const WlkSurface surface = addSurface(scene, support::boxMesh(), scene.addMedium(), 0.01f,
                                        {900, 900, 900}, {0, 1500, -5000});
  auto detail = make<WlkSurfaceDetail>();
  detail.depth = 120;
  detail.size = 500;
  check(wlkSetSurfaceDetail(scene.context, surface, &detail));
  check(wlkPrepare(scene.context));
  const uint64_t written = scene.renderFrame().view.timestamps;
  uint32_t commands = 0;
  for (const WlkPassStats& pass : scene.passes()) {
    const bool mine = pass.pass == WLK_PASS_SURFACE || pass.pass == WLK_PASS_SURFACE_LIGHT;
    commands += mine ? pass.commands : 0;
  }
  EXPECT_EQ(commands, MOST);
  EXPECT_GT(written, uint64_t{MOST});
  EXPECT_TRUE(scene.device().messages().empty());
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
