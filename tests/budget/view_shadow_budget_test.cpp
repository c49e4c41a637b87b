// SPDX-License-Identifier: MIT
// The map by which volumes shade the air is recorded where light or volumes have changed, and
// nowhere else; without WLK_QUALITY_FLAG_VOLUME_SHADOWS there is none.
#include <gtest/gtest.h>

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

class ViewShadowBudget : public ::testing::Test {
 protected:
  ViewShadowBudget() : scene(small()) {
    scene.setSky();
    scene.setCamera({0, 2, 0}, 0, 12);
    scene.setSun(30, 20);
    scene.setQuality(WLK_QUALITY_LOW, WLK_QUALITY_FLAG_VOLUME_SHADOWS);
  }
  ~ViewShadowBudget() override {
    EXPECT_TRUE(scene.device().messages().empty()) << scene.device().messages().front();
  }
  // The map's line in a frame that is rendered now.
  WlkPassStats render() {
    const FrameCounts counts = scene.renderFrame();
    EXPECT_EQ(scene.stats().dispatches, counts.view.dispatches);
    EXPECT_EQ(scene.stats().barriers, counts.view.barriers);
    EXPECT_EQ(scene.stats().descriptorWrites, counts.view.descriptorWrites);
    EXPECT_EQ(scene.stats().nonFinitePixels, 0u);
    WlkPassStats found{};
    for (const WlkPassStats& pass : scene.passes()) {
      if (pass.pass == WLK_PASS_CLOUD_SHADOW) {
        EXPECT_STREQ(pass.name, "cloud shadow");
        found = pass;
      }
    }
    return found;
  }
  void expectPass(uint32_t reason, uint32_t commands, const char* after) {
    const WlkPassStats pass = render();
    EXPECT_EQ(pass.pass, uint32_t{WLK_PASS_CLOUD_SHADOW}) << after;
    EXPECT_STREQ(wlkReasonName(pass.reason), wlkReasonName(reason)) << after;
    EXPECT_EQ(pass.commands, commands) << after;
    EXPECT_EQ(pass.recorded, commands > 0 ? 1u : 0u) << after;
  }
  void fill(WlkVolume volume, float density) const {
    scene.upload(volume, {N, N, N}, std::vector<float>(size_t{N} * N * N, density));
  }

  EngineScene scene;
};

TEST_F(ViewShadowBudget, FollowsLightAndVolumesButNotTheCamera) {
  const WlkVolume volume = scene.addBall(0.01f);
  check(wlkPrepare(scene.context));
  expectPass(WLK_REASON_NEEDED, 2, "the first frame");
  for (int i = 0; i < WARM_UP + 3; ++i) {
    scene.setCamera({20.0 * i, 2, -10.0 * i}, 1.0 * i, 12);
    expectPass(WLK_REASON_UNCHANGED, 0, "the camera moved");
    if (i >= WARM_UP) {
      EXPECT_EQ(scene.stats().descriptorWrites, 0u) << i;
    }
  }
  scene.setCamera({0, 2, 0}, 180, 12);
  expectPass(WLK_REASON_UNCHANGED, 0, "the volume is behind the camera: its shadow may not be");
  scene.setSun(31, 20);
  expectPass(WLK_REASON_NEEDED, 2, "the sun rose");
  fill(volume, 0.5f);
  expectPass(WLK_REASON_NEEDED, 2, "an upload");
  fill(volume, 0.0f);
  expectPass(WLK_REASON_ZERO_DENSITY, 0, "an empty volume");
  fill(volume, 1.0f);
  expectPass(WLK_REASON_NEEDED, 2, "full again");
  scene.clearLights();
  expectPass(WLK_REASON_NO_LIGHT, 0, "night");
}

TEST_F(ViewShadowBudget, NothingWithoutVolumesOrTheFlag) {
  check(wlkPrepare(scene.context));
  EXPECT_EQ(render().commands, 0u) << "no volume";
  const uint32_t before = scene.stats().dispatches;
  scene.addBall(0.01f);
  scene.setQuality(WLK_QUALITY_LOW, 0);
  check(wlkPrepare(scene.context));
  EXPECT_EQ(render().pass, 0u) << "not asked for";
  EXPECT_GT(scene.stats().dispatches, before);
}

}  // namespace
}  // namespace welkin::test
