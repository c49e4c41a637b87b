// SPDX-License-Identifier: MIT
// WlkQuality::lightFrames: what a moving sun changes inside a volume is computed in even parts over
// frames, all of it once, and comes to rest at the light that is computed at once, bit by bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "stress/counting_allocator.hpp"
#include "support/engine_scene.hpp"
#include "support/library_allocations.hpp"

namespace welkin::test {
namespace {

constexpr int WARM_UP = 4;  // maxFramesInFlight + 1: every slot was recorded once
constexpr uint32_t FRAMES = 4;
constexpr uint32_t N = 8;  // voxels along an edge of the ball

SceneOptions small(const WlkAllocator& allocator = {}) {
  SceneOptions options;
  options.width = 24;
  options.height = 16;
  options.allocator = allocator;
  return options;
}

struct Sun {
  double elevation, azimuth;
};
constexpr Sun FIRST{30, 20};
constexpr Sun SECOND{31, 22};

class Scene : public EngineScene {
 public:
  explicit Scene(uint32_t lightFrames, const WlkAllocator& allocator = {}, uint64_t flags = 0)
      : EngineScene(small(allocator)), lightFrames_(lightFrames) {
    setCamera({0, 2, 0}, 0, 12);
    shine(FIRST);
    setQualityOf(view, lightFrames, flags);
  }
  ~Scene() { EXPECT_TRUE(device().messages().empty()) << device().messages().front(); }
  void setQualityOf(WlkView of, uint32_t lightFrames, uint64_t flags = 0) const {
    auto quality = make<WlkQuality>();
    quality.level = WLK_QUALITY_LOW;
    quality.scattering = WLK_SCATTERING_ALL_ORDERS;
    quality.lightFrames = lightFrames;
    quality.flags = flags;
    check(wlkSetQuality(context, of, &quality));
  }
  void shine(const Sun& sun) const { setSun(sun.elevation, sun.azimuth); }
  // Of the volume's light in a frame.
  WlkPassStats frame() {
    renderFrame();
    EXPECT_EQ(stats().nonFinitePixels, 0u);
    return light()[0];
  }
  std::vector<WlkPassStats> light() const {
    std::vector<WlkPassStats> found;
    for (const WlkPassStats& pass : passes()) {
      if (pass.pass == WLK_PASS_VOLUME_LIGHT) {
        found.push_back(pass);
      }
    }
    EXPECT_FALSE(found.empty());
    return found;
  }
  void rest() {
    for (uint32_t i = 0; i < 3 * lightFrames_; ++i) {
      renderFrame();
    }
  }

