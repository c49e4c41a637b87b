// SPDX-License-Identifier: MIT
#include "atmosphere.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>

#include "common/apply.hpp"
#include "engine/cloud.hpp"

namespace {

using welkin::check;
using welkin::make;

void onMessage(void*, const WlkLogMessage* message) {
  if (message->severity != WLK_LOG_INFO) {
    std::fprintf(stderr, "welkin: %s\n", message->text);
  }
}

// Hands Welkin the engine's device.
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

// An image of the engine with the states before and after Welkin's commands.
WlkVulkanImage imported(const Image& image, const ImageState& before, const ImageState& after) {
  WlkVulkanImage result = make<WlkVulkanImage>();
  result.image = image.handle();
  result.format = image.format();
  result.width = image.extent().width;
  result.height = image.extent().height;
  result.depth = 1;
  result.before = before;
  result.after = after;
  return result;
}

}  // namespace

Atmosphere::Atmosphere(const Gpu& gpu, VkExtent2D extent, uint32_t composite,
                       const Settings& settings, uint32_t framesInFlight, const host::Scene* scene)
    : viewInfo_(make<WlkViewInfo>()),
      quality_(make<WlkQuality>()),
      context_(makeContext(gpu, framesInFlight)) {
  // Clouds are as bright as they are; when the sun moves, within some frames.
  quality_.scattering = WLK_SCATTERING_ALL_ORDERS;
  quality_.lightFrames = 8;
  if (scene != nullptr) {
    quality_ = scene->quality;
    hour_ = settings.hour;  // the scene's lights stay until the user turns the clock
    lit_ = !scene->lights.empty();
    if (lit_) {
      const float* direction = scene->lights[0].direction;
      toSun_ = {direction[0], direction[1], direction[2]};
    }
    host::applyWorld(context_, *scene);
    host::applyBodies(context_, *scene, [](const std::string&) {});
  } else {
    createScene();
    createClouds(settings);
  }
  viewInfo_.width = extent.width;
  viewInfo_.height = extent.height;
  viewInfo_.composite = composite;
  viewInfo_.targetFormat = WLK_TARGET_RGBA16_FLOAT;
  view_ = welkin::View(context_, viewInfo_);
  applyQuality(settings);
  // Everything exists: make pipelines and buffers now, none while recording.
  check(wlkPrepare(context_));
}

// Air and a ground fog, whose light falls on the clouds, too; the defaults are the Earth's.
void Atmosphere::createScene() {
  const WlkSky sky = make<WlkSky>();
  check(wlkSetSky(context_, &sky));
  WlkAmbient ambient = make<WlkAmbient>();
  ambient.mode = WLK_AMBIENT_AUTOMATIC;
  check(wlkSetAmbient(context_, &ambient));
  WlkFog fog = make<WlkFog>();
  fog.extinction = 1.0e-4f;
  fog.scaleHeight = 80.0f;
  check(wlkSetFog(context_, &fog));
}

void Atmosphere::createClouds(const Settings& settings) {
  clouds_ = welkin::Volume();  // before its medium
  WlkMediumInfo droplets = make<WlkMediumInfo>();
  droplets.diameter_um = settings.dropletDiameter_um;
  droplets_ = welkin::Medium(context_, droplets);
  const CloudField cloud = makeCloudField();
  WlkVolumeField field{};
  field.medium = droplets_;
  field.extinctionScale = settings.cloudExtinction;
  WlkVolumeInfo info = make<WlkVolumeInfo>();
  // A box of 7 x 1.5 x 7 km, its base 900 m above the ground in front of the camera.
  const std::array<double, 12> worldFromVolume{7000, 0,   0, -3500, 0,    1500,
                                               0,    900, 0, 0,     7000, -9500};
  std::copy(worldFromVolume.begin(), worldFromVolume.end(), info.worldFromVolume);
  std::copy(cloud.size.begin(), cloud.size.end(), info.size);
  info.fieldCount = 1;
  info.fields = &field;
  clouds_ = welkin::Volume(context_, info);
  WlkVolumeUpload upload = make<WlkVolumeUpload>();
  std::copy(cloud.size.begin(), cloud.size.end(), upload.extent);
  upload.data = cloud.values.data();
  upload.dataSize = cloud.values.size() * sizeof(float);
  check(wlkUploadVolume(context_, clouds_, &upload));
}

void Atmosphere::setClouds(const Settings& settings) {
  createClouds(settings);
  check(wlkPrepare(context_));
}

void Atmosphere::applyQuality(const Settings& settings) const {
  WlkQuality quality = quality_;
  quality.level = settings.quality;
  if (settings.timeBudget_ms > 0.0f) {
    quality.control = WLK_CONTROL_TIME;
    quality.timeBudget_ms = settings.timeBudget_ms;
    quality.sliceCount = quality.batchSize = quality.lightBufferSize = 0;  // the governor's
  }
  check(wlkSetQuality(context_, view_, &quality));
}

void Atmosphere::setQuality(const Settings& settings) {
  applyQuality(settings);
  check(wlkPrepare(context_));
}

FrameReport Atmosphere::report() const {
  FrameReport report;
  report.frame = make<WlkFrameStats>();
  uint32_t count = 0;
  if (check(wlkGetFrameStats(context_, view_, &report.frame, &count, sizeof(WlkPassStats),
                             nullptr)) == WLK_NOT_READY) {
    return report;
  }
  report.passes.resize(count);
  check(wlkGetFrameStats(context_, view_, &report.frame, &count, sizeof(WlkPassStats),
                         report.passes.data()));
  report.quality = make<WlkQualityState>();
  check(wlkGetQualityState(context_, view_, &report.quality));
  WlkErrorEstimate estimate = make<WlkErrorEstimate>();
  check(wlkGetErrorEstimate(context_, view_, &estimate));
  report.relativeError = estimate.relativeError;
  if (ownClouds()) {
    WlkMediumOptics optics = make<WlkMediumOptics>();
    check(wlkGetMediumOptics(context_, droplets_, &optics));
    report.dropletRadius_um = optics.effectiveRadius_um;
  }
  report.ready = true;
  return report;
}

