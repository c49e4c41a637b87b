// SPDX-License-Identifier: MIT
// A governed view in frames of an engine, driven by reported times: what a change of rung records
// and makes, and that a rung looks like the same numbers asked for by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "stress/counting_allocator.hpp"
#include "support/engine_scene.hpp"
#include "support/library_allocations.hpp"
#include "support/on_gpu.hpp"

namespace welkin::test {
namespace {

constexpr double BUDGET = 4.0;  // ms

WlkQuality governed(uint32_t control, uint32_t level, uint32_t scattering) {
  auto quality = make<WlkQuality>();
  quality.level = level;
  quality.scattering = scattering;
  quality.control = control;
  if (control == WLK_CONTROL_ERROR) {
    quality.errorTarget = 0.05f;
  } else {
    quality.timeBudget_ms = static_cast<float>(BUDGET);
  }
  return quality;
}

class GovernedScene {
 public:
  explicit GovernedScene(const WlkQuality& quality) : scene(options(memory)) {
    scene.setSun(30, 20);
    scene.addBall(0.004f);
    scene.setCamera({0, 2, 0}, 0, 12);
    set(quality);
    EXPECT_EQ(wlkPrepare(scene.context), WLK_SUCCESS);
  }
  ~GovernedScene() {
    EXPECT_TRUE(scene.device().messages().empty()) << scene.device().messages().front();
  }

  void set(const WlkQuality& quality) {
    EXPECT_EQ(wlkSetQuality(scene.context, scene.view, &quality), WLK_SUCCESS);
  }
  WlkQualityState state() const {
    auto state = make<WlkQualityState>();
    EXPECT_EQ(wlkGetQualityState(scene.context, scene.view, &state), WLK_SUCCESS);
    return state;
  }
  WlkResult report(uint64_t frame, double milliseconds) const {
    return wlkReportFrameTime(scene.context, scene.view, frame, milliseconds);
  }
  // A frame, and its time; the rung it was drawn on.
  uint32_t frame(double milliseconds) {
    const uint32_t rung = state().rung;
    counts = scene.renderFrame();
    EXPECT_EQ(report(scene.frame(), milliseconds), WLK_SUCCESS);
    return rung;
  }

  CountingAllocator memory;
  EngineScene scene;
  FrameCounts counts;

