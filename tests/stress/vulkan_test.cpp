// SPDX-License-Identifier: MIT
// welkin_vulkan.h: devices, images, frames and targets that are wrong; garbage in the engine's own
// volume images. A failing call records nothing.
#include <cmath>
#include <limits>
#include <random>

#include "stress/abuse.hpp"
#include "stress/counting_allocator.hpp"
#include "support/engine_scene.hpp"

namespace welkin::test {
namespace {

SceneOptions small() {
  SceneOptions options;
  options.width = 16;
  options.height = 12;
  return options;
}

// vkGetInstanceProcAddr of a loader that lacks one function.
const char* hidden = "";
VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL hideDeviceProc(VkDevice device, const char* name) {
  if (std::strncmp(name, hidden, std::strlen(hidden)) == 0) {
    return nullptr;  // with and without the suffix KHR
  }
  return vkGetDeviceProcAddr(device, name);
}
VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL hideInstanceProc(VkInstance instance, const char* name) {
  if (std::strcmp(name, hidden) == 0) {
    return nullptr;
  }
  return std::strcmp(name, "vkGetDeviceProcAddr") == 0
             ? reinterpret_cast<PFN_vkVoidFunction>(&hideDeviceProc)
             : vkGetInstanceProcAddr(instance, name);
}

class EngineAbuse : public ::testing::Test {
 protected:
  EngineAbuse() : scene(small()) {
    scene.setSun(30, 20);
    scene.addBall(0.01f);
    check(wlkPrepare(scene.context));
    scene.renderFrame();
    before = scene.read();
    color = scene.describe(scene.target(), VK_IMAGE_LAYOUT_GENERAL);
  }
  ~EngineAbuse() override {
    EXPECT_TRUE(scene.device().messages().empty()) << scene.device().messages().front();
  }

  void beginFrame() {
    auto frame = make<WlkFrameInfo>();
    frame.frameIndex = ++frameIndex;
    frame.completedFrameIndex = frameIndex - 1;
    ASSERT_EQ(wlkBeginFrame(scene.context, &frame), WLK_SUCCESS);
  }

  // A call that must fail inside a command buffer, without a command.
  void expectFailure(const std::function<WlkResult(VkCommandBuffer)>& call, WlkResult code,
                     const char* field) {
    scene.device().run([&](VkCommandBuffer commands) {
      SpyDevice::counts() = {};
      EXPECT_FAILS(call(commands), code, field);
      const VulkanCounts& counts = SpyDevice::counts();
      EXPECT_EQ(counts.dispatches + counts.draws + counts.barriers + counts.copies, 0u) << field;
    });
  }

  WlkResult render(VkCommandBuffer commands, const WlkVulkanViewTargets& targets) const {
    return wlkVulkanCmdRenderView(scene.context, commands, scene.view, &targets);
  }

