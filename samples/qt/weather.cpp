// SPDX-License-Identifier: MIT
#include "weather.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "cloud_stream.hpp"

namespace {

using welkin::check;
using welkin::make;

void onMessage(void*, const WlkLogMessage* message) {
  if (message->severity != WLK_LOG_INFO) {
    std::fprintf(stderr, "welkin: %s\n", message->text);
  }
}

welkin::Context makeContext(const Gpu& gpu, uint32_t framesInFlight) {
  WlkVulkanDeviceInfo device = make<WlkVulkanDeviceInfo>();
  device.getInstanceProcAddr = vkGetInstanceProcAddr;
  device.instance = gpu.instance();
  device.physicalDevice = gpu.physical();
  device.device = gpu.device();
  device.apiVersion = VK_API_VERSION_1_3;
  device.queueFamilyIndex = gpu.family();
  device.enabledFeatures = WLK_VULKAN_FEATURE_BLEND;
  WlkContextInfo info = make<WlkContextInfo>();
  info.next = &device;
  info.maxFramesInFlight = framesInFlight;
  info.log = onMessage;
  return welkin::Context(info);
}

WlkVulkanImage imported(const Image& image, uint32_t depth, const ImageState& before,
                        const ImageState& after) {
  WlkVulkanImage result = make<WlkVulkanImage>();
  result.image = image.handle();
  result.format = image.format();
  result.width = image.extent().width;
  result.height = image.extent().height;
  result.depth = depth;
  result.before = before;
  result.after = after;
  return result;
}

}  // namespace

Weather::Weather(const Gpu& gpu, VkExtent2D half, uint32_t framesInFlight, uint32_t quality)
    : viewInfo_(make<WlkViewInfo>()), context_(makeContext(gpu, framesInFlight)) {
  WlkPlanet planet = make<WlkPlanet>();
  planet.up[1] = 0.0f;
  planet.up[2] = 1.0f;
  check(wlkSetPlanet(context_, &planet));
  const WlkSky sky = make<WlkSky>();
  check(wlkSetSky(context_, &sky));
  WlkAmbient ambient = make<WlkAmbient>();
  ambient.mode = WLK_AMBIENT_AUTOMATIC;
  check(wlkSetAmbient(context_, &ambient));
  viewInfo_.width = half.width;
  viewInfo_.height = half.height;
  viewInfo_.composite = WLK_COMPOSITE_BLEND;
  viewInfo_.targetFormat = WLK_TARGET_B10G11R11_FLOAT;
  WlkQuality level = make<WlkQuality>();
  level.level = quality;
  level.scattering = WLK_SCATTERING_ALL_ORDERS;  // clouds are as bright as they are
  level.lightFrames = 8;
  for (welkin::View& view : views_) {
    view = welkin::View(context_, viewInfo_);
    check(wlkSetQuality(context_, view, &level));
  }
  check(wlkPrepare(context_));
}

void Weather::resize(VkExtent2D half) {
  viewInfo_.width = half.width;
  viewInfo_.height = half.height;
  for (const welkin::View& view : views_) {
    check(wlkUpdateView(context_, view, &viewInfo_));
  }
  check(wlkPrepare(context_));
}

void Weather::forget(const Image& image) {
  check(wlkVulkanForgetImage(context_, image.handle()));
}

void Weather::addClouds(const Image& density) {
  droplets_ = welkin::Medium(context_, make<WlkMediumInfo>());
  WlkVolumeField field{};
  field.medium = droplets_;
  field.extinctionScale = 0.03f;  // 1/m at density 1
  WlkVolumeInfo info = make<WlkVolumeInfo>();
  // 7 x 7 x 1.5 km ahead. The image's axes are across, up and backwards; columns of the 3 x 4
  // matrix, here by rows.
  const std::array<double, 12> worldFromVolume{0,    0,    -7000, 9500,   //
                                               7000, 0,    0,     -3500,  //
                                               0,    1500, 0,     900};
  std::copy(worldFromVolume.begin(), worldFromVolume.end(), info.worldFromVolume);
  info.size[0] = CloudStream::WIDTH;
  info.size[1] = CloudStream::HEIGHT;
  info.size[2] = CloudStream::DEPTH;
  info.fieldCount = 1;
  info.fields = &field;
  clouds_ = welkin::Volume(context_, info);
  const WlkVulkanImage image =
      imported(density, CloudStream::DEPTH, CloudStream::SAMPLED_BY_SHADERS,
               CloudStream::SAMPLED_BY_SHADERS);
  check(wlkVulkanSetVolumeImage(context_, clouds_, 0, &image));
  check(wlkPrepare(context_));
}

void Weather::setHour(double hour) {
  const double latitude = 40.0 * std::numbers::pi / 180.0;
  const double angle = (hour - 12.0) * std::numbers::pi / 12.0;  // past noon
  toSun_ = {std::sin(latitude) * std::cos(angle), std::sin(angle),
            std::cos(latitude) * std::cos(angle)};
  WlkLight sun = make<WlkLight>();
  for (int i = 0; i < 3; ++i) {
    sun.direction[i] = static_cast<float>(toSun_[i]);
  }
  check(wlkSetLights(context_, 1, sizeof sun, &sun));
}

MeshLight Weather::lightAt(const glm::dvec3& position) {
  MeshLight light;
  light.toSun = toSun_;
  check(wlkEvalLight(context_, 0, &position.x, &light.sunIrradiance.x));
  const glm::dvec3 up{0.0, 0.0, 1.0};
  check(wlkEvalIrradiance(context_, &position.x, &up.x, nullptr, &light.skyIrradiance.x));
  return light;
}

void Weather::begin(VkCommandBuffer commands, const Frames& frames) {
  WlkFrameInfo frame = make<WlkFrameInfo>();
  frame.frameIndex = frames.index();
  frame.completedFrameIndex = frames.completed();
  check(wlkBeginFrame(context_, &frame));
  check(wlkVulkanCmdUpdate(context_, commands));
}

void Weather::setCamera(uint32_t view, const Eye& eye, VkExtent2D extent) {
  WlkCamera camera = make<WlkCamera>();
  const glm::dmat3 rotation = eye.viewFromWorld();
  const glm::dmat4 clip = eye.clipFromView(extent);
  for (int i = 0; i < 3; ++i) {
    camera.position[i] = eye.position[i];
  }
  for (int i = 0; i < 9; ++i) {
    camera.viewFromWorld[i] = static_cast<float>(rotation[i / 3][i % 3]);
  }
  for (int i = 0; i < 16; ++i) {
    camera.clipFromView[i] = static_cast<float>(clip[i / 4][i % 4]);
  }
  check(wlkSetCamera(context_, views_[view], &camera));
}

void Weather::record(VkCommandBuffer commands, uint32_t view, const Eye& eye,
                     const ViewImages& images) {
  setCamera(view, eye, images.color.extent());
  const WlkVulkanImage depth = imported(images.depth, 1, DEPTH_ATTACHMENT, DEPTH_ATTACHMENT);
  const WlkVulkanImage color = imported(images.color, 1, COLOR_ATTACHMENT, SAMPLED);
  WlkVulkanViewTargets targets = make<WlkVulkanViewTargets>();
  targets.depth = &depth;
  targets.color = &color;
  check(wlkVulkanCmdRenderView(context_, commands, views_[view], &targets));
}
