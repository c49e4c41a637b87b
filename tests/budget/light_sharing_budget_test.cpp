// SPDX-License-Identifier: MIT
// The light inside volumes, of the sun and of sky and ground, is computed once for all views that
// ask for the same cells: a second view of a scene shows what the first computed.
#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "support/engine_scene.hpp"

namespace welkin::test {
namespace {

constexpr uint32_t SHOWN = 1;  // commands that turn kept light to a view's eye

SceneOptions small() {
  SceneOptions options;
  options.width = 24;
  options.height = 16;
  return options;
}

constexpr uint32_t PASSES[] = {WLK_PASS_VOLUME_LIGHT, WLK_PASS_VOLUME_AMBIENT};

class LightSharing : public ::testing::Test {
 protected:
  LightSharing() : scene(small()) {
    scene.setSun(30, 20);
    scene.setSky();
    auto ambient = make<WlkAmbient>();
    ambient.mode = WLK_AMBIENT_AUTOMATIC;
    check(wlkSetAmbient(scene.context, &ambient));
    first = scene.view;
    second = scene.addView(small());
    choose(second, WLK_QUALITY_LOW);
    scene.setCamera({600, 2, 0}, -5, 12);
    choose(first, WLK_QUALITY_LOW);
    scene.setCamera({0, 2, 0}, 0, 12);
    scene.addBall(0.01f);
  }
  ~LightSharing() override { EXPECT_TRUE(scene.messages().empty()) << scene.messages().front(); }

  void choose(WlkView view, uint32_t level, uint64_t flags = 0) {
    scene.view = view;
    auto quality = make<WlkQuality>();
    quality.level = level;
    quality.flags = flags;
    check(wlkSetQuality(scene.context, view, &quality));
  }
  Image show(WlkView view) {
    scene.view = view;
    return scene.render();
  }
  // Of the view that was rendered last.
  WlkPassStats line(uint32_t wanted) const {
    for (const WlkPassStats& pass : scene.passes()) {
      if (pass.pass == wanted) {
        return pass;
      }
    }
    ADD_FAILURE() << "no pass " << wanted;
    return {};
  }
  void expectShown(const char* after) const {
    for (const uint32_t pass : PASSES) {
      EXPECT_EQ(line(pass).commands, SHOWN) << line(pass).name << ": " << after;
      EXPECT_STREQ(wlkReasonName(line(pass).reason), "WLK_REASON_UNCHANGED") << after;
    }
  }
  void expectComputed(const char* after) const {
    for (const uint32_t pass : PASSES) {
      EXPECT_GT(line(pass).commands, 20u) << line(pass).name << ": " << after;
    }
  }

  HeadlessScene scene;
  WlkView first{};
  WlkView second{};
};

TEST_F(LightSharing, ASecondViewComputesNone) {
  const Image alone = show(second);
  expectComputed("the first frame");
  show(first);
  expectShown("another view of the same");
  scene.setSun(50, 20);
  show(first);
  expectComputed("the sun moved");
  show(second);
  expectShown("the sun moved for both");
  scene.setSun(30, 20);
  show(first);
  EXPECT_TRUE(show(second) == alone);
  wlkDestroyView(scene.context, first);
  EXPECT_TRUE(show(second) == alone);
  expectShown("the view that computed it is gone");
}

TEST_F(LightSharing, OtherCellsAreOtherLight) {
  show(second);
  const Image alone = show(second);
  choose(first, WLK_QUALITY_MEDIUM);
  show(first);
  expectComputed("another level");
  EXPECT_TRUE(show(second) == alone);
  expectShown("the level of the other view changed");
}

TEST_F(LightSharing, SkipsNothingWhereAskedNotTo) {
  choose(second, WLK_QUALITY_LOW, WLK_QUALITY_FLAG_NO_SKIP);
  const Image alone = show(second);
  show(first);
  EXPECT_TRUE(show(second) == alone);
  expectComputed("without skipping");
}

// Light that is spread over frames goes on once a frame, however many views there are.
TEST(LightSharingSpread, GoesOnOncePerFrame) {
  constexpr uint32_t FRAMES = 5;
  const auto framesToRest = [&](size_t views) {
    EngineScene scene(small());
    scene.setSun(30, 20);
    std::vector<WlkView> all{scene.view};
    while (all.size() < views) {
      all.push_back(scene.addView(small()));
    }
    for (const WlkView view : all) {
      scene.view = view;
      scene.setCamera({0, 2, 0}, 0, 12);
      auto quality = make<WlkQuality>();
      quality.level = WLK_QUALITY_LOW;
      quality.lightFrames = FRAMES;
      check(wlkSetQuality(scene.context, view, &quality));
    }
    scene.addBall(0.01f);
    check(wlkPrepare(scene.context));
    scene.renderFrames(all);
    scene.setSun(31, 22);
    for (uint32_t frame = 1;; ++frame) {
      scene.renderFrames(all);
      uint32_t unchanged = 0;
      for (const WlkView view : all) {
        scene.view = view;
        for (const WlkPassStats& pass : scene.passes()) {
          if (pass.pass == WLK_PASS_VOLUME_LIGHT && pass.reason == WLK_REASON_UNCHANGED) {
            ++unchanged;
          }
        }
      }
      if (unchanged == views || frame > 4 * FRAMES) {
        return frame;
      }
    }
  };
  EXPECT_EQ(framesToRest(1), framesToRest(2));
}

}  // namespace
}  // namespace welkin::test
