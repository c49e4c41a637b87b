// SPDX-License-Identifier: MIT
// WlkContextInfo::deviceMemoryLimit: what would exceed it is refused before the driver is asked,
// and nothing is lost; with the limit raised to what is used, everything fits.
#include "stress/budget_scene.hpp"
#include "support/on_gpu.hpp"
#include "support/vulkan_layer.hpp"

namespace welkin::test {
namespace {

constexpr uint64_t MIB = uint64_t{1} << 20;

// As documented: the error names the limit, and no call of Vulkan failed.
void expectRefused(WlkResult result, const char* what) {
  EXPECT_FAILS(result, WLK_ERROR_OUT_OF_DEVICE_MEMORY, "deviceMemoryLimit") << what;
  EXPECT_EQ(lastError().structType, uint32_t{WLK_STRUCT_CONTEXT_INFO}) << what;
  EXPECT_EQ(lastError().vkResult, 0) << what;
}

// Calls that allocate, since the last FaultLayer::failNever().
uint64_t allocations() {
  return FaultLayer::calls("vkAllocateMemory");
}

class MemoryLimit : public ::testing::Test {
 protected:
  MemoryLimit() {
    FaultLayer::makeHollowPipelines(true);
    FaultLayer::failNever();
  }
  ~MemoryLimit() override {
    FaultLayer::makeHollowPipelines(false);
    EXPECT_TRUE(FaultLayer::live().empty()) << "left: " << FaultLayer::live().begin()->first;
    EXPECT_EQ(FaultLayer::memory(), 0u);
    EXPECT_TRUE(engine.spy.messages().empty()) << engine.spy.messages().front();
  }

