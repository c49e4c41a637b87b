// SPDX-License-Identifier: MIT
// WLK_SCATTERING_ALL_ORDERS computes the light inside a volume where it may have changed, and
// nowhere else: exact counts of commands.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "support/engine_scene.hpp"

namespace welkin::test {
namespace {

constexpr int WARM_UP = 4;  // maxFramesInFlight + 1: every slot was recorded once
constexpr uint32_t SHOWN = 1;
// Several hundred: rounds over all levels of the grid.
constexpr uint32_t COMPUTED_AT_LEAST = 100;
constexpr uint32_t N = 8;  // voxels along an edge of the ball

SceneOptions small() {
  SceneOptions options;
  options.width = 24;
  options.height = 16;
  return options;
}

// Differences that say where to look: one pixel or all, last bits or everything.
void expectSame(const Image& picture, const Image& wanted, const char* when) {
  ASSERT_EQ(picture.rgba.size(), wanted.rgba.size());
  size_t count = 0;
  float most = 0;
  for (size_t i = 0; i < wanted.rgba.size(); ++i) {
    const float difference = std::abs(picture.rgba[i] - wanted.rgba[i]);
    count += picture.rgba[i] == wanted.rgba[i] ? 0U : 1U;
    most = std::max(most, difference);
  }
  EXPECT_EQ(count, 0u) << when << ": values of " << wanted.rgba.size() << " differ, by " << most
                       << " at most";
}

class VolumeLightBudget : public ::testing::Test {
 protected:
  VolumeLightBudget() : scene(small()) {
    scene.setCamera({0, 2, 0}, 0, 12);
    scene.setSun(30, 20);
    setQuality(0);
  }
  ~VolumeLightBudget() override {
    EXPECT_TRUE(scene.device().messages().empty()) << scene.device().messages().front();
  }

  void setQuality(uint64_t flags) const {
    auto quality = make<WlkQuality>();
    quality.level = WLK_QUALITY_LOW;
    quality.scattering = WLK_SCATTERING_ALL_ORDERS;
    quality.flags = flags;
    check(wlkSetQuality(scene.context, scene.view, &quality));
  }
  void prepare() const { check(wlkPrepare(scene.context)); }

  // Of the volume's light in the frame that was rendered last.
  std::vector<WlkPassStats> light() const {
    std::vector<WlkPassStats> found;
    for (const WlkPassStats& pass : scene.passes()) {
      if (pass.pass == WLK_PASS_VOLUME_LIGHT) {
        EXPECT_STREQ(pass.name, "volume light");
        found.push_back(pass);
      }
    }
    return found;
  }
  FrameCounts render() {
    const FrameCounts counts = scene.renderFrame();
    EXPECT_EQ(scene.stats().dispatches, counts.view.dispatches);
    EXPECT_EQ(scene.stats().barriers, counts.view.barriers);
    EXPECT_EQ(scene.stats().nonFinitePixels, 0u);
    return counts;
  }
  void expectKept(const char* after) {
    render();
    ASSERT_EQ(light().size(), 1u) << after;
    EXPECT_STREQ(wlkReasonName(light()[0].reason), "WLK_REASON_UNCHANGED") << after;
    EXPECT_EQ(light()[0].commands, SHOWN) << after;
    EXPECT_EQ(light()[0].recorded, 1u) << after;
    EXPECT_GT(light()[0].invocations, 0u) << after;
  }
  void expectComputed(const char* after) {
    render();
    ASSERT_EQ(light().size(), 1u) << after;
    EXPECT_STREQ(wlkReasonName(light()[0].reason), "WLK_REASON_NEEDED") << after;
    EXPECT_GE(light()[0].commands, COMPUTED_AT_LEAST) << after;
  }
  void expectNone(uint32_t reason) {
    render();
    ASSERT_EQ(light().size(), 1u);
    EXPECT_STREQ(wlkReasonName(light()[0].reason), wlkReasonName(reason));
    EXPECT_EQ(light()[0].commands, 0u);
    EXPECT_EQ(light()[0].recorded, 0u);
  }

