// SPDX-License-Identifier: MIT
// What recording a steady frame costs the calling thread where there is something to skip, against
// a frame without it: medians of the ratios of frames recorded in turns. The thread's own CPU time
// without validation: neither waiting, nor the driver's workers, nor most of what other programs do
// counts.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <vector>

#include "support/engine_scene.hpp"

namespace welkin::test {
namespace {

constexpr int WARM_UP = 8;  // slots, caches and branch predictors
constexpr int PAIRS = 1001;

// Ratios of equal scenes were 0.99 to 1.01, on an idle machine and on one with 3 programs per core.
constexpr double NOISE = 1.08;

SceneOptions unvalidated() {
  SceneOptions options;
  options.width = 24;
  options.height = 16;
  options.validation = false;
  options.ambient = true;
  return options;
}

// Air, sun, and a cloud in view.
struct Clouded {
  explicit Clouded(const std::function<void(EngineScene&)>& add) : scene(unvalidated()) {
    scene.submit = false;
    scene.setSky();
    scene.setSun(30, 20);
    scene.setCamera({0, 2, 0}, 0, 12);
    scene.addBall(0.01f);
    add(scene);
    check(wlkPrepare(scene.context));
    for (int i = 0; i < WARM_UP; ++i) {
      scene.renderFrame();
    }
  }
  EngineScene scene;
};

void nothing(EngineScene&) {}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Time with what `add` adds over time without.
double ratioOf(const std::function<void(EngineScene&)>& add) {
  Clouded without(nothing);
  Clouded with(add);
  std::vector<double> ratios;
  std::vector<double> seconds;
  for (int i = 0; i < PAIRS; ++i) {
    // Each goes first in half of the pairs.
    EngineScene& first = i % 2 == 0 ? without.scene : with.scene;
    EngineScene& second = i % 2 == 0 ? with.scene : without.scene;
    const double a = first.renderFrame().cpuSeconds;
    const double b = second.renderFrame().cpuSeconds;
    ratios.push_back(i % 2 == 0 ? b / a : a / b);
    seconds.push_back(i % 2 == 0 ? a : b);
  }
  const double ratio = median(ratios);
  std::printf("ratio %.3f, of %.1f us\n", ratio, 1e6 * median(seconds));
  return ratio;
}

void addZeroVolume(EngineScene& scene) {
  const WlkVolume volume = scene.addBall(0.01f);
  scene.upload(volume, {8, 8, 8}, std::vector<float>(512, 0.0f));
}

void addVolumeBehind(EngineScene& scene) {
  const WlkVolume volume = scene.addBall(0.01f);
  const auto behind = boxTransform({-1000, 500, 4000}, {2000, 2000, 2000});
  check(wlkSetVolumeTransform(scene.context, volume, behind.data()));
}

TEST(RecordingTime, EqualScenesTakeEqualTime) {
  const double ratio = ratioOf(nothing);
  EXPECT_LE(ratio, NOISE);
  EXPECT_GE(ratio, 1.0 / NOISE);
}

// Else the tests below could not fail.
TEST(RecordingTime, AVolumeInViewIsSeen) {
  EXPECT_GT(ratioOf([](EngineScene& scene) { scene.addBall(0.002f); }), 1.15 * NOISE);
}

TEST(RecordingTime, AnEmptyVolumeCostsNextToNothing) {
  constexpr double PASSES_NOT_TAKEN = 1.07;  // a box in the plan, reasons in the statistics: 1.02
  EXPECT_LE(ratioOf(addZeroVolume), PASSES_NOT_TAKEN * NOISE);
}

TEST(RecordingTime, AVolumeBehindTheEyeCostsNextToNothing) {
  constexpr double BOX_TESTED = 1.07;  // 1.02
  EXPECT_LE(ratioOf(addVolumeBehind), BOX_TESTED * NOISE);
}

TEST(RecordingTime, FogWithoutExtinctionCostsNothing) {
  EXPECT_LE(ratioOf([](EngineScene& scene) { scene.setFog(0.0f, 100.0f); }), NOISE);
}

TEST(RecordingTime, ASunBelowTheHorizonCostsNoMoreThanOneAbove) {
  EXPECT_LE(ratioOf([](EngineScene& scene) { scene.setSun(-40, 20); }), NOISE);
}

}  // namespace
}  // namespace welkin::test