  BudgetEngine engine;
};

TEST_F(MemoryLimit, VolumesBeyondItAreRefusedBeforeTheDriverIsAsked) {
  BudgetScene scene(engine);
  ASSERT_EQ(scene.create(48 * MIB), WLK_SUCCESS);
  ASSERT_EQ(scene.addVolume(64), WLK_SUCCESS);
  FaultLayer::failNever();
  expectRefused(scene.addVolume(512), "a large one");
  EXPECT_EQ(allocations(), 0u) << "the driver was asked";
  EXPECT_EQ(scene.addVolume(64), WLK_SUCCESS) << "what fits still fits";
}

TEST_F(MemoryLimit, ContextsBeyondItAreNotMade) {
  BudgetScene scene(engine);
  expectRefused(scene.create(1), "a context");
  EXPECT_EQ(scene.context, nullptr);
  EXPECT_EQ(allocations(), 0u) << "the driver was asked";
  EXPECT_TRUE(FaultLayer::live().empty());
}

TEST_F(MemoryLimit, MemoryThatIsFreedCountsNoMore) {
  BudgetScene scene(engine);
  ASSERT_EQ(scene.create(96 * MIB), WLK_SUCCESS);
  for (int round = 0; round < 8; ++round) {
    ASSERT_EQ(scene.addVolume(192), WLK_SUCCESS) << round;  // 27 MiB of floats
    ASSERT_EQ(scene.destroyVolume(), WLK_SUCCESS);
  }
}

TEST_F(MemoryLimit, NoneIsTheDefault) {
  EXPECT_EQ(make<WlkContextInfo>().deviceMemoryLimit, 0u);
  BudgetScene scene(engine);
  EXPECT_EQ(scene.create(0), WLK_SUCCESS);
}

// What a whole scene uses, with or without its ballast: the most at any time.
uint64_t useOf(BudgetEngine& engine, bool ballast) {
  FaultLayer::failNever();
  BudgetScene scene(engine);
  EXPECT_EQ(scene.create(0), WLK_SUCCESS);
  for (const BudgetScene::Step& step : scene.steps(ballast)) {
    EXPECT_EQ(step.call(), WLK_SUCCESS) << step.entry << ": " << lastError().message;
  }
  EXPECT_EQ(scene.stats().deviceMemory, FaultLayer::memory()) << "it tells something else";
  return FaultLayer::mostMemory();
}

TEST_F(MemoryLimit, OfExactlyWhatASceneUsesSuffices) {
  const uint64_t use = useOf(engine, true);
  std::printf("a scene uses %.1f MiB\n", double(use) / double(MIB));
  FaultLayer::failNever();
  BudgetScene scene(engine);
  ASSERT_EQ(scene.create(use), WLK_SUCCESS);
  for (const BudgetScene::Step& step : scene.steps(true)) {
    EXPECT_EQ(step.call(), WLK_SUCCESS) << step.entry << ": " << lastError().message;
  }
  EXPECT_EQ(FaultLayer::mostMemory(), use);
}

// Whatever call finds no room says so, asked once or twice, and takes nothing. It succeeds once the
// ballast has gone, if the rest fits; if not, a small scene in the same context does.
TEST_F(MemoryLimit, OfAPartOfWhatASceneUsesRefusesTheRest) {
  const uint64_t use = useOf(engine, true);
  const uint64_t light = useOf(engine, false);
  for (const uint64_t percent : {20u, 40u, 60u, 80u, 90u}) {
    SCOPED_TRACE(std::to_string(percent) + " %");
    const uint64_t limit = use * percent / 100;
    FaultLayer::failNever();
    BudgetScene scene(engine);
    ASSERT_EQ(scene.create(limit), WLK_SUCCESS);
    std::string refused;
    for (const BudgetScene::Step& step : scene.steps(true)) {
      const WlkResult result = step.call();
      if (result >= 0) {
        continue;
      }
      refused += std::string(refused.empty() ? "" : ", ") + step.entry;
      expectRefused(result, step.entry);
      const uint64_t before = FaultLayer::memory();
      expectRefused(step.call(), "again");
      EXPECT_EQ(FaultLayer::memory(), before) << step.entry << " takes more each time";
      if (step.ballast) {
        continue;
      }
      EXPECT_EQ(scene.dropBallast(), WLK_SUCCESS);
      if (limit < light) {
        expectRefused(step.call(), "without the ballast");
        EXPECT_EQ(scene.shrink(), WLK_SUCCESS) << lastError().message;
      }
      EXPECT_EQ(step.call(), WLK_SUCCESS) << step.entry << ": " << lastError().message;
    }
    EXPECT_FALSE(refused.empty()) << "everything fits";
    EXPECT_LE(FaultLayer::mostMemory(), limit) << "the driver was asked for more";
    std::printf("%llu %% of it: %s\n", static_cast<unsigned long long>(percent), refused.c_str());
  }
}

// An eye that has risen asks for a sharper sky. Without room for it the view stays as it was.
TEST_F(MemoryLimit, AViewThatNeedsNoOtherBuffersKeepsThoseItHas) {
  uint64_t full = 0;
  for (int life = 0; life < 2; ++life) {
    SCOPED_TRACE(life);
    FaultLayer::failNever();
    BudgetScene scene(engine);
    ASSERT_EQ(scene.create(full), WLK_SUCCESS);
    scene.addSky();
    for (const BudgetScene::Step& step : scene.steps(false)) {
      EXPECT_EQ(step.call(), WLK_SUCCESS) << step.entry << ": " << lastError().message;
    }
    full = FaultLayer::mostMemory();
    scene.rise();
    if (life == 0) {
      EXPECT_EQ(scene.prepare(), WLK_SUCCESS) << lastError().message;
      EXPECT_GT(FaultLayer::mostMemory(), full) << "it needs nothing";
    } else {
      expectRefused(scene.prepare(), "a sharper sky");
    }
    EXPECT_EQ(scene.frame(), WLK_SUCCESS) << lastError().message;
  }
}

// Headless contexts have no frames in flight: a full one changes a view's size in one call.
TEST_F(MemoryLimit, AHeadlessViewMadeAnewNeedsNoRoomForTwo) {
  const UnderFaultLayer layer;
  SceneOptions options;
  options.validation = false;
  options.width = 1280;
  options.height = 720;
  for (int life = 0; life < 2; ++life) {
    SCOPED_TRACE(life);
    const HeadlessScene scene(options);
    scene.setSun(30, 40);
    scene.addBall(0.005f);
    EXPECT_EQ(wlkPrepare(scene.context), WLK_SUCCESS);
    EXPECT_EQ(wlkRenderHeadless(scene.context, scene.view, nullptr), WLK_SUCCESS);
    options.deviceMemoryLimit = scene.stats().deviceMemory;
    EXPECT_EQ(FaultLayer::memory(), options.deviceMemoryLimit);
    auto info = make<WlkViewInfo>();
    for (const uint32_t width : {640u, 1280u}) {
      info.width = width;
      info.height = options.height;
      EXPECT_EQ(wlkUpdateView(scene.context, scene.view, &info), WLK_SUCCESS);
      EXPECT_EQ(wlkPrepare(scene.context), WLK_SUCCESS) << width << ": " << lastError().message;
      EXPECT_EQ(wlkRenderHeadless(scene.context, scene.view, nullptr), WLK_SUCCESS);
    }
  }
}

using Needing = BudgetScene::Needing;

class MemoryLimitOf : public MemoryLimit, public ::testing::WithParamInterface<Needing> {
 protected:
  // A scene that has drawn, and what it uses then: the most at any time as well.
  static uint64_t draw(BudgetScene& scene, uint64_t limit) {
    const bool surface = GetParam() != Needing::SURFACE;
    FaultLayer::failNever();
    EXPECT_EQ(scene.create(limit), WLK_SUCCESS);
    for (const BudgetScene::Step& step : scene.steps(true, surface)) {
      EXPECT_EQ(step.call(), WLK_SUCCESS) << step.entry << ": " << lastError().message;
    }
    return FaultLayer::mostMemory();
  }
  // What a view had before it is made anew goes with the frames that used it. Where there is no
  // room beside it, the next frame has the room.
  static WlkResult prepareInTurn(BudgetScene& scene) {
    const WlkResult result = scene.prepare();
    if (result == WLK_SUCCESS) {
      return result;
    }
    expectRefused(result, "wlkPrepare");
    EXPECT_EQ(scene.completeAll(), WLK_SUCCESS);
    return scene.prepare();
  }
};

// A full context refuses what needs more without a call that allocates, goes on drawing, and does
// it once something has gone.
TEST_P(MemoryLimitOf, AFullContextRefusesWhatNeedsMore) {
  const Needing needing = GetParam();
  uint64_t full = 0;
  {
    BudgetScene scene(engine);
    full = draw(scene, 0);
  }
  BudgetScene scene(engine);
  draw(scene, full);
  if (FaultLayer::memory() < full) {  // of what was staged
    EXPECT_EQ(scene.stageBlock(), WLK_SUCCESS) << lastError().message;
  }
  ASSERT_EQ(FaultLayer::memory(), full) << "there is room";
  FaultLayer::failNever();
  if (onGpu() && needing == Needing::SURFACE) {
    GTEST_SKIP() << "blocks of other alignments have room for a small surface";
  }
  for (int i = 0; i < 2; ++i) {
    expectRefused(scene.add(needing), "a full context");
  }
  EXPECT_EQ(allocations(), 0u) << "the driver was asked";
  EXPECT_EQ(FaultLayer::memory(), full) << "something has gone";
  scene.goBack(needing);
  EXPECT_EQ(prepareInTurn(scene), WLK_SUCCESS) << lastError().message;
  EXPECT_EQ(scene.frame(), WLK_SUCCESS) << lastError().message;
  EXPECT_EQ(scene.dropBallast(), WLK_SUCCESS);
  EXPECT_EQ(scene.add(needing), WLK_SUCCESS) << lastError().message;
  EXPECT_EQ(scene.prepare(), WLK_SUCCESS) << lastError().message;
  EXPECT_EQ(scene.frame(), WLK_SUCCESS) << lastError().message;
  EXPECT_LE(FaultLayer::mostMemory(), full);
}

TEST_P(MemoryLimitOf, WhatItUsesSufficesForIt) {
  const Needing needing = GetParam();
  uint64_t use = 0;
  for (int life = 0; life < 2; ++life) {
    BudgetScene scene(engine);
    draw(scene, use);
    EXPECT_EQ(scene.add(needing), WLK_SUCCESS) << lastError().message;
    EXPECT_EQ(scene.prepare(), WLK_SUCCESS) << lastError().message;
    EXPECT_EQ(scene.frame(), WLK_SUCCESS) << lastError().message;
    EXPECT_TRUE(life == 0 || FaultLayer::mostMemory() == use) << FaultLayer::mostMemory();
    use = FaultLayer::mostMemory();
  }
}

INSTANTIATE_TEST_SUITE_P(All, MemoryLimitOf,
                         ::testing::Values(Needing::VOLUME, Needing::SURFACE, Needing::VIEW,
                                           Needing::SIZE, Needing::MAP),
                         [](const auto& one) { return BudgetScene::nameOf(one.param); });

}  // namespace
}  // namespace welkin::test
