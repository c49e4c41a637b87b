// SPDX-License-Identifier: MIT
// Image states before and after: what the validation layer checks, in every combination.
#include <gtest/gtest.h>

#include <cstring>

#include "codec.hpp"
#include "engine.hpp"
#include "picture.hpp"

namespace {

using namespace engine;
using welkin::check;
using welkin::make;

constexpr VkExtent2D EXTENT{16, 16};
constexpr VkFormat COLOR = VK_FORMAT_R16G16B16A16_SFLOAT;

constexpr WlkVulkanImageState GENERAL{VK_IMAGE_LAYOUT_GENERAL, 0,
                                      VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                                      VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT};
constexpr WlkVulkanImageState SAMPLED{VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, 0,
                                      VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
                                      VK_ACCESS_2_SHADER_SAMPLED_READ_BIT};
constexpr WlkVulkanImageState ATTACHMENT{
    VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, 0, VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
    VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT};
constexpr WlkVulkanImageState DEPTH_ATTACHMENT{
    VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL, 0,
    VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT};
constexpr WlkVulkanImageState DEPTH_READ{VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL, 0,
                                         VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT,
                                         VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT};

// Renders with the images taken over in `before` and handed on in `after`; the layer objects at
// submission if an image is in another layout than the engine's next barrier says.
void renderThrough(Engine& engine, WlkView view, uint32_t composite, uint64_t frame,
                   const std::array<WlkVulkanImageState, 2>& color,
                   const std::array<WlkVulkanImageState, 2>& depth) {
  const Image colorImage(engine.device(), COLOR, {EXTENT.width, EXTENT.height, 1},
                         VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_STORAGE_BIT |
                             VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT);
  const Image depthImage(engine.device(), VK_FORMAT_D32_SFLOAT_S8_UINT,
                         {EXTENT.width, EXTENT.height, 1},
                         VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT);
  check(engine.beginFrame(frame, frame - 1));
  VkCommandBuffer commands = engine.device().begin();
  check(wlkVulkanCmdUpdate(engine.context(), commands));
  if (color[0].layout != VK_IMAGE_LAYOUT_UNDEFINED) {
    colorImage.transition(commands, UNDEFINED, color[0]);
  }
  depthImage.transition(commands, UNDEFINED, depth[0]);
  const WlkVulkanImage colorTarget = colorImage.imported(color[0], color[1]);
  const WlkVulkanImage depthTarget = depthImage.imported(depth[0], depth[1]);
  auto targets = make<WlkVulkanViewTargets>();
  targets.depth = &depthTarget;
  targets.color = &colorTarget;
  targets.colorInput =
      composite == WLK_COMPOSITE_COMPUTE && color[0].layout != VK_IMAGE_LAYOUT_UNDEFINED
          ? &colorTarget
          : nullptr;
  check(wlkVulkanCmdRenderView(engine.context(), commands, view, &targets));
  colorImage.transition(commands, color[1], COPY_SOURCE);
  depthImage.transition(commands, depth[1], COPY_SOURCE);
  engine.device().submit(commands);
  engine.device().wait();
  check(wlkVulkanForgetImage(engine.context(), colorImage.handle()));
  check(wlkVulkanForgetImage(engine.context(), depthImage.handle()));
}

void renderEveryPair(Engine& engine, uint64_t frame) {
  constexpr std::array colorStates{UNDEFINED, GENERAL, SAMPLED, ATTACHMENT, COPY_TARGET};
  constexpr std::array depthStates{GENERAL, DEPTH_ATTACHMENT, DEPTH_READ, SAMPLED};
  for (const uint32_t composite : {WLK_COMPOSITE_COMPUTE, WLK_COMPOSITE_BLEND}) {
    const welkin::View view = engine.makeView(EXTENT, composite, COLOR);
    for (const WlkVulkanImageState& from : colorStates) {
      for (size_t to = 1; to < colorStates.size(); ++to) {
        const WlkVulkanImageState& depthTo = depthStates[to - 1];
        const WlkVulkanImageState& depthFrom = depthStates[to % depthStates.size()];
        renderThrough(engine, view, composite, ++frame, {from, colorStates[to]},
                      {depthFrom, depthTo});
      }
    }
  }
}

TEST(EngineLayouts, EveryStateBeforeAndAfterIsHonoured) {
  Engine engine;
  renderEveryPair(engine, 0);
}

TEST(EngineLayouts, ImagesReachTheirStatesWhenNothingIsDrawn) {
  Engine engine;
  check(wlkSetSky(engine.context(), nullptr));
  check(wlkSetFog(engine.context(), nullptr));
  WlkVolume cloud = engine.cloud();
  constexpr std::array<double, 12> away{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 1e6};  // behind the camera
  check(wlkSetVolumeTransform(engine.context(), cloud, away.data()));
  renderEveryPair(engine, 0);
}

TEST(EngineLayouts, PictureStaysWhenNothingIsDrawn) {
  Engine engine;
  check(wlkSetSky(engine.context(), nullptr));
  check(wlkSetFog(engine.context(), nullptr));
  constexpr std::array<double, 12> away{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 1e6};
  check(wlkSetVolumeTransform(engine.context(), engine.cloud(), away.data()));
  const EnginePicture picture = makeEnginePicture(EXTENT.width, EXTENT.height, CAMERAS[0]);
  const std::vector<float> color = quantised(COLOR, picture.color);
  for (const bool inPlace : {true, false}) {
    for (const uint32_t composite :
         {WLK_COMPOSITE_COMPUTE, WLK_COMPOSITE_BLEND, WLK_COMPOSITE_SEPARATE}) {
      SCOPED_TRACE(composite);
      const welkin::View view = engine.makeView(EXTENT, composite, COLOR);
      Request request;
      request.view = view;
      request.extent = EXTENT;
      request.composite = composite;
      request.format = COLOR;
      request.inPlace = inPlace;
      request.color = color;
      request.depth = picture.depth(CAMERAS[0]);
      const Result result =
          engine.render(request, cameraOf(CAMERAS[0], EXTENT.width, EXTENT.height));
      EXPECT_EQ(result.output, color);
      for (size_t i = 0; i < result.radiance.size(); ++i) {
        ASSERT_EQ(result.transmittance[i], 1.0f);
        ASSERT_EQ(result.radiance[i], i % 4 == 3 ? 1.0f : 0.0f);
      }
    }
  }
}

// The middle layer of three is drawn to; the others are in another layout, with contents of their
// own. The validation layer objects if Welkin moves them.
TEST(EngineLayouts, NoOtherLayerOfAnArrayIsMovedOrWritten) {
  constexpr uint32_t LAYERS = 3;
  constexpr uint32_t DRAWN = 1;
  Engine engine;
  const welkin::View view = engine.makeView(EXTENT, WLK_COMPOSITE_COMPUTE, COLOR);
  const Image image(
      engine.device(), COLOR, {EXTENT.width, EXTENT.height, 1},
      VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT,
      LAYERS);
  const size_t layerBytes = size_t{EXTENT.width} * EXTENT.height * 8;
  const support::Buffer before(engine.device(), layerBytes * LAYERS,
                               VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
  const support::Buffer after(engine.device(), layerBytes * LAYERS,
                              VK_BUFFER_USAGE_TRANSFER_DST_BIT);
  std::memset(before.data(), 0x34, layerBytes * LAYERS);
  check(engine.beginFrame(1, 0));
  VkCommandBuffer commands = engine.device().begin();
  check(wlkVulkanCmdUpdate(engine.context(), commands));
  image.write(commands, before);
  for (uint32_t layer = 0; layer < LAYERS; ++layer) {
    image.transition(commands, COPY_TARGET, layer == DRAWN ? GENERAL : ATTACHMENT, layer, 1);
  }
  WlkVulkanImage target = image.imported(GENERAL, SAMPLED);
  target.baseArrayLayer = DRAWN;
  target.layerCount = 1;
  auto targets = make<WlkVulkanViewTargets>();
  targets.color = &target;
  check(wlkVulkanCmdRenderView(engine.context(), commands, view, &targets));
  for (uint32_t layer = 0; layer < LAYERS; ++layer) {
    image.transition(commands, layer == DRAWN ? SAMPLED : ATTACHMENT, COPY_SOURCE, layer, 1);
  }
  image.read(commands, after);
  orderCopiesBeforeHost(commands);
  engine.device().submit(commands);
  engine.device().wait();
  for (uint32_t layer = 0; layer < LAYERS; ++layer) {
    const auto* drawn = static_cast<const unsigned char*>(after.data()) + layer * layerBytes;
    const auto* old = static_cast<const unsigned char*>(before.data()) + layer * layerBytes;
    EXPECT_EQ(std::memcmp(drawn, old, layerBytes) == 0, layer != DRAWN) << layer;
  }
  check(wlkVulkanForgetImage(engine.context(), image.handle()));
}

}  // namespace
