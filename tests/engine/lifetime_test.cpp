// SPDX-License-Identifier: MIT
// Creation, destruction, resizing; several contexts at once. The device's destructor fails the test
// for every object that is left and for every use of a dead one.
#include <gtest/gtest.h>

#include <thread>

#include "engine.hpp"
#include "picture.hpp"

namespace {

using namespace engine;
using welkin::check;
using welkin::make;

constexpr VkFormat COLOR = VK_FORMAT_R32G32B32A32_SFLOAT;

Request makeRequest(WlkView view, VkExtent2D extent) {
  const EnginePicture picture = makeEnginePicture(extent.width, extent.height, CAMERAS[0]);
  Request request;
  request.view = view;
  request.extent = extent;
  request.format = COLOR;
  request.color = picture.color;
  request.depth = picture.depth(CAMERAS[0]);
  return request;
}

// Engine::render forgets and destroys the images of every frame, so the driver hands out the same
// handles again for images of another size.
TEST(EngineLifetime, ForgottenImagesAndResizedViewsLeaveNoTrace) {
  Engine engine;
  constexpr std::array sizes{VkExtent2D{61, 45}, VkExtent2D{30, 20}, VkExtent2D{64, 48},
                             VkExtent2D{61, 45}};
  const welkin::View view = engine.makeView(sizes[0], WLK_COMPOSITE_COMPUTE, COLOR);
  for (const VkExtent2D& size : sizes) {
    SCOPED_TRACE(size.width);
    auto info = make<WlkViewInfo>();
    info.width = size.width;
    info.height = size.height;
    info.targetFormat = WLK_TARGET_RGBA32_FLOAT;
    check(wlkUpdateView(engine.context(), view, &info));
    check(wlkPrepare(engine.context()));
    const Request request = makeRequest(view, size);
    const WlkCamera camera = cameraOf(CAMERAS[0], size.width, size.height);
    Headless headless(size.width, size.height);
    const std::vector<float> expected = headless.render(camera, request.color, request.depth);
    for (int repeat = 0; repeat < 3; ++repeat) {
      expectClose(engine.render(request, camera).output, expected, SAME_SHADER, "picture");
    }
  }
}

TEST(EngineLifetime, ViewsResizedInFlightKeepTheirResources) {
  Engine engine;
  constexpr VkExtent2D size{61, 45};
  const welkin::View view = engine.makeView(size, WLK_COMPOSITE_COMPUTE, COLOR);
  const Request request = makeRequest(view, size);
  const WlkCamera camera = cameraOf(CAMERAS[0], size.width, size.height);
  const std::vector<float> expected = engine.render(request, camera).output;  // frame 1
  check(engine.beginFrame(2, 1));
  VkCommandBuffer commands = engine.device().begin();
  check(wlkVulkanCmdUpdate(engine.context(), commands));
  const Shot shot(engine.device(), request);
  shot.record(commands, engine.context());
  auto info = make<WlkViewInfo>();
  info.width = 200;
  info.height = 100;
  check(wlkUpdateView(engine.context(), view, &info));
  check(wlkPrepare(engine.context()));
  engine.device().submit(commands);
  engine.device().wait();
  EXPECT_EQ(shot.result().output, expected);
  shot.forget(engine.context());
}

TEST(EngineLifetime, FiftyContextsComeAndGoOnOneDevice) {
  Device device;
  const WlkVulkanDeviceInfo engine = device.info();
  auto info = make<WlkContextInfo>();
  info.next = &engine;
  for (int i = 0; i < 50; ++i) {
    const welkin::Context context(info);
    const Scene scene = makeScene(context);
    auto viewInfo = make<WlkViewInfo>();
    viewInfo.width = 16;
    viewInfo.height = 16;
    viewInfo.composite = static_cast<uint32_t>(i % 3);
    const welkin::View view(context, viewInfo);
    setQuality(context, view);
    if (i % 8 == 0) {  // compiling every shader takes a second
      check(wlkPrepare(context));
      Request request = makeRequest(view, {16, 16});
      request.composite = viewInfo.composite;
      request.format = VK_FORMAT_R16G16B16A16_SFLOAT;
      const Shot shot(device, request);
      auto frame = make<WlkFrameInfo>();
      frame.frameIndex = 1;
      check(wlkBeginFrame(context, &frame));
      VkCommandBuffer commands = device.begin();
      check(wlkVulkanCmdUpdate(context, commands));
      shot.record(commands, context);
      device.submit(commands);
      device.wait();
      shot.forget(context);
    }
  }
}

TEST(EngineLifetime, TwoDevicesWorkAtOnce) {
  constexpr VkExtent2D size{61, 45};
  const WlkCamera camera = cameraOf(CAMERAS[0], size.width, size.height);
  std::array<std::vector<float>, 2> pictures;
  const auto work = [&](std::vector<float>& picture) {
    Engine engine;
    const welkin::View view = engine.makeView(size, WLK_COMPOSITE_COMPUTE, COLOR);
    const Request request = makeRequest(view, size);
    for (int frame = 0; frame < 4; ++frame) {
      picture = engine.render(request, camera).output;
    }
  };
  std::thread first(work, std::ref(pictures[0]));
  std::thread second(work, std::ref(pictures[1]));
  first.join();
  second.join();
  Headless headless(size.width, size.height);
  const Request request = makeRequest({}, size);
  const std::vector<float> expected = headless.render(camera, request.color, request.depth);
  expectClose(pictures[0], expected, SAME_SHADER, "first device");
  expectClose(pictures[1], expected, SAME_SHADER, "second device");
}

}  // namespace