 private:
  static SceneOptions options(CountingAllocator& memory) {
    SceneOptions options;
    options.width = 24;
    options.height = 16;
    options.allocator = memory.callbacks();
    return options;
  }
};

// Frames that visit most rungs: up to the highest, then down in small steps.
template <typename F>
void visitRungs(GovernedScene& governed, F&& look) {
  for (int i = 0; i < 60 && governed.state().rung < governed.state().highestRung; ++i) {
    look(governed.frame(0.05 * BUDGET));
  }
  EXPECT_EQ(governed.state().rung, governed.state().highestRung);
  for (int i = 0; i < 200 && governed.state().rung > governed.state().lowestRung; ++i) {
    look(governed.frame(1.05 * BUDGET));
  }
  EXPECT_EQ(governed.state().rung, governed.state().lowestRung);
}

TEST(GovernedView, MakesAndWritesNothingWhenTheRungChanges) {
  for (const uint32_t scattering : {WLK_SCATTERING_FORWARD, WLK_SCATTERING_ALL_ORDERS}) {
    GovernedScene governed(test::governed(WLK_CONTROL_REPORTED_TIME, WLK_QUALITY_HIGH, scattering));
    for (int i = 0; i < 4; ++i) {
      governed.frame(BUDGET);  // every slot was recorded once
    }
    std::map<uint32_t, int> seen;
    uint64_t before = governed.memory.calls() + libraryAllocations();
    visitRungs(governed, [&](uint32_t rung) {
      SCOPED_TRACE(rung);
      ++seen[rung];
      for (const VulkanCounts& counts : {governed.counts.update, governed.counts.view}) {
        EXPECT_EQ(counts.created, 0u);
        EXPECT_EQ(counts.destroyed, 0u);
        EXPECT_EQ(counts.allocated, 0u);
        EXPECT_EQ(counts.descriptorWrites, 0u);
      }
      EXPECT_EQ(governed.memory.calls() + libraryAllocations(), before) << "host allocations";
      before = governed.memory.calls() + libraryAllocations();
    });
    EXPECT_GE(seen.size(), 4u);
  }
}

TEST(GovernedView, ARungIsThePictureOfItsNumbers) {
  // Light-buffer coordinates are rounded to a float's 2^-24 of the larger buffer instead of their
  // own: a millionth of a texel's difference of light. A GPU's filters may take another step there,
  // for a few fetches of a ray's many; measured 4.6e-5.
  const double bound = onGpu() ? FILTER_STEP / 64 : 1e-5;
  for (const uint32_t scattering : {WLK_SCATTERING_FORWARD, WLK_SCATTERING_ALL_ORDERS}) {
    const uint32_t level = WLK_QUALITY_MEDIUM;
    GovernedScene governed(test::governed(WLK_CONTROL_REPORTED_TIME, level, scattering));
    std::map<uint32_t, std::pair<WlkQualityState, Image>> rungs;
    WlkQualityState now = governed.state();
    visitRungs(governed, [&](uint32_t rung) {
      if (rungs.count(rung) == 0) {
        rungs.emplace(rung, std::pair(now, governed.scene.read()));
        EXPECT_EQ(now.rung, rung);
      }
      now = governed.state();
    });
    for (const auto& [rung, what] : rungs) {
      auto plain = make<WlkQuality>();
      plain.level = level;
      plain.scattering = scattering;
      plain.sliceCount = what.first.sliceCount;
      plain.lightBufferSize = what.first.lightBufferSize;
      plain.volumeCells = what.first.volumeCells;
      GovernedScene asked(plain);
      asked.scene.renderFrame();
      const Image own = asked.scene.read();
      EXPECT_LE(relativeRms(what.second, own), bound) << rung;
    }
    EXPECT_GE(rungs.size(), 3u);
    EXPECT_FALSE(rungs.begin()->second.second == rungs.rbegin()->second.second);
  }
}

TEST(GovernedView, RefusesHostileTimesAndOtherControls) {
  GovernedScene governed(test::governed(WLK_CONTROL_REPORTED_TIME, WLK_QUALITY_MEDIUM, 0));
  EXPECT_EQ(governed.report(1, 1.0), WLK_ERROR_INVALID_ARGUMENT) << "no frame yet";
  governed.frame(BUDGET);
  const uint64_t frame = governed.scene.frame();
  const WlkQualityState before = governed.state();
  for (const double time :
       {std::numeric_limits<double>::quiet_NaN(), 0.0, -1.0, 1e30, -1e30,
        std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(governed.report(frame, time), WLK_ERROR_INVALID_ARGUMENT) << time;
    auto error = make<WlkErrorInfo>();
    ASSERT_EQ(wlkGetLastError(&error), WLK_SUCCESS);
    EXPECT_STREQ(error.field, "milliseconds");
  }
  for (const uint64_t future : {uint64_t{0}, frame + 1, ~uint64_t{0}}) {
    EXPECT_EQ(governed.report(future, 1.0), WLK_ERROR_INVALID_ARGUMENT) << future;
  }
  EXPECT_EQ(governed.state().switches, before.switches);
  EXPECT_EQ(governed.state().time_ms, before.time_ms);
  auto plain = make<WlkQuality>();
  governed.set(plain);
  EXPECT_EQ(governed.report(frame, 1.0), WLK_ERROR_WRONG_STATE);
  EXPECT_EQ(governed.state().reason, uint32_t{WLK_CONTROL_REASON_NONE});
}

TEST(GovernedView, AnotherBudgetNeedsNoPreparingAnotherControlDoes) {
  WlkQuality quality = governed(WLK_CONTROL_REPORTED_TIME, WLK_QUALITY_MEDIUM, 0);
  GovernedScene governed(quality);
  for (int i = 0; i < 60; ++i) {
    governed.frame(0.5 * BUDGET);
  }
  EXPECT_EQ(governed.state().reason, uint32_t{WLK_CONTROL_REASON_BEST});
  quality.timeBudget_ms = static_cast<float>(0.1 * BUDGET);
  governed.set(quality);
  for (int i = 0; i < 60; ++i) {
    governed.frame(0.5 * BUDGET);
  }
  EXPECT_EQ(governed.state().rung, 0u);
  EXPECT_EQ(governed.state().reason, uint32_t{WLK_CONTROL_REASON_UNREACHABLE});
}

TEST(QualityState, HasNoNumberOfWhatTheLevelDoesWithout) {
  GovernedScene governed(make<WlkQuality>());
  EXPECT_GT(governed.state().sliceCount, 0u);
  EXPECT_EQ(governed.state().batchSize, 0u) << "light is kept";
  EXPECT_GT(governed.state().volumeCells, 0u);
  auto quality = make<WlkQuality>();
  quality.batchSize = 8;
  quality.scattering = WLK_SCATTERING_SINGLE;
  governed.set(quality);
  EXPECT_EQ(governed.state().batchSize, 8u);
  EXPECT_EQ(governed.state().volumeCells, 0u);
}

TEST(GovernedView, WithoutAVolumeInViewItWaits) {
  GovernedScene governed(test::governed(WLK_CONTROL_REPORTED_TIME, WLK_QUALITY_MEDIUM, 0));
  for (int i = 0; i < 60; ++i) {
    governed.frame(0.5 * BUDGET);
  }
  const uint32_t rung = governed.state().rung;
  governed.scene.setCamera({0, 2, 0}, 180, 12);
  for (int i = 0; i < 60; ++i) {
    governed.frame(10 * BUDGET);
  }
  EXPECT_EQ(governed.state().rung, rung);
  EXPECT_EQ(governed.state().reason, uint32_t{WLK_CONTROL_REASON_IDLE});
}

TEST(GovernedView, MeasuresItsOwnTimes) {
  WlkQuality quality = governed(WLK_CONTROL_TIME, WLK_QUALITY_MEDIUM, 0);
  quality.timeBudget_ms = 1000;
  GovernedScene governed(quality);
  for (int i = 0; i < 40; ++i) {
    governed.scene.renderFrame();
  }
  EXPECT_EQ(governed.state().rung, governed.state().highestRung);
  EXPECT_EQ(governed.state().reason, uint32_t{WLK_CONTROL_REASON_BEST});
  EXPECT_GT(governed.state().time_ms, 0.0f);
  quality.timeBudget_ms = 0.01f;
  governed.set(quality);
  for (int i = 0; i < 60; ++i) {
    governed.scene.renderFrame();
  }
  EXPECT_EQ(governed.state().rung, governed.state().lowestRung);
  EXPECT_EQ(governed.state().reason, uint32_t{WLK_CONTROL_REASON_UNREACHABLE});
}

TEST(GovernedView, KeepsAnErrorTargetOrSaysThatItCannot) {
  WlkQuality quality = governed(WLK_CONTROL_ERROR, WLK_QUALITY_ULTRA, 0);
  quality.level = WLK_QUALITY_HIGH;
  GovernedScene governed(quality);
  auto estimate = make<WlkErrorEstimate>();
  const auto check = [&](float target) {
    quality.errorTarget = target;
    governed.set(quality);
    for (int i = 0; i < 80; ++i) {
      const uint64_t before = governed.memory.calls() + libraryAllocations();
      governed.scene.renderFrame();
      EXPECT_TRUE(i < 4 || governed.memory.calls() + libraryAllocations() == before)
          << "host allocations";
    }
    EXPECT_EQ(wlkGetErrorEstimate(governed.scene.context, governed.scene.view, &estimate),
              WLK_SUCCESS);
    const WlkQualityState state = governed.state();
    EXPECT_FLOAT_EQ(state.relativeError, estimate.relativeError);
    return state;
  };
  const WlkQualityState none = check(1e-4f);
  EXPECT_EQ(none.reason, uint32_t{WLK_CONTROL_REASON_UNREACHABLE});
  EXPECT_EQ(none.rung, none.highestRung);
  const float best = none.relativeError;
  const WlkQualityState any = check(1.0f);
  EXPECT_EQ(any.rung, 0u);
  EXPECT_EQ(any.reason, uint32_t{WLK_CONTROL_REASON_FITS});
  ASSERT_LT(best, any.relativeError);
  const float middle = std::sqrt(best * any.relativeError);
  const WlkQualityState some = check(middle);
  EXPECT_LE(some.relativeError, middle);
  EXPECT_EQ(some.reason, uint32_t{WLK_CONTROL_REASON_FITS});
  EXPECT_GT(some.rung, 0u);
  EXPECT_LE(some.rung, none.highestRung);
}

}  // namespace
}  // namespace welkin::test
