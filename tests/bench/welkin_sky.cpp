// SPDX-License-Identifier: MIT
#include "bench/welkin_sky.hpp"

#include <algorithm>
#include <iterator>
#include <vector>

namespace bench {
namespace {

void setScene(WlkContext context, const SkyCase& one) {
  auto planet = welkin::make<WlkPlanet>();
  planet.radius = static_cast<float>(SKY_PLANET_RADIUS);
  std::fill(std::begin(planet.groundAlbedo), std::end(planet.groundAlbedo),
            static_cast<float>(SKY_GROUND_ALBEDO));
  welkin::check(wlkSetPlanet(context, &planet));
  auto sky = welkin::make<WlkSky>();
  std::transform(SKY_SCATTERING.begin(), SKY_SCATTERING.end(), sky.rayleighScattering,
                 [](double value) { return static_cast<float>(value); });
  sky.scaleHeight = static_cast<float>(SKY_SCALE_HEIGHT);
  welkin::check(wlkSetSky(context, &sky));
  auto sun = welkin::make<WlkLight>();
  const host::Vec3 direction = sunDirection(one);
  sun.direction[0] = static_cast<float>(direction.x);
  sun.direction[1] = static_cast<float>(direction.y);
  sun.direction[2] = static_cast<float>(direction.z);
  sun.angularDiameter = 0;
  welkin::check(wlkSetLights(context, 1, sizeof sun, &sun));
}

}  // namespace

WelkinSky::WelkinSky(const Gpu& gpu, const GpuTargets& targets, const SkyCase& one,
                     uint32_t scattering, bool moving)
    : moving_(moving),
      depth_(described(targets.depth)),
      color_(described(targets.color)),
      target_(described(targets.target)) {
  const WlkVulkanDeviceInfo device = gpu.info();
  auto info = welkin::make<WlkContextInfo>();
  info.next = &device;
  welkin::check(context_.create(info));
  setScene(context_, one);
  auto view = welkin::make<WlkViewInfo>();
  view.width = targets.target.extent.width;
  view.height = targets.target.extent.height;
  view.targetFormat = WLK_TARGET_RGBA32_FLOAT;
  view.layers = WLK_LAYER_SKY;  // the other side draws neither the ground nor the disk
  welkin::check(wlkCreateView(context_, &view, &view_));
  camera_ = welkin::make<WlkCamera>();
  host::fillCamera(skyCamera(one), view.width, view.height, camera_);
  welkin::check(wlkSetCamera(context_, view_, &camera_));
  auto quality = welkin::make<WlkQuality>();
  quality.scattering = scattering;
  welkin::check(wlkSetQuality(context_, view_, &quality));
  welkin::check(wlkPrepare(context_));
}

void WelkinSky::record(VkCommandBuffer commands) {
  if (moving_) {
    camera_.position[0] += 0.01;
    welkin::check(wlkSetCamera(context_, view_, &camera_));
  }
  auto frame = welkin::make<WlkFrameInfo>();
  frame.completedFrameIndex = frame_;
  frame.frameIndex = ++frame_;
  welkin::check(wlkBeginFrame(context_, &frame));
  welkin::check(wlkVulkanCmdUpdate(context_, commands));
  auto images = welkin::make<WlkVulkanViewTargets>();
  images.depth = &depth_;
  images.colorInput = &color_;
  images.color = &target_;
  welkin::check(wlkVulkanCmdRenderView(context_, commands, view_, &images));
}

GpuCounts WelkinSky::counts() const {
  auto stats = welkin::make<WlkFrameStats>();
  uint32_t count = 0;
  welkin::check(wlkGetFrameStats(context_, view_, &stats, &count, sizeof(WlkPassStats), nullptr));
  std::vector<WlkPassStats> passes(count);
  welkin::check(
      wlkGetFrameStats(context_, view_, &stats, &count, sizeof(WlkPassStats), passes.data()));
  GpuCounts counts;
  counts.dispatches = stats.dispatches;
  counts.bytes = stats.deviceMemory;
  for (const WlkPassStats& pass : passes) {
    counts.invocations += pass.invocations;
    if (pass.recorded != 0) {
      counts.passes_ms.emplace_back(pass.name, 1e-6 * static_cast<double>(pass.gpuTime_ns));
    }
  }
  return counts;
}

}  // namespace bench
