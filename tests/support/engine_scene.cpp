// SPDX-License-Identifier: MIT
#include "support/engine_scene.hpp"

#include <cstring>
#include <ctime>

namespace welkin::test {
namespace {

VkFormat formatOf(uint32_t targetFormat) {
  return targetFormat == WLK_TARGET_RGBA32_FLOAT ? VK_FORMAT_R32G32B32A32_SFLOAT
                                                 : VK_FORMAT_R16G16B16A16_SFLOAT;
}

// CPU time of this thread alone, without the driver's workers.
double threadSeconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

WlkVulkanDeviceInfo describeDevice(const SpyDevice& spy) {
  auto info = make<WlkVulkanDeviceInfo>();
  info.getInstanceProcAddr = SpyDevice::getInstanceProcAddr();
  info.instance = spy.instance;
  info.physicalDevice = spy.physical;
  info.device = spy.device;
  info.apiVersion = VK_API_VERSION_1_3;
  info.queueFamilyIndex = spy.family;
  return info;
}

EngineScene::EngineScene(const SceneOptions& options)
    : SpiedEngine(options.validation), SceneBuilder(options) {
  auto info = describeDevice(spy);
  info.enabledFeatures = WLK_VULKAN_FEATURE_BLEND;
  create(&info);
  target_.emplace(spy, formatOf(options.targetFormat), VkExtent3D{options.width, options.height, 1},
                  VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT |
                      VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT);
  std::memset(target_->bytes(), 0, size_t{16} * options.width * options.height);
  target_->write(VK_IMAGE_LAYOUT_GENERAL);
}

EngineScene::~EngineScene() {
  // The context goes before the images it has views of.
  wlkDestroyContext(context);
  context = nullptr;
}

WlkVulkanImage EngineScene::describe(const SpyImage& image, VkImageLayout layout) {
  auto described = make<WlkVulkanImage>();
  described.image = image.handle;
  described.format = image.format;
  described.width = image.extent.width;
  described.height = image.extent.height;
  described.depth = image.extent.depth;
  described.before.layout = described.after.layout = layout;
  described.before.stages = described.after.stages = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  described.before.access = described.after.access =
      VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
  return described;
}

WlkVulkanViewTargets EngineScene::targets(const WlkVulkanImage& color) const {
  auto made = make<WlkVulkanViewTargets>();
  made.color = &color;
  made.colorInput = inPlace ? &color : nullptr;
  made.lightShadow = lightShadow;
  made.shadowMap = shadowMap;
  return made;
}

FrameCounts EngineScene::renderFrame() {
  return renderFrames({&view, 1});
}

FrameCounts EngineScene::renderFrames(std::span<const WlkView> views) {
  auto info = make<WlkFrameInfo>();
  info.completedFrameIndex = frame_;
  info.frameIndex = ++frame_;
  check(wlkBeginFrame(context, &info));
  const WlkVulkanImage color = describe(*target_, VK_IMAGE_LAYOUT_GENERAL);
  WlkVulkanViewTargets images = targets(color);
  if (addTargets) {
    addTargets(images);
  }
  FrameCounts counts;
  WlkResult result = WLK_SUCCESS;
  const auto record = [&](VkCommandBuffer commands) {
    SpyDevice::counts() = {};
    const double start = threadSeconds();
    if (update) {
      check(wlkVulkanCmdUpdate(context, commands));
    }
    counts.update = SpyDevice::counts();
    SpyDevice::counts() = {};
    for (const WlkView one : views) {
      if (betweenViews && one.id != views.front().id) {
        betweenViews();
      }
      const WlkResult last = wlkVulkanCmdRenderView(context, commands, one, &images);
      result = result == WLK_SUCCESS ? last : result;
    }
    counts.cpuSeconds = threadSeconds() - start;
    counts.view = SpyDevice::counts();
  };
  if (submit) {
    spy.run(record);
  } else {
    spy.record(record);
  }
  check(result);
  return counts;
}

Image EngineScene::read() const {
  target_->read(VK_IMAGE_LAYOUT_GENERAL);
  Image image{options().width, options().height, {}};
  image.rgba.resize(size_t{4} * image.width * image.height);
  std::memcpy(image.rgba.data(), target_->bytes(), image.rgba.size() * sizeof(float));
  return image;
}

}  // namespace welkin::test