 private:
  uint32_t lightFrames_;
};

// The picture with all light computed at once.
Image atOnce(const Sun& sun, float density = 1) {
  Scene scene(1);
  const WlkVolume ball = scene.addBall(0.01f);
  scene.upload(ball, {N, N, N}, std::vector<float>(size_t{N} * N * N, density));
  scene.shine(sun);
  check(wlkPrepare(scene.context));
  scene.frame();
  return scene.read();
}

void fill(const Scene& scene, WlkVolume volume, float density = 1) {
  scene.upload(volume, {N, N, N}, std::vector<float>(size_t{N} * N * N, density));
}

TEST(LightSpread, ComputesAllOfItOnceInEvenParts) {
  for (const uint32_t frames : {2u, 5u, 16u, 64u}) {
    SCOPED_TRACE(frames);
    Scene scene(frames);
    fill(scene, scene.addBall(0.01f));
    check(wlkPrepare(scene.context));
    const WlkPassStats whole = scene.frame();
    EXPECT_STREQ(wlkReasonName(whole.reason), "WLK_REASON_NEEDED") << "the first light at once";
    const WlkPassStats kept = scene.frame();
    EXPECT_STREQ(wlkReasonName(kept.reason), "WLK_REASON_UNCHANGED");
    EXPECT_EQ(kept.commands, 1u) << "shown";
    scene.shine(SECOND);
    uint64_t sum = 0;
    uint32_t commands = 0;
    for (uint32_t i = 0; i < frames; ++i) {
      const WlkPassStats part = scene.frame();
      EXPECT_STREQ(wlkReasonName(part.reason), "WLK_REASON_SPREAD") << i;
      const uint32_t shown = i + 1 < frames ? 1 : 2;  // in the last frame the fade begins
      EXPECT_GT(part.commands, shown) << "no frame has nothing to do";
      EXPECT_LT(part.commands, whole.commands);
      sum += part.invocations - shown * kept.invocations;
      commands += part.commands - shown;
    }
    EXPECT_EQ(sum, whole.invocations - kept.invocations);
    // A step that parts share is a command of each.
    EXPECT_GE(commands, whole.commands - 1);
    EXPECT_LE(commands, whole.commands - 1 + frames);
    for (uint32_t i = 1; i < frames; ++i) {
      const WlkPassStats fading = scene.frame();
      EXPECT_EQ(fading.commands, i + 1 < frames ? 2u : 1u) << i;
    }
    EXPECT_STREQ(wlkReasonName(scene.frame().reason), "WLK_REASON_UNCHANGED");
  }
}

TEST(LightSpread, ComesToRestAtTheLightComputedAtOnceBitByBit) {
  const Image wanted = atOnce(SECOND);
  for (const uint32_t frames : {2u, 3u, 5u, 17u}) {
    Scene scene(frames);
    fill(scene, scene.addBall(0.01f));
    check(wlkPrepare(scene.context));
    scene.frame();
    const Image first = scene.read();
    EXPECT_FALSE(first == wanted);
    for (uint32_t i = 0; i < frames + 1; ++i) {  // stops while the next light is in work
      const double part = static_cast<double>(i) / frames;
      scene.shine({FIRST.elevation + part, FIRST.azimuth + part});
      scene.frame();
    }
    scene.shine(SECOND);
    scene.rest();
    EXPECT_EQ(scene.frame().commands, 1u);
    EXPECT_TRUE(scene.read() == wanted) << frames;
  }
}

TEST(LightSpread, MakesNothingInSteadyFramesUnderAMovingSun) {
  CountingAllocator memory;
  Scene scene(3, memory.callbacks());
  fill(scene, scene.addBall(0.01f));
  check(wlkPrepare(scene.context));
  // Each of three grids in each of the slots: 3 * 3 frames and those of the first light.
  constexpr int ALL_SETS = WARM_UP + 4 * 9;
  for (int i = 0; i < ALL_SETS + 9; ++i) {
    scene.shine({30 + 0.1 * i, 20});
    const uint64_t before = memory.calls() + libraryAllocations();
    const FrameCounts counts = scene.renderFrame();
    if (i < ALL_SETS) {
      continue;
    }
    EXPECT_EQ(counts.view.created + counts.view.allocated + counts.view.descriptorWrites, 0u) << i;
    EXPECT_EQ(memory.calls() + libraryAllocations(), before) << i;
  }
}

TEST(LightSpread, WhatIsNoLongerOfUseIsComputedAtOnceAlsoInTheMiddleOfWork) {
  const Sun far{SECOND.elevation + 5.1, SECOND.azimuth};
  const auto thinner = atOnce(SECOND, 0.5f);
  const auto turned = atOnce(far);
  for (uint32_t middle = 0; middle <= 2 * FRAMES; ++middle) {
    SCOPED_TRACE(middle);
    Scene scene(FRAMES);
    const WlkVolume ball = scene.addBall(0.01f);
    fill(scene, ball);
    check(wlkPrepare(scene.context));
    scene.frame();
    scene.shine(SECOND);
    for (uint32_t i = 0; i < middle; ++i) {
      scene.frame();
    }
    if (middle % 2 == 0) {
      fill(scene, ball, 0.5f);
      EXPECT_STREQ(wlkReasonName(scene.frame().reason), "WLK_REASON_NEEDED");
      EXPECT_TRUE(scene.read() == thinner);
    } else {
      scene.shine(far);
      EXPECT_STREQ(wlkReasonName(scene.frame().reason), "WLK_REASON_NEEDED");
      EXPECT_TRUE(scene.read() == turned);
    }
    EXPECT_STREQ(wlkReasonName(scene.frame().reason), "WLK_REASON_UNCHANGED");
  }
}

// Volumes after a destroyed one take other places in the view's lists.
TEST(LightSpread, OutlivesAVolumeThatIsDestroyedInTheMiddleOfWork) {
  Scene scene(FRAMES);
  const WlkVolume other = scene.addBall(0.02f);
  fill(scene, other);
  fill(scene, scene.addBall(0.01f));
  check(wlkPrepare(scene.context));
  scene.frame();
  scene.shine(SECOND);
  scene.frame();
  scene.frame();
  check(wlkDestroyVolume(scene.context, other));
  scene.rest();
  EXPECT_TRUE(scene.read() == atOnce(SECOND));
}

// Parts count frames in which the volume is drawn.
TEST(LightSpread, GoesOnWhereTheVolumeWasOutOfViewForAWhile) {
  Scene scene(FRAMES);
  fill(scene, scene.addBall(0.01f));
  check(wlkPrepare(scene.context));
  scene.frame();
  scene.shine(SECOND);
  scene.frame();
  scene.setCamera({0, 2, 0}, 180, 12);
  EXPECT_EQ(scene.frame().commands, 0u);
  scene.frame();
  scene.setCamera({0, 2, 0}, 0, 12);
  EXPECT_STREQ(wlkReasonName(scene.frame().reason), "WLK_REASON_SPREAD");
  scene.rest();
  EXPECT_TRUE(scene.read() == atOnce(SECOND));
}

TEST(LightSpread, OfAnImageOfTheEnginesIsRenewedAllTheTime) {
  Scene scene(FRAMES);
  const WlkVolume ball = scene.addBall(0.01f);
  fill(scene, ball);
  check(wlkPrepare(scene.context));
  scene.frame();
  const SpyImage image(scene.device(), VK_FORMAT_R32_SFLOAT, {N, N, N},
                       VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT);
  const WlkVulkanImage described = scene.describe(image, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  check(wlkVulkanSetVolumeImage(scene.context, ball, 0, &described));
  const std::vector<float> thin(size_t{N} * N * N, 0.25f);
  std::copy(thin.begin(), thin.end(), reinterpret_cast<float*>(image.bytes()));
  image.write(VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  EXPECT_STREQ(wlkReasonName(scene.frame().reason), "WLK_REASON_NEEDED") << "another image";
  for (uint32_t i = 0; i < 3 * FRAMES; ++i) {
    EXPECT_STREQ(wlkReasonName(scene.frame().reason), "WLK_REASON_SPREAD") << i;
  }
  check(wlkVulkanSetVolumeImage(scene.context, ball, 0, nullptr));
  EXPECT_STREQ(wlkReasonName(scene.frame().reason), "WLK_REASON_NEEDED") << "the upload is back";
  EXPECT_TRUE(scene.read() == atOnce(FIRST));
  check(wlkVulkanForgetImage(scene.context, image.handle));
}

TEST(LightSpread, WithoutSkippingNothingIsSpread) {
  Scene scene(FRAMES, {}, WLK_QUALITY_FLAG_NO_SKIP);
  fill(scene, scene.addBall(0.01f));
  check(wlkPrepare(scene.context));
  scene.frame();
  scene.shine(SECOND);
  EXPECT_GE(scene.frame().commands, 100u);
  EXPECT_TRUE(scene.read() == atOnce(SECOND));
}

}  // namespace
}  // namespace welkin::test
