// SPDX-License-Identifier: MIT
// The engine's shadow map costs nothing where none is given, or nothing would show it; given, two
// layout changes and, when it is another image, a descriptor.
#include <gtest/gtest.h>

#include <cstring>

#include "support/engine_scene.hpp"
#include "support/light_shadow.hpp"

namespace welkin::test {
namespace {

constexpr int WARM_UP = 4;  // maxFramesInFlight + 1: every slot was recorded once
constexpr uint32_t TEXELS = 16;

class LightShadowBudget : public ::testing::Test {
 protected:
  static SceneOptions options() {
    SceneOptions o;
    o.width = 24;
    o.height = 16;
    return o;
  }
  LightShadowBudget()
      : scene(options()),
        texels(scene.device(), VK_FORMAT_R32_SFLOAT, {TEXELS, TEXELS, 1},
               VK_IMAGE_USAGE_SAMPLED_BIT),
        map(scene.describe(texels, VK_IMAGE_LAYOUT_GENERAL)) {
    std::memset(texels.bytes(), 0, size_t{4} * TEXELS * TEXELS);
    texels.write(VK_IMAGE_LAYOUT_GENERAL);
    const LightFrame all({0, 0, 0}, 5000, directionTo(30, 20));
    all.write({0, 0, 0}, false, shadow.clipFromWorld[0]);
    scene.setSky();
    scene.setCamera({0, 2, 0}, 0, 12);
    scene.setSun(30, 20);
    scene.setQuality(WLK_QUALITY_LOW, WLK_QUALITY_FLAG_LIGHT_SHADOWS);
    check(wlkPrepare(scene.context));
  }
  ~LightShadowBudget() override {
    EXPECT_TRUE(scene.device().messages().empty()) << scene.device().messages().front();
    check(wlkVulkanForgetImage(scene.context, texels.handle));
  }
  void give(bool given) {
    scene.lightShadow = given ? &shadow : nullptr;
    scene.shadowMap = given ? &map : nullptr;
  }
  // Of a steady frame.
  VulkanCounts steady() {
    VulkanCounts counts;
    for (int i = 0; i <= WARM_UP; ++i) {
      counts = scene.renderFrame().view;
      EXPECT_EQ(scene.stats().barriers, counts.barriers);
      EXPECT_EQ(scene.stats().descriptorWrites, counts.descriptorWrites);
      EXPECT_EQ(scene.stats().nonFinitePixels, 0u);
    }
    EXPECT_EQ(counts.descriptorWrites, 0u);
    EXPECT_EQ(counts.created + counts.allocated, 0u);
    return counts;
  }

  EngineScene scene;
  SpyImage texels;
  WlkVulkanImage map;
  WlkLightShadow shadow = make<WlkLightShadow>();
};

TEST_F(LightShadowBudget, NothingWhereNoneIsGiven) {
  std::array<uint64_t, 3> first{};
  Image picture;
  for (const uint64_t flags : {uint64_t{WLK_QUALITY_FLAG_LIGHT_SHADOWS}, uint64_t{0}}) {
    scene.setQuality(WLK_QUALITY_LOW, flags);
    check(wlkPrepare(scene.context));
    const VulkanCounts fresh = scene.renderFrame().view;
    const VulkanCounts later = steady();
    EXPECT_EQ(later.dispatches, 1u);  // the composite; the sky's table is unchanged
    const std::array<uint64_t, 3> counts{fresh.descriptorWrites, fresh.barriers, later.barriers};
    if (flags != 0) {
      first = counts;
      picture = scene.read();
    } else {
      EXPECT_EQ(counts, first);
      EXPECT_TRUE(scene.read() == picture);
    }
  }
}

TEST_F(LightShadowBudget, TwoLayoutChangesWhereOneIsRead) {
  const VulkanCounts without = steady();
  const Image lit = scene.read();
  give(true);
  const VulkanCounts with = steady();
  EXPECT_EQ(with.dispatches, without.dispatches);
  EXPECT_EQ(with.barriers, without.barriers + 2);
  EXPECT_LT(scene.read().mean(), 0.999 * lit.mean());
  give(false);
  EXPECT_EQ(scene.renderFrame().view.descriptorWrites, 1u) << "of this frame's slot";
  EXPECT_TRUE(scene.read() == lit);
}

TEST_F(LightShadowBudget, NothingWhereNothingWouldShowIt) {
  scene.clearLights();
  const VulkanCounts night = steady();
  give(true);
  EXPECT_EQ(steady().barriers, night.barriers) << "no light";
  give(false);
  scene.setSun(30, 20);
  const VulkanCounts without = steady();
  give(true);
  shadow.light = 1;
  EXPECT_EQ(steady().barriers, without.barriers) << "of another light";
  map.after.layout = VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL;
  EXPECT_EQ(scene.renderFrame().view.barriers, without.barriers + 1) << "to its state afterwards";
}

}  // namespace
}  // namespace welkin::test