  EngineScene scene;
  Image before;
  WlkVulkanImage color{};
  uint64_t frameIndex = 1000;  // ahead of the scene's own
};

TEST(EngineDeviceAbuse, EveryFieldOfTheDeviceIsChecked) {
  const SpyDevice spy;
  struct Case {
    const char* field;
    WlkResult code;
    std::function<void(WlkVulkanDeviceInfo&)> spoil;
  };
  using D = WlkVulkanDeviceInfo;
  const std::vector<Case> cases{
      {"getInstanceProcAddr", WLK_ERROR_INVALID_ARGUMENT,
       [](D& d) { d.getInstanceProcAddr = nullptr; }},
      {"instance", WLK_ERROR_INVALID_ARGUMENT, [](D& d) { d.instance = nullptr; }},
      {"physicalDevice", WLK_ERROR_INVALID_ARGUMENT, [](D& d) { d.physicalDevice = nullptr; }},
      {"device", WLK_ERROR_INVALID_ARGUMENT, [](D& d) { d.device = nullptr; }},
      {"apiVersion", WLK_ERROR_MISSING_FEATURE, [](D& d) { d.apiVersion = 0; }},
      {"apiVersion", WLK_ERROR_MISSING_FEATURE,
       [](D& d) { d.apiVersion = VK_MAKE_API_VERSION(0, 1, 2, 198); }},
      {"enabledFeatures", WLK_ERROR_INVALID_ARGUMENT, [](D& d) { d.enabledFeatures = 2; }},
      {"queueFamilyIndex", WLK_ERROR_INVALID_ARGUMENT, [](D& d) { d.queueFamilyIndex = 99; }}};
  for (const Case& test : cases) {
    WlkVulkanDeviceInfo device = describeDevice(spy);
    test.spoil(device);
    auto info = make<WlkContextInfo>();
    info.next = &device;
    WlkContext context = nullptr;
    EXPECT_FAILS(wlkCreateContext(WLK_API_VERSION, &info, &context), test.code, test.field);
    EXPECT_EQ(context, nullptr);
  }
  // The header of a chained structure, by the rules of all others.
  struct Longer {
    WlkVulkanDeviceInfo known;
    unsigned char tail[8];
  };
  Longer device{describeDevice(spy), {}};
  auto info = make<WlkContextInfo>();
  info.next = &device;
  WlkContext context = nullptr;
  device.known.structSize -= 1;
  EXPECT_FAILS(wlkCreateContext(WLK_API_VERSION, &info, &context), WLK_ERROR_INVALID_ARGUMENT,
               "structSize");
  device.known.structSize = sizeof device;
  device.tail[7] = 1;
  EXPECT_FAILS(wlkCreateContext(WLK_API_VERSION, &info, &context), WLK_ERROR_STRUCT_TOO_NEW,
               "structSize");
  device.tail[7] = 0;
  EXPECT_EQ(wlkCreateContext(WLK_API_VERSION, &info, &context), WLK_SUCCESS);
  wlkDestroyContext(context);
  EXPECT_TRUE(spy.messages().empty()) << spy.messages().front();
}

TEST(EngineDeviceAbuse, AMissingFunctionIsNamedAndNothingLeaks) {
  const SpyDevice spy;
  std::vector<std::string> names;
  {
    WlkVulkanDeviceInfo device = describeDevice(spy);
    auto info = make<WlkContextInfo>();
    info.next = &device;
    WlkContext context = nullptr;
    ASSERT_EQ(wlkCreateContext(WLK_API_VERSION, &info, &context), WLK_SUCCESS);
    wlkDestroyContext(context);
    names.assign(SpyDevice::namesAsked().begin(), SpyDevice::namesAsked().end());
    names.emplace_back("vkGetDeviceProcAddr");
    names.emplace_back("vkGetPhysicalDeviceProperties");
  }
  ASSERT_GT(names.size(), 30u);
  for (const std::string& name : names) {
    CountingAllocator memory;
    hidden = name.c_str();
    WlkVulkanDeviceInfo device = describeDevice(spy);
    device.getInstanceProcAddr = &hideInstanceProc;
    auto info = make<WlkContextInfo>();
    info.next = &device;
    info.allocator = memory.callbacks();
    WlkContext context = nullptr;
    EXPECT_EQ(wlkCreateContext(WLK_API_VERSION, &info, &context), WLK_ERROR_MISSING_FEATURE)
        << name;
    // "vkCreateImage" hides "vkCreateImageView" as well: the first one missed is named.
    EXPECT_EQ(std::string(lastError().field).rfind(name, 0), 0u) << lastError().field;
    EXPECT_EQ(context, nullptr);
    EXPECT_EQ(memory.live(), 0u) << name;
  }
}

TEST_F(EngineAbuse, FramesAreNumberedUpwardsAndBounded) {
  const auto begin = [&](uint64_t frame, uint64_t completed) {
    auto info = make<WlkFrameInfo>();
    info.frameIndex = frame;
    info.completedFrameIndex = completed;
    return wlkBeginFrame(scene.context, &info);
  };
  EXPECT_FAILS(begin(0, 0), WLK_ERROR_INVALID_ARGUMENT, "frameIndex");
  EXPECT_FAILS(begin(1, 0), WLK_ERROR_INVALID_ARGUMENT, "frameIndex");
  EXPECT_FAILS(begin(2, 2), WLK_ERROR_INVALID_ARGUMENT, "completedFrameIndex");
  EXPECT_FAILS(begin(2, ~uint64_t{0}), WLK_ERROR_INVALID_ARGUMENT, "completedFrameIndex");
  EXPECT_FAILS(begin(5, 1), WLK_ERROR_FRAMES_IN_FLIGHT, "completedFrameIndex");
  EXPECT_FAILS(begin(~uint64_t{0}, 1), WLK_ERROR_FRAMES_IN_FLIGHT, "completedFrameIndex");
  EXPECT_FAILS(wlkBeginFrame(scene.context, nullptr), WLK_ERROR_INVALID_ARGUMENT, "WlkFrameInfo");
  EXPECT_EQ(begin(4, 1), WLK_SUCCESS);
  EXPECT_FAILS(begin(5, 0), WLK_ERROR_INVALID_ARGUMENT, "completedFrameIndex");
  auto next = make<WlkFrameInfo>();
  next.frameIndex = 5;
  next.completedFrameIndex = 4;
  const auto beginWith = [&](const WlkFrameInfo* p) { return wlkBeginFrame(scene.context, p); };
  abuseHeader<WlkFrameInfo>(next, beginWith);
  expectLongerAccepted<WlkFrameInfo>(next, beginWith);  // 5 was not taken by a failing call
}

TEST_F(EngineAbuse, RecordingNeedsAFrameACommandBufferAndAPreparedView) {
  const WlkVulkanViewTargets targets = scene.targets(color);
  EXPECT_FAILS(wlkVulkanCmdUpdate(scene.context, nullptr), WLK_ERROR_INVALID_ARGUMENT,
               "commandBuffer");
  EXPECT_FAILS(wlkVulkanCmdRenderView(scene.context, nullptr, scene.view, &targets),
               WLK_ERROR_INVALID_ARGUMENT, "commandBuffer");
  EXPECT_FAILS(wlkVulkanCmdUpdate(nullptr, nullptr), WLK_ERROR_INVALID_HANDLE, "context");
  // The view was recorded in the scene's frame already.
  expectFailure([&](VkCommandBuffer commands) { return render(commands, targets); },
                WLK_ERROR_WRONG_STATE, "view");
  beginFrame();
  expectFailure(
      [&](VkCommandBuffer commands) {
        return wlkVulkanCmdRenderView(scene.context, commands, {77}, &targets);
      },
      WLK_ERROR_INVALID_HANDLE, "view");
  const WlkView fresh = scene.addView(small());
  expectFailure(
      [&](VkCommandBuffer commands) {
        return wlkVulkanCmdRenderView(scene.context, commands, fresh, &targets);
      },
      WLK_ERROR_NOT_PREPARED, "view");
  EXPECT_FAILS(wlkRenderHeadless(scene.context, scene.view, nullptr), WLK_ERROR_WRONG_STATE,
               "context");

  // In a context that never began a frame, and in a headless one.
  auto device = describeDevice(scene.device());
  auto info = make<WlkContextInfo>();
  info.next = &device;
  WlkContext other = nullptr;
  ASSERT_EQ(wlkCreateContext(WLK_API_VERSION, &info, &other), WLK_SUCCESS);
  expectFailure([&](VkCommandBuffer commands) { return wlkVulkanCmdUpdate(other, commands); },
                WLK_ERROR_WRONG_STATE, "context");
  wlkDestroyContext(other);
  VictimScene& victim = VictimScene::get();
  expectFailure(
      [&](VkCommandBuffer commands) { return wlkVulkanCmdUpdate(victim.scene.context, commands); },
      WLK_ERROR_WRONG_STATE, "context");
  EXPECT_FAILS(wlkVulkanSetVolumeImage(victim.scene.context, victim.volume, 0, &color),
               WLK_ERROR_WRONG_STATE, "context");
}

TEST_F(EngineAbuse, NewVolumesNeedAnUpdateBeforeTheViews) {
  scene.addBall(0.01f);
  ASSERT_EQ(wlkPrepare(scene.context), WLK_SUCCESS);
  const WlkVulkanViewTargets targets = scene.targets(color);
  beginFrame();
  expectFailure([&](VkCommandBuffer commands) { return render(commands, targets); },
                WLK_ERROR_WRONG_STATE, "context");
  scene.device().run([&](VkCommandBuffer commands) {
    EXPECT_EQ(wlkVulkanCmdUpdate(scene.context, commands), WLK_SUCCESS);
    EXPECT_EQ(render(commands, targets), WLK_SUCCESS);
  });
}

// An image that was made for fog's light, and that no update has written since, is bound all the
// same.
TEST_F(EngineAbuse, FogThatGoesBeforeAnyUpdateStopsNothing) {
  scene.setSky();
  scene.setFog(1e-4f, 300.0f);
  ASSERT_EQ(wlkPrepare(scene.context), WLK_SUCCESS);
  ASSERT_EQ(wlkSetFog(scene.context, nullptr), WLK_SUCCESS);
  ASSERT_EQ(wlkPrepare(scene.context), WLK_SUCCESS);
  scene.renderFrame();
  EXPECT_FALSE(scene.read() == before) << "there is a sky now";
}

TEST(EngineViews, RadianceAndTransmittanceAreTwoImages) {
  SceneOptions options;
  options.width = options.height = 8;
  options.composite = WLK_COMPOSITE_SEPARATE;
  EngineScene scene(options);
  ASSERT_EQ(wlkPrepare(scene.context), WLK_SUCCESS);
  const WlkVulkanImage image = EngineScene::describe(scene.target(), VK_IMAGE_LAYOUT_GENERAL);
  auto frame = make<WlkFrameInfo>();
  frame.frameIndex = 1;
  ASSERT_EQ(wlkBeginFrame(scene.context, &frame), WLK_SUCCESS);
  auto targets = make<WlkVulkanViewTargets>();
  targets.radiance = targets.transmittance = &image;
  scene.device().run([&](VkCommandBuffer commands) {
    EXPECT_EQ(wlkVulkanCmdUpdate(scene.context, commands), WLK_SUCCESS);
    EXPECT_FAILS(wlkVulkanCmdRenderView(scene.context, commands, scene.view, &targets),
                 WLK_ERROR_INVALID_ARGUMENT, "transmittance");
  });
}

TEST_F(EngineAbuse, WrongTargetsAreNamedAndTheRightOnesStillWork) {
  struct Case {
    const char* field;
    WlkResult code;
    std::function<void(WlkVulkanImage&)> spoil;
  };
  using I = WlkVulkanImage;
  const std::vector<Case> cases{
      {"color", WLK_ERROR_INVALID_ARGUMENT, [](I& i) { i.image = VK_NULL_HANDLE; }},
      {"color", WLK_ERROR_INVALID_ARGUMENT, [](I& i) { i.width = 17; }},
      {"color", WLK_ERROR_INVALID_ARGUMENT, [](I& i) { i.height = 0; }},
      {"color", WLK_ERROR_UNSUPPORTED_FORMAT, [](I& i) { i.format = VK_FORMAT_R8G8B8A8_UNORM; }},
      {"color", WLK_ERROR_UNSUPPORTED_FORMAT, [](I& i) { i.format = VK_FORMAT_UNDEFINED; }},
      {"color", WLK_ERROR_INVALID_ARGUMENT,
       [](I& i) { i.after.layout = VK_IMAGE_LAYOUT_UNDEFINED; }},
      {"color", WLK_ERROR_INVALID_ARGUMENT,
       [](I& i) { i.after.layout = VK_IMAGE_LAYOUT_PREINITIALIZED; }},
      {"color", WLK_ERROR_INVALID_ARGUMENT, [](I& i) { i.depth = 2; }},
      {"mipLevel", WLK_ERROR_INVALID_ARGUMENT, [](I& i) { i.mipLevel = 32; }},
      {"baseArrayLayer", WLK_ERROR_INVALID_ARGUMENT, [](I& i) { i.baseArrayLayer = 65536; }},
      {"layerCount", WLK_ERROR_INVALID_ARGUMENT, [](I& i) { i.layerCount = 0; }},
      {"layerCount", WLK_ERROR_INVALID_ARGUMENT, [](I& i) { i.layerCount = 2; }},
      {"reserved0", WLK_ERROR_INVALID_ARGUMENT, [](I& i) { i.reserved0 = 1; }},
      {"before.reserved0", WLK_ERROR_INVALID_ARGUMENT, [](I& i) { i.before.reserved0 = 1; }},
      {"after.reserved0", WLK_ERROR_INVALID_ARGUMENT, [](I& i) { i.after.reserved0 = 1; }},
      {"sType", WLK_ERROR_UNKNOWN_STRUCT, [](I& i) { i.sType = WLK_STRUCT_SKY; }},
      {"structSize", WLK_ERROR_INVALID_ARGUMENT, [](I& i) { i.structSize = 16; }}};
  beginFrame();
  for (const Case& test : cases) {
    WlkVulkanImage bad = color;
    test.spoil(bad);
    const WlkVulkanViewTargets targets = scene.targets(bad);
    expectFailure([&](VkCommandBuffer commands) { return render(commands, targets); }, test.code,
                  test.field);
  }
  auto none = make<WlkVulkanViewTargets>();
  expectFailure([&](VkCommandBuffer commands) { return render(commands, none); },
                WLK_ERROR_INVALID_ARGUMENT, "color");
  WlkVulkanViewTargets depth = scene.targets(color);
  depth.depth = &color;
  expectFailure([&](VkCommandBuffer commands) { return render(commands, depth); },
                WLK_ERROR_UNSUPPORTED_FORMAT, "depth");
  expectFailure(
      [&](VkCommandBuffer commands) {
        return wlkVulkanCmdRenderView(scene.context, commands, scene.view, nullptr);
      },
      WLK_ERROR_INVALID_ARGUMENT, "WlkVulkanViewTargets");
  const WlkVulkanViewTargets good = scene.targets(color);
  scene.device().run([&](VkCommandBuffer commands) {
    EXPECT_EQ(wlkVulkanCmdUpdate(scene.context, commands), WLK_SUCCESS);
    EXPECT_EQ(render(commands, good), WLK_SUCCESS);
  });
  EXPECT_TRUE(scene.read() == before);
}

TEST_F(EngineAbuse, WrongVolumeImagesAreRefusedAndTheUploadedOneStays) {
  const SpyImage voxels(scene.device(), VK_FORMAT_R32_SFLOAT, {8, 8, 8},
                        VK_IMAGE_USAGE_SAMPLED_BIT);
  const WlkVolume volume = scene.addBall(0.0f);
  const WlkVulkanImage right = scene.describe(voxels, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  struct Case {
    const char* field;
    WlkResult code;
    std::function<void(WlkVulkanImage&)> spoil;
  };
  using I = WlkVulkanImage;
  const std::vector<Case> cases{
      {"volume image", WLK_ERROR_INVALID_ARGUMENT, [](I& i) { i.image = VK_NULL_HANDLE; }},
      {"volume image", WLK_ERROR_INVALID_ARGUMENT, [](I& i) { i.width = 9; }},
      {"volume image", WLK_ERROR_INVALID_ARGUMENT, [](I& i) { i.depth = 1; }},
      {"format", WLK_ERROR_UNSUPPORTED_FORMAT, [](I& i) { i.format = VK_FORMAT_R8_UINT; }},
      {"before", WLK_ERROR_INVALID_ARGUMENT,
       [](I& i) { i.before.layout = VK_IMAGE_LAYOUT_UNDEFINED; }},
      {"before", WLK_ERROR_INVALID_ARGUMENT,
       [](I& i) { i.after.layout = VK_IMAGE_LAYOUT_GENERAL; }}};
  for (const Case& test : cases) {
    WlkVulkanImage bad = right;
    test.spoil(bad);
    EXPECT_FAILS(wlkVulkanSetVolumeImage(scene.context, volume, 0, &bad), test.code, test.field);
  }
  EXPECT_FAILS(wlkVulkanSetVolumeImage(scene.context, volume, 1, &right),
               WLK_ERROR_INVALID_ARGUMENT, "field");
  EXPECT_FAILS(wlkVulkanSetVolumeImage(scene.context, {3}, 0, &right), WLK_ERROR_INVALID_HANDLE,
               "volume");
  EXPECT_FAILS(wlkVulkanSetVolumeImage(nullptr, volume, 0, &right), WLK_ERROR_INVALID_HANDLE,
               "context");
  EXPECT_FAILS(wlkVulkanForgetImage(nullptr, voxels.handle), WLK_ERROR_INVALID_HANDLE, "context");
  // Images it never saw, null among them, are forgotten already.
  EXPECT_EQ(wlkVulkanForgetImage(scene.context, VK_NULL_HANDLE), WLK_SUCCESS);
  EXPECT_EQ(wlkVulkanForgetImage(scene.context, voxels.handle), WLK_SUCCESS);
  ASSERT_EQ(wlkPrepare(scene.context), WLK_SUCCESS);
  scene.renderFrame();
  EXPECT_TRUE(scene.read() == before);
}

TEST_F(EngineAbuse, GarbageInTheEnginesVolumeImageGivesAFinitePicture) {
  const SpyImage voxels(scene.device(), VK_FORMAT_R32_SFLOAT, {8, 8, 8},
                        VK_IMAGE_USAGE_SAMPLED_BIT);
  const WlkVolume volume = scene.addBall(0.01f);
  std::mt19937 random(2008);
  auto* words = static_cast<uint32_t*>(voxels.bytes());
  const WlkVulkanImage image = scene.describe(voxels, VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  ASSERT_EQ(wlkVulkanSetVolumeImage(scene.context, volume, 0, &image), WLK_SUCCESS);
  ASSERT_EQ(wlkPrepare(scene.context), WLK_SUCCESS);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  for (int round = 0; round < 6; ++round) {
    for (int i = 0; i < 512; ++i) {
      words[i] = static_cast<uint32_t>(random());
      const float special = i % 3 == 0 ? nan : i % 3 == 1 ? -infinity : 1e30f;
      if (round >= 4 && (round == 4 || i % 2 == 0)) {
        std::memcpy(&words[i], &special, sizeof special);
      }
    }
    voxels.write(VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    scene.renderFrame();
    EXPECT_EQ(scene.read().badValues(), 0u) << "round " << round;
    EXPECT_EQ(scene.stats().nonFinitePixels, 0u) << "round " << round;
  }
  ASSERT_EQ(wlkVulkanForgetImage(scene.context, voxels.handle), WLK_SUCCESS);
}

VkInstance describedInstance = VK_NULL_HANDLE;

// Of a device that can do all but what `missing` points to.
VkBool32 VkPhysicalDeviceFeatures::*missing = nullptr;
VKAPI_ATTR void VKAPI_CALL featuresWithout(VkPhysicalDevice device,
                                           VkPhysicalDeviceFeatures* features) {
  reinterpret_cast<PFN_vkGetPhysicalDeviceFeatures>(
      vkGetInstanceProcAddr(describedInstance, "vkGetPhysicalDeviceFeatures"))(device, features);
  features->*missing = VK_FALSE;
}
PFN_vkVoidFunction VKAPI_CALL loaderWithout(VkInstance instance, const char* name) {
  if (std::strcmp(name, "vkGetPhysicalDeviceFeatures") == 0) {
    return reinterpret_cast<PFN_vkVoidFunction>(featuresWithout);
  }
  return SpyDevice::getInstanceProcAddr()(instance, name);
}

TEST(EngineDeviceAbuse, BlendNeedsBothFeaturesOfTheDevice) {
  const SpyDevice spy;
  describedInstance = spy.instance;
  for (VkBool32 VkPhysicalDeviceFeatures::*feature :
       {&VkPhysicalDeviceFeatures::dualSrcBlend,
        &VkPhysicalDeviceFeatures::fragmentStoresAndAtomics}) {
    missing = feature;
    WlkVulkanDeviceInfo device = describeDevice(spy);
    device.getInstanceProcAddr = loaderWithout;
    device.enabledFeatures = WLK_VULKAN_FEATURE_BLEND;
    auto info = make<WlkContextInfo>();
    info.next = &device;
    WlkContext context = nullptr;
    EXPECT_FAILS(wlkCreateContext(WLK_API_VERSION, &info, &context), WLK_ERROR_MISSING_FEATURE,
                 "enabledFeatures");
    device.enabledFeatures = 0;
    EXPECT_EQ(wlkCreateContext(WLK_API_VERSION, &info, &context), WLK_SUCCESS);
    wlkDestroyContext(context);
  }
}

TEST(EngineDeviceAbuse, BlendNeedsTheFeatureThatTheEngineNames) {
  const SpyDevice spy;
  WlkVulkanDeviceInfo device = describeDevice(spy);
  device.enabledFeatures = 0;
  auto info = make<WlkContextInfo>();
  info.next = &device;
  WlkContext context = nullptr;
  ASSERT_EQ(wlkCreateContext(WLK_API_VERSION, &info, &context), WLK_SUCCESS);
  auto view = make<WlkViewInfo>();
  view.composite = WLK_COMPOSITE_BLEND;
  WlkView made{};
  EXPECT_FAILS(wlkCreateView(context, &view, &made), WLK_ERROR_MISSING_FEATURE, "composite");
  auto capabilities = make<WlkCapabilities>();
  ASSERT_EQ(wlkGetCapabilities(context, &capabilities), WLK_SUCCESS);
  EXPECT_EQ(capabilities.blendSupported, 0u);
  EXPECT_EQ(capabilities.mode, uint32_t{WLK_MODE_ENGINE_DEVICE});
  wlkDestroyContext(context);
}

}  // namespace
}  // namespace welkin::test
