// SPDX-License-Identifier: MIT
// A steady frame makes nothing: no Vulkan object, no allocation on the device or the host, no
// descriptor write; and the library never submits or waits.
#include <gtest/gtest.h>

#include "stress/counting_allocator.hpp"
#include "support/engine_scene.hpp"
#include "support/library_allocations.hpp"

namespace welkin::test {
namespace {

constexpr int WARM_UP = 4;  // maxFramesInFlight + 1: every slot was recorded once

SceneOptions small(CountingAllocator& memory) {
  SceneOptions options;
  options.width = 24;
  options.height = 16;
  options.allocator = memory.callbacks();
  return options;
}

void expectNothingMade(const VulkanCounts& counts) {
  EXPECT_EQ(counts.created, 0u);
  EXPECT_EQ(counts.destroyed, 0u);
  EXPECT_EQ(counts.allocated, 0u);
}

TEST(SteadyFrame, MakesNothingWhileCameraSunAndVolumesMove) {
  CountingAllocator memory;
  EngineScene scene(small(memory));
  scene.setSky();
  scene.setFog(1e-4f, 200.0f);
  const WlkVolume volume = scene.addBall(0.01f);
  scene.addBall(0.002f);
  ASSERT_EQ(wlkPrepare(scene.context), WLK_SUCCESS);
  for (int i = 0; i < WARM_UP + 12; ++i) {
    scene.setSun(20.0 + i, 3.0 * i);
    scene.setCamera({10.0 * i, 2, 0}, 1.0 * i, 12);
    const auto transform = boxTransform({-900.0 + i, 500, -6000}, {2000, 2000, 2000});
    ASSERT_EQ(wlkSetVolumeTransform(scene.context, volume, transform.data()), WLK_SUCCESS);
    const uint64_t before = memory.calls() + libraryAllocations();
    const FrameCounts counts = scene.renderFrame();
    if (i < WARM_UP) {
      continue;
    }
    SCOPED_TRACE(i);
    expectNothingMade(counts.update);
    expectNothingMade(counts.view);
    EXPECT_EQ(counts.view.descriptorWrites + counts.update.descriptorWrites, 0u);
    EXPECT_EQ(counts.update.copies + counts.update.barriers, 0u);
    EXPECT_EQ(memory.calls() + libraryAllocations(), before) << "host allocations";
    EXPECT_EQ(scene.stats().descriptorWrites, 0u);
    EXPECT_EQ(scene.stats().bytesUploaded, 0u);
  }
  EXPECT_TRUE(scene.device().messages().empty()) << scene.device().messages().front();
}

// What wlkPrepare has not made for this form of scattering no frame asks for, not the first either.
TEST(SteadyFrame, FirstFrameOfALayerInItsFirstOrderAllocatesNothing) {
  CountingAllocator memory;
  EngineScene scene(small(memory));
  const WlkVolume volume = scene.addBall(0.01f);
  const auto flat = boxTransform({-1000, 500, -6000}, {2000, 50, 2000});
  ASSERT_EQ(wlkSetVolumeTransform(scene.context, volume, flat.data()), WLK_SUCCESS);
  auto quality = make<WlkQuality>();
  quality.scattering = WLK_SCATTERING_SINGLE;
  ASSERT_EQ(wlkSetQuality(scene.context, scene.view, &quality), WLK_SUCCESS);
  scene.setSun(20, 10);
  scene.setCamera({0, 2, 0}, 0, 12);
  ASSERT_EQ(wlkPrepare(scene.context), WLK_SUCCESS);
  const uint64_t before = libraryAllocations();
  scene.renderFrame();
  EXPECT_EQ(libraryAllocations(), before);
}

TEST(SteadyFrame, AllocationsOfTheRuntimeAreSeen) {
  CountingAllocator memory;
  EngineScene scene(small(memory));
  scene.setSky();
  const uint64_t before = libraryAllocations();
  ASSERT_EQ(wlkPrepare(scene.context), WLK_SUCCESS);
  EXPECT_GT(libraryAllocations(), before) << "the table of skylight, see WlkAllocator";
}

TEST(SteadyFrame, AnAirThatChangesIsSolvedAFewRowsAtATime) {
  CountingAllocator memory;
  EngineScene scene(small(memory));
  scene.setSky();
  scene.setSun(20, 10);
  scene.setCamera({0, 2, 0}, 0, 12);
  ASSERT_EQ(wlkPrepare(scene.context), WLK_SUCCESS);
  scene.renderFrame();
  const Image before = scene.read();
  auto sky = make<WlkSky>();
  sky.scaleHeight = 6000;
  ASSERT_EQ(wlkSetSky(scene.context, &sky), WLK_SUCCESS);
  constexpr int FRAMES = 24;  // of 8 rows: 32 altitudes for each of 6 orders
  int frames = 1;
  while (scene.renderFrame().update.copies == 0 && frames < 4 * FRAMES) {
    ++frames;
  }
  EXPECT_GE(frames, FRAMES / 2);
  EXPECT_LE(frames, 2 * FRAMES);
  const Image after = scene.read();
  EXPECT_FALSE(after == before);
  ASSERT_EQ(wlkPrepare(scene.context), WLK_SUCCESS);
  EXPECT_EQ(scene.renderFrame().update.copies, 0u) << "nothing is left to solve";
  EXPECT_TRUE(scene.read() == after);
}

TEST(SteadyFrame, MakesNothingWhileThingsComeAndGo) {
  CountingAllocator memory;
  EngineScene scene(small(memory));
  scene.setSky();
  const WlkVolume volume = scene.addBall(0.01f);
  scene.setSun(30, 20);
  ASSERT_EQ(wlkPrepare(scene.context), WLK_SUCCESS);
  const auto fogless = make<WlkSky>();
  for (int i = 0; i < 24; ++i) {
    // Sun up, down and away; volume in view and behind; a disk and none: no pipeline was forgotten.
    if (i % 3 == 2) {
      scene.clearLights();
    } else {
      scene.setSun(i % 3 == 0 ? 30.0 : -40.0, 20);
    }
    scene.setCamera({0, 2, 0}, i / 3 % 2 == 0 ? 0.0 : 180.0, 12);
    const auto transform =
        boxTransform({-1000, 500, i / 6 % 2 == 0 ? -6000.0 : 4000.0}, {2000, 2000, 2000});
    ASSERT_EQ(wlkSetVolumeTransform(scene.context, volume, transform.data()), WLK_SUCCESS);
    ASSERT_EQ(wlkSetSky(scene.context, &fogless), WLK_SUCCESS);
    const uint64_t before = memory.calls() + libraryAllocations();
    const FrameCounts counts = scene.renderFrame();
    if (i < WARM_UP) {
      continue;
    }
    SCOPED_TRACE(i);
    expectNothingMade(counts.update);
    expectNothingMade(counts.view);
    EXPECT_EQ(memory.calls() + libraryAllocations(), before) << "host allocations";
  }
  EXPECT_TRUE(scene.device().messages().empty()) << scene.device().messages().front();
}

TEST(SteadyFrame, RecordsTheSameCommandsEveryTime) {
  CountingAllocator memory;
  EngineScene scene(small(memory));
  scene.setSky();
  scene.setSun(30, 20);
  scene.addBall(0.01f);
  ASSERT_EQ(wlkPrepare(scene.context), WLK_SUCCESS);
  for (int i = 0; i < WARM_UP; ++i) {
    scene.renderFrame();
  }
  const VulkanCounts first = scene.renderFrame().view;
  const Image picture = scene.read();
  for (int i = 0; i < 6; ++i) {
    const VulkanCounts again = scene.renderFrame().view;
    EXPECT_EQ(again.dispatches, first.dispatches);
    EXPECT_EQ(again.barriers, first.barriers);
    EXPECT_EQ(again.copies, first.copies);
    EXPECT_TRUE(scene.read() == picture);
  }
}

TEST(SteadyFrame, TheBudgetOfAFrameIsExact) {
  CountingAllocator memory;
  SceneOptions options = small(memory);
  EngineScene scene(options);
  scene.setSky();
  scene.setSun(30, 20);
  scene.addBall(0.01f);
  for (const auto& [slices, batch] : {std::pair{32u, 32u}, {32u, 8u}, {33u, 8u}, {16u, 1u}}) {
    auto quality = make<WlkQuality>();
    quality.level = WLK_QUALITY_LOW;
    quality.scattering = WLK_SCATTERING_FORWARD;
    quality.sliceCount = slices;
    quality.batchSize = batch;
    ASSERT_EQ(wlkSetQuality(scene.context, scene.view, &quality), WLK_SUCCESS);
    ASSERT_EQ(wlkPrepare(scene.context), WLK_SUCCESS);
    for (int i = 0; i < WARM_UP; ++i) {
      scene.renderFrame();
    }
    const VulkanCounts counts = scene.renderFrame().view;
    const uint64_t batches = (slices + batch - 1) / batch;
    // Light and eye once per batch, one composite; a barrier before each, one at the start, one to
    // the CPU, and the target's way there and back.
    EXPECT_EQ(counts.dispatches, 2 * batches + 1);
    EXPECT_EQ(counts.draws, 0u);
    EXPECT_EQ(counts.barriers, 2 * batches + 1 + 4);
    EXPECT_EQ(counts.copies, 1u) << "the counter's reset";
  }
}

TEST(SteadyFrame, UploadsCostTheirBytesAndOneCopyEach) {
  CountingAllocator memory;
  EngineScene scene(small(memory));
  scene.setSun(30, 20);
  const WlkVolume volume = scene.addBall(0.01f);
  ASSERT_EQ(wlkPrepare(scene.context), WLK_SUCCESS);
  for (int i = 0; i < WARM_UP; ++i) {
    scene.renderFrame();
  }
  const std::vector<float> values(512, 0.5f);
  scene.upload(volume, {8, 8, 8}, values);
  const FrameCounts counts = scene.renderFrame();
  EXPECT_EQ(counts.update.copies, 1u);
  EXPECT_EQ(counts.update.created, 0u) << "the buffer is made by wlkUploadVolume";
  EXPECT_EQ(scene.stats().bytesUploaded, values.size() * sizeof(float));
  EXPECT_EQ(counts.view.descriptorWrites, 0u);
  scene.renderFrame();
  EXPECT_EQ(scene.stats().bytesUploaded, 0u);
}

TEST(EngineDevice, TheLibraryAsksForNothingThatSubmitsOrWaits) {
  CountingAllocator memory;
  EngineScene scene(small(memory));
  scene.setSky();
  ASSERT_EQ(wlkPrepare(scene.context), WLK_SUCCESS);
  scene.renderFrame();
  EXPECT_GT(SpyDevice::namesAsked().size(), 20u);
  for (const char* forbidden :
       {"vkQueueSubmit", "vkQueueSubmit2", "vkQueueWaitIdle", "vkDeviceWaitIdle", "vkWaitForFences",
        "vkWaitSemaphores", "vkGetDeviceQueue", "vkCreateCommandPool", "vkBeginCommandBuffer",
        "vkDestroyDevice"}) {
    EXPECT_EQ(SpyDevice::namesAsked().count(forbidden), 0u) << forbidden;
  }
}

TEST(EngineDevice, EveryObjectMadeIsDestroyed) {
  CountingAllocator memory;
  SpyDevice::counts() = {};
  VulkanCounts counts;
  {
    EngineScene scene(small(memory));
    scene.setSky();
    scene.setSun(30, 20);
    scene.addBall(0.01f);
    const WlkVolume volume = scene.addBall(0.01f);
    ASSERT_EQ(wlkPrepare(scene.context), WLK_SUCCESS);
    ASSERT_EQ(wlkDestroyVolume(scene.context, volume), WLK_SUCCESS);
    counts = SpyDevice::counts();
    wlkDestroyContext(scene.context);
    scene.context = nullptr;
    EXPECT_TRUE(scene.device().messages().empty()) << scene.device().messages().front();
  }
  EXPECT_GT(counts.created, 0u);
  EXPECT_EQ(SpyDevice::counts().created, SpyDevice::counts().destroyed);
  EXPECT_EQ(memory.live(), 0u);
}

}  // namespace
}  // namespace welkin::test