void Atmosphere::resize(VkExtent2D extent) {
  viewInfo_.width = extent.width;
  viewInfo_.height = extent.height;
  check(wlkUpdateView(context_, view_, &viewInfo_));
  check(wlkPrepare(context_));
}

void Atmosphere::forget(const Targets& targets) {
  check(wlkVulkanForgetImage(context_, targets.color.handle()));
  check(wlkVulkanForgetImage(context_, targets.depth.handle()));
  if (targets.radiance) {
    check(wlkVulkanForgetImage(context_, targets.radiance->handle()));
    check(wlkVulkanForgetImage(context_, targets.transmittance->handle()));
  }
}

void Atmosphere::setHour(double hour) {
  if (hour == hour_) {
    return;
  }
  hour_ = hour;
  lit_ = true;
  const double latitude = 40.0 * std::numbers::pi / 180.0;
  const double angle = (hour - 12.0) * std::numbers::pi / 12.0;  // past noon
  toSun_ = {-std::sin(angle), std::cos(latitude) * std::cos(angle),
            -std::sin(latitude) * std::cos(angle)};
  WlkLight sun = make<WlkLight>();
  for (int i = 0; i < 3; ++i) {
    sun.direction[i] = static_cast<float>(toSun_[i]);
  }
  check(wlkSetLights(context_, 1, sizeof sun, &sun));
}

Lighting Atmosphere::lightingAt(const glm::dvec3& position) {
  Lighting lighting;
  lighting.toSun = toSun_;
  if (lit_) {
    check(wlkEvalLight(context_, 0, &position.x, &lighting.sunIrradiance.x));
  }
  // The sky's irradiance from a few directions: pi times their mean radiance. Good enough here.
  constexpr std::array<std::array<double, 3>, 5> DIRECTIONS{
      {{0, 1, 0}, {0.8, 0.6, 0}, {-0.8, 0.6, 0}, {0, 0.6, 0.8}, {0, 0.6, -0.8}}};
  std::array<WlkRay, DIRECTIONS.size()> rays{};
  for (size_t i = 0; i < rays.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      rays[i].origin[k] = position[k];
    }
    std::copy(DIRECTIONS[i].begin(), DIRECTIONS[i].end(), rays[i].direction);
    rays[i].length = std::numeric_limits<double>::infinity();
  }
  WlkRayBatch batch = make<WlkRayBatch>();
  batch.count = static_cast<uint32_t>(rays.size());
  batch.rays = rays.data();
  std::array<glm::dvec3, DIRECTIONS.size()> radiance{};
  check(wlkEvalSky(context_, &batch, &radiance[0].x, nullptr));
  for (const glm::dvec3& value : radiance) {
    lighting.skyIrradiance += value * (std::numbers::pi / static_cast<double>(radiance.size()));
  }
  return lighting;
}

void Atmosphere::setCamera(const Camera& camera, VkExtent2D extent) {
  WlkCamera value = make<WlkCamera>();
  const glm::dmat3 rotation = camera.viewFromWorld();
  const glm::dmat4 clip = projection(static_cast<double>(extent.width) / extent.height);
  for (int i = 0; i < 3; ++i) {
    value.position[i] = camera.position[i];
  }
  for (int i = 0; i < 9; ++i) {
    value.viewFromWorld[i] = static_cast<float>(rotation[i / 3][i % 3]);
  }
  for (int i = 0; i < 16; ++i) {
    value.clipFromView[i] = static_cast<float>(clip[i / 4][i % 4]);
  }
  check(wlkSetCamera(context_, view_, &value));
}

void Atmosphere::record(VkCommandBuffer commands, const Frames& frames, const Camera& camera,
                        const Targets& targets) {
  WlkFrameInfo frame = make<WlkFrameInfo>();
  frame.frameIndex = frames.index();
  frame.completedFrameIndex = frames.completed();
  check(wlkBeginFrame(context_, &frame));
  setCamera(camera, targets.color.extent());
  check(wlkVulkanCmdUpdate(context_, commands));

  const WlkVulkanImage depth = imported(targets.depth, DEPTH_ATTACHMENT, DEPTH_ATTACHMENT);
  const WlkVulkanImage color = imported(targets.color, COLOR_ATTACHMENT, SAMPLED);
  WlkVulkanViewTargets images = make<WlkVulkanViewTargets>();
  images.depth = &depth;
  if (viewInfo_.composite != WLK_COMPOSITE_SEPARATE) {
    images.colorInput = &color;  // COMPUTE: in place; BLEND does not look at it
    images.color = &color;
    check(wlkVulkanCmdRenderView(context_, commands, view_, &images));
    return;
  }
  const WlkVulkanImage radiance = imported(*targets.radiance, discarded(SAMPLED), SAMPLED);
  const WlkVulkanImage transmittance =
      imported(*targets.transmittance, discarded(SAMPLED), SAMPLED);
  images.radiance = &radiance;
  images.transmittance = &transmittance;
  check(wlkVulkanCmdRenderView(context_, commands, view_, &images));
  transition(commands, targets.color, COLOR_ATTACHMENT, SAMPLED);
}