  // An image of the engine for the ball, all of its voxels of one density.
  void fill(const SpyImage& image, float density) const {
    const std::vector<float> values(size_t{N} * N * N, density);
    std::memcpy(image.bytes(), values.data(), values.size() * sizeof(float));
    image.write(VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  }

  EngineScene scene;
};

TEST_F(VolumeLightBudget, KeepsWhatHasNotChangedAndWritesNoDescriptor) {
  scene.addBall(0.01f);
  prepare();
  expectComputed("the first frame");
  for (int i = 0; i < WARM_UP + 4; ++i) {
    scene.setCamera({20.0 * i, 2, -10.0 * i}, 1.0 * i, 12);
    expectKept("the camera moved");
    if (i >= WARM_UP) {
      EXPECT_EQ(scene.stats().descriptorWrites, 0u) << i;
    }
  }
}

TEST_F(VolumeLightBudget, ComputesAnewWhatSunOrFieldsHaveChanged) {
  const WlkVolume volume = scene.addBall(0.01f);
  prepare();
  expectComputed("the first frame");
  expectKept("nothing");
  scene.setSun(30.01, 20);
  expectComputed("the sun rose");
  expectKept("nothing");
  scene.upload(volume, {N, N, N}, std::vector<float>(size_t{N} * N * N, 0.5f));
  expectComputed("an upload");
  expectKept("nothing");
  const auto longer = boxTransform({-1000, 500, -6000}, {2000, 2000, 2100});
  ASSERT_EQ(wlkSetVolumeTransform(scene.context, volume, longer.data()), WLK_SUCCESS);
  expectComputed("the box grew");
  const auto moved = boxTransform({-900, 510, -6100}, {2000, 2000, 2100});
  ASSERT_EQ(wlkSetVolumeTransform(scene.context, volume, moved.data()), WLK_SUCCESS);
  expectKept("the box moved as it is");
}

TEST_F(VolumeLightBudget, ADescriptorIsWrittenInNoSteadyFrameThatComputes) {
  scene.addBall(0.01f);
  prepare();
  uint32_t commands = 0;
  for (int i = 0; i < WARM_UP + 3; ++i) {
    scene.setSun(30.0 + i, 20);
    expectComputed("the sun rose");
    EXPECT_TRUE(i == 0 || light()[0].commands == commands) << "another number of commands";
    commands = light()[0].commands;
    if (i >= WARM_UP) {
      EXPECT_EQ(scene.stats().descriptorWrites, 0u) << i;
    }
  }
}

TEST_F(VolumeLightBudget, NothingIsComputedWithoutDensityLightOrView) {
  const WlkVolume volume = scene.addBall(0.01f);
  prepare();
  expectComputed("the first frame");
  scene.upload(volume, {N, N, N}, std::vector<float>(size_t{N} * N * N, 0.0f));
  expectNone(WLK_REASON_ZERO_DENSITY);
  scene.upload(volume, {N, N, N}, std::vector<float>(size_t{N} * N * N, 1.0f));
  scene.setCamera({0, 2, 0}, 180, 12);
  expectNone(WLK_REASON_OUTSIDE_VIEW);
  scene.clearLights();
  scene.setCamera({0, 2, 0}, 0, 12);
  expectNone(WLK_REASON_NO_LIGHT);
  scene.setSun(30, 20);
  expectComputed("what changed while it was away");
}

TEST_F(VolumeLightBudget, WithoutSkippingComputesEachFrameTheSamePicture) {
  scene.addBall(0.01f);
  prepare();
  expectComputed("the first frame");
  const Image computed = scene.read();
  expectKept("nothing");
  expectSame(scene.read(), computed, "kept");
  setQuality(WLK_QUALITY_FLAG_NO_SKIP);
  prepare();
  for (int i = 0; i < 2; ++i) {
    render();
    ASSERT_EQ(light().size(), 1u);
    EXPECT_NE(light()[0].reason, uint32_t{WLK_REASON_UNCHANGED});
    EXPECT_GE(light()[0].commands, COMPUTED_AT_LEAST);
    expectSame(scene.read(), computed, i == 0 ? "computed anew" : "computed anew again");
  }
}

// The engine may write its image at any time, and Welkin does not see it.
TEST_F(VolumeLightBudget, AnImageOfTheEnginesIsComputedEachFrame) {
  const WlkVolume volume = scene.addBall(0.01f);
  // To the faces: an image of the engine's may hold anything everywhere.
  scene.upload(volume, {N, N, N}, std::vector<float>(size_t{N} * N * N, 0.5f));
  prepare();
  expectComputed("the first frame");
  const Image uploaded = scene.read();
  const SpyImage image(scene.device(), VK_FORMAT_R32_SFLOAT, {N, N, N},
                       VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT);
  const WlkVulkanImage described = scene.describe(image, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  ASSERT_EQ(wlkVulkanSetVolumeImage(scene.context, volume, 0, &described), WLK_SUCCESS);
  fill(image, 0.2f);
  expectComputed("the image");
  const Image thin = scene.read();
  fill(image, 1.0f);
  expectComputed("the image was written");
  EXPECT_FALSE(scene.read() == thin);
  ASSERT_EQ(wlkVulkanSetVolumeImage(scene.context, volume, 0, nullptr), WLK_SUCCESS);
  expectComputed("the uploaded field is back");
  EXPECT_TRUE(scene.read() == uploaded);
  check(wlkVulkanForgetImage(scene.context, image.handle));
}

// Each has a grid of its own.
TEST_F(VolumeLightBudget, OfTwoVolumesOnlyTheOneThatChangedIsComputed) {
  const WlkVolume left = scene.addBall(0.01f);
  const WlkVolume right = scene.addBall(0.01f);
  const auto beside = boxTransform({1100, 500, -6000}, {1000, 1000, 1000});
  ASSERT_EQ(wlkSetVolumeTransform(scene.context, right, beside.data()), WLK_SUCCESS);
  prepare();
  render();
  scene.upload(left, {N, N, N}, std::vector<float>(size_t{N} * N * N, 0.5f));
  render();
  ASSERT_EQ(light().size(), 2u);
  for (const WlkPassStats& pass : light()) {
    EXPECT_STREQ(wlkReasonName(pass.reason),
                 pass.volume.id == left.id ? "WLK_REASON_NEEDED" : "WLK_REASON_UNCHANGED");
  }
  // Which of them is nearer does not matter to either.
  const auto nearer = boxTransform({550, 250, -3000}, {1000, 1000, 1000});
  ASSERT_EQ(wlkSetVolumeTransform(scene.context, right, nearer.data()), WLK_SUCCESS);
  render();
  ASSERT_EQ(light().size(), 2u);
  for (const WlkPassStats& pass : light()) {
    EXPECT_STREQ(wlkReasonName(pass.reason), "WLK_REASON_UNCHANGED");
  }
}

}  // namespace
}  // namespace welkin::test
