// SPDX-License-Identifier: MIT
// Calls that do not fit: the right error, no command recorded, and the next frame works.
#include <gtest/gtest.h>

#include "engine.hpp"
#include "picture.hpp"

namespace {

using namespace engine;
using welkin::check;
using welkin::make;

constexpr VkExtent2D EXTENT{16, 16};
constexpr VkFormat COLOR = VK_FORMAT_R16G16B16A16_SFLOAT;

class EngineStates : public testing::Test {
 protected:
  EngineStates()
      : view_(engine_.makeView(EXTENT, WLK_COMPOSITE_COMPUTE, COLOR)),
        image_(engine_.device(), COLOR, {EXTENT.width, EXTENT.height, 1},
               VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_STORAGE_BIT),
        commands_(engine_.device().begin()),
        color_(image_.imported(UNDEFINED, COPY_SOURCE)) {}

  ~EngineStates() override {
    // What was recorded must run: the layer checks it.
    engine_.device().submit(commands_);
    engine_.device().wait();
    check(wlkVulkanForgetImage(engine_.context(), image_.handle()));
  }

  WlkResult renderView() {
    auto targets = make<WlkVulkanViewTargets>();
    targets.color = &color_;
    return wlkVulkanCmdRenderView(engine_.context(), commands_, view_, &targets);
  }
  WlkResult update() { return wlkVulkanCmdUpdate(engine_.context(), commands_); }

  static std::string field() {
    auto info = make<WlkErrorInfo>();
    check(wlkGetLastError(&info));
    return info.field;
  }

  Engine engine_;
  welkin::View view_;
  Image image_;
  VkCommandBuffer commands_;
  WlkVulkanImage color_;
};

TEST_F(EngineStates, RecordingNeedsAFrame) {
  EXPECT_EQ(update(), WLK_ERROR_WRONG_STATE);
  EXPECT_EQ(renderView(), WLK_ERROR_WRONG_STATE);
}

TEST_F(EngineStates, ViewsNeedTheFramesUpdate) {
  check(engine_.beginFrame(1, 0));
  EXPECT_EQ(renderView(), WLK_ERROR_WRONG_STATE);
  EXPECT_EQ(update(), WLK_SUCCESS);
  EXPECT_EQ(renderView(), WLK_SUCCESS);
}

// Without the update the second volume's table would be read before it is written.
TEST_F(EngineStates, ViewsNeedTheUpdateOfTheirOwnFrame) {
  check(engine_.beginFrame(1, 0));
  check(update());
  auto medium = welkin::Medium(engine_.context(), make<WlkMediumInfo>());
  WlkVolumeField field{};
  field.medium = medium;
  field.extinctionScale = 0.1f;
  auto info = make<WlkVolumeInfo>();
  info.fieldCount = 1;
  info.fields = &field;
  std::fill(std::begin(info.size), std::end(info.size), CLOUD_SIZE);
  const welkin::Volume second(engine_.context(), info);
  uploadCloud(engine_.context(), second, cloudValues());
  check(wlkPrepare(engine_.context()));
  check(engine_.beginFrame(2, 0));  // one command buffer: frame 1 is not complete
  EXPECT_EQ(renderView(), WLK_ERROR_WRONG_STATE);
  check(update());
  EXPECT_EQ(renderView(), WLK_SUCCESS);
}

TEST_F(EngineStates, ViewIsRecordedOncePerFrame) {
  check(engine_.beginFrame(1, 0));
  check(update());
  EXPECT_EQ(renderView(), WLK_SUCCESS);
  EXPECT_EQ(renderView(), WLK_ERROR_WRONG_STATE);
  check(engine_.beginFrame(2, 0));  // one command buffer: frame 1 is not complete
  check(update());
  EXPECT_EQ(renderView(), WLK_SUCCESS);
}

TEST_F(EngineStates, ChangedViewNeedsPrepare) {
  check(engine_.beginFrame(1, 0));
  check(update());
  setQuality(engine_.context(), view_);
  EXPECT_EQ(renderView(), WLK_ERROR_NOT_PREPARED);
  check(wlkPrepare(engine_.context()));
  EXPECT_EQ(renderView(), WLK_SUCCESS);
}

TEST_F(EngineStates, ImagesThatDoNotFitAreNamed) {
  check(engine_.beginFrame(1, 0));
  check(update());
  const WlkVulkanImage good = color_;
  color_.width = 17;
  EXPECT_EQ(renderView(), WLK_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(field(), "color");
  color_ = good;
  color_.format = VK_FORMAT_R32G32B32A32_SFLOAT;
  EXPECT_EQ(renderView(), WLK_ERROR_UNSUPPORTED_FORMAT);
  EXPECT_EQ(field(), "color");
  color_ = good;
  color_.after.layout = VK_IMAGE_LAYOUT_UNDEFINED;
  EXPECT_EQ(renderView(), WLK_ERROR_INVALID_ARGUMENT);
  color_ = good;
  color_.image = VK_NULL_HANDLE;
  EXPECT_EQ(renderView(), WLK_ERROR_INVALID_ARGUMENT);
  color_ = good;
  EXPECT_EQ(renderView(), WLK_SUCCESS);
}

TEST_F(EngineStates, BlendNeedsTheFeature) {
  WlkVulkanDeviceInfo device = engine_.device().info();
  device.enabledFeatures = 0;
  auto info = make<WlkContextInfo>();
  info.next = &device;
  const welkin::Context context(info);
  auto capabilities = make<WlkCapabilities>();
  check(wlkGetCapabilities(context, &capabilities));
  EXPECT_EQ(capabilities.mode, static_cast<uint32_t>(WLK_MODE_ENGINE_DEVICE));
  EXPECT_EQ(capabilities.blendSupported, 0u);
  auto view = make<WlkViewInfo>();
  view.composite = WLK_COMPOSITE_BLEND;
  WlkView handle{};
  EXPECT_EQ(wlkCreateView(context, &view, &handle), WLK_ERROR_MISSING_FEATURE);
}

TEST(EngineModes, EngineCallsAreRefusedInOtherModes) {
  const auto headless = make<WlkHeadlessInfo>();
  auto info = make<WlkContextInfo>();
  const welkin::Context cpu(info);
  info.next = &headless;
  const welkin::Context own(info);
  const Scene scene = makeScene(own);
  const Device device;
  const Image volume(device, VK_FORMAT_R16_SFLOAT, {CLOUD_SIZE, CLOUD_SIZE, CLOUD_SIZE},
                     VK_IMAGE_USAGE_SAMPLED_BIT);
  constexpr WlkVulkanImageState sampled{VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, 0,
                                        VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                                        VK_ACCESS_2_SHADER_SAMPLED_READ_BIT};
  const WlkVulkanImage image = volume.imported(sampled, sampled);
  const auto frame = make<WlkFrameInfo>();
  // Another device's image must not reach the headless one.
  EXPECT_EQ(wlkVulkanSetVolumeImage(own, scene.cloud, 0, &image), WLK_ERROR_WRONG_STATE);
  EXPECT_EQ(wlkBeginFrame(own, &frame), WLK_ERROR_WRONG_STATE);
  EXPECT_EQ(wlkBeginFrame(cpu, &frame), WLK_ERROR_WRONG_STATE);
  EXPECT_EQ(wlkVulkanForgetImage(cpu, volume.handle()), WLK_ERROR_WRONG_STATE);
}

}  // namespace
