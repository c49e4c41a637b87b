// SPDX-License-Identifier: MIT
// Frames in flight.
#include <gtest/gtest.h>

#include <memory>

#include "engine.hpp"
#include "picture.hpp"

namespace {

using namespace engine;
using welkin::check;

constexpr VkExtent2D EXTENT{61, 45};
constexpr VkFormat COLOR = VK_FORMAT_R32G32B32A32_SFLOAT;
constexpr uint32_t FRAMES = 3;

WlkCamera cameraOfFrame(uint64_t frame) {
  WlkCamera camera = cameraOf(CAMERAS[0], EXTENT.width, EXTENT.height);
  camera.position[0] += 60.0 * static_cast<double>(frame);
  return camera;
}

Request makeRequest(WlkView view) {
  const EnginePicture picture = makeEnginePicture(EXTENT.width, EXTENT.height, CAMERAS[0]);
  Request request;
  request.view = view;
  request.extent = EXTENT;
  request.format = COLOR;
  request.color = picture.color;
  request.depth = picture.depth(CAMERAS[0]);
  return request;
}

TEST(EngineFrames, FramesInFlightKeepTheirOwnCameras) {
  Engine engine(FRAMES);
  const welkin::View view = engine.makeView(EXTENT, WLK_COMPOSITE_COMPUTE, COLOR);
  const Request request = makeRequest(view);
  Headless headless(EXTENT.width, EXTENT.height);
  uint64_t frame = 0;
  for (int round = 0; round < 2; ++round) {  // the second round uses every slot again
    const uint64_t completed = frame;
    std::vector<std::unique_ptr<Shot>> shots;
    std::vector<VkCommandBuffer> buffers;
    // All are recorded before the first is submitted: the strictest order an engine may use.
    for (uint32_t i = 0; i < FRAMES; ++i) {
      ++frame;
      const WlkCamera camera = cameraOfFrame(frame);
      check(wlkSetCamera(engine.context(), view, &camera));
      ASSERT_EQ(engine.beginFrame(frame, completed), WLK_SUCCESS);
      VkCommandBuffer commands = engine.device().begin();
      check(wlkVulkanCmdUpdate(engine.context(), commands));
      shots.push_back(std::make_unique<Shot>(engine.device(), request));
      shots.back()->record(commands, engine.context());
      buffers.push_back(commands);
    }
    for (VkCommandBuffer commands : buffers) {
      engine.device().submit(commands);
    }
    engine.device().wait();
    std::vector<float> last;
    for (uint32_t i = 0; i < FRAMES; ++i) {
      const std::vector<float> picture = shots[i]->result().output;
      const std::vector<float> expected =
          headless.render(cameraOfFrame(completed + 1 + i), request.color, request.depth);
      expectClose(picture, expected, SAME_SHADER, "frame");
      EXPECT_NE(picture, last) << "the cameras do not differ";
      last = picture;
      shots[i]->forget(engine.context());
    }
  }
}

// What a view that is refused says; its own images are written all the same.
WlkResult refusal(const Shot& shot, VkCommandBuffer commands, WlkContext context) {
  try {
    shot.record(commands, context);
  } catch (const welkin::Error& error) {
    return error.result();
  }
  return WLK_SUCCESS;
}

TEST(EngineFrames, OneThatHasBegunMayBePreparedAgain) {
  Engine engine(FRAMES, false);
  const WlkContext context = engine.context();
  const welkin::View view = engine.makeView(EXTENT, WLK_COMPOSITE_COMPUTE, COLOR);
  const Request request = makeRequest(view);
  const WlkCamera camera = cameraOfFrame(0);
  check(wlkSetCamera(context, view, &camera));
  const Shot first(engine.device(), request);
  const Shot second(engine.device(), request);
  const Shot shot(engine.device(), request);
  ASSERT_EQ(engine.beginFrame(1, 0), WLK_SUCCESS);
  VkCommandBuffer commands = engine.device().begin();
  check(wlkVulkanCmdUpdate(context, commands));
  check(wlkSetFog(context, nullptr));
  EXPECT_EQ(refusal(first, commands, context), WLK_ERROR_NOT_PREPARED);
  uploadCloud(context, engine.cloud(), cloudValues());
  check(wlkPrepare(context));
  EXPECT_EQ(refusal(second, commands, context), WLK_ERROR_WRONG_STATE) << "voxels wait";
  check(wlkVulkanCmdUpdate(context, commands));
  shot.record(commands, context);
  engine.device().submit(commands);
  engine.device().wait();
  const std::vector<float> picture = shot.result().output;
  for (const Shot* one : {&first, &second, &shot}) {
    one->forget(context);
  }
  ASSERT_EQ(engine.beginFrame(2, 1), WLK_SUCCESS);
  const Shot next(engine.device(), request);
  commands = engine.device().begin();
  check(wlkVulkanCmdUpdate(context, commands));
  next.record(commands, context);
  engine.device().submit(commands);
  engine.device().wait();
  EXPECT_EQ(next.result().output, picture) << "a frame that began with all of it";
  next.forget(context);
}

TEST(EngineFrames, OneFrameTooManyIsRefusedAndChangesNothing) {
  for (const uint32_t most : {1u, 3u, 8u}) {
    SCOPED_TRACE(most);
    Engine engine(most);
    for (uint64_t frame = 1; frame <= most; ++frame) {
      ASSERT_EQ(engine.beginFrame(frame, 0), WLK_SUCCESS);
    }
    EXPECT_EQ(engine.beginFrame(most + 1, 0), WLK_ERROR_FRAMES_IN_FLIGHT);
    // The refused number is still free, once the first frame is complete.
    EXPECT_EQ(engine.beginFrame(most + 1, 1), WLK_SUCCESS);
  }
}

TEST(EngineFrames, FrameNumbersMustGrowAndCompletionMustNotRunAhead) {
  Engine engine;
  EXPECT_EQ(engine.beginFrame(0, 0), WLK_ERROR_INVALID_ARGUMENT);
  ASSERT_EQ(engine.beginFrame(2, 0), WLK_SUCCESS);
  EXPECT_EQ(engine.beginFrame(2, 1), WLK_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(engine.beginFrame(3, 3), WLK_ERROR_INVALID_ARGUMENT);
  ASSERT_EQ(engine.beginFrame(3, 2), WLK_SUCCESS);
  EXPECT_EQ(engine.beginFrame(4, 1), WLK_ERROR_INVALID_ARGUMENT) << "completion went back";
  // Gaps are allowed: an engine may number frames that Welkin did not see.
  EXPECT_EQ(engine.beginFrame(1000, 999), WLK_SUCCESS);
}

TEST(EngineFrames, VolumeDestroyedInFlightIsUsedToTheEnd) {
  Engine engine;
  const welkin::View view = engine.makeView(EXTENT, WLK_COMPOSITE_COMPUTE, COLOR);
  const Request request = makeRequest(view);
  const WlkCamera camera = cameraOfFrame(1);
  const std::vector<float> expected = engine.render(request, camera).output;  // frame 1
  ASSERT_EQ(engine.beginFrame(2, 1), WLK_SUCCESS);
  VkCommandBuffer commands = engine.device().begin();
  check(wlkVulkanCmdUpdate(engine.context(), commands));
  const Shot shot(engine.device(), request);
  shot.record(commands, engine.context());
  check(wlkDestroyVolume(engine.context(), engine.cloud()));
  engine.device().submit(commands);
  ASSERT_EQ(engine.beginFrame(3, 1), WLK_SUCCESS);
  engine.device().wait();
  EXPECT_EQ(shot.result().output, expected);
  shot.forget(engine.context());
  ASSERT_EQ(engine.beginFrame(4, 3), WLK_SUCCESS);  // the memory goes here
}

}  // namespace
