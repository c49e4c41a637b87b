// SPDX-License-Identifier: MIT
#include "bench/volume_welkin.hpp"

#include <algorithm>
#include <iterator>

#include "bench/volume_set.hpp"
#include "common/camera.hpp"

namespace bench {
namespace {

constexpr double EYE_ALTITUDE = 1000;  // m; without air it matters to nothing
constexpr double EYES_APART = 0.06;    // m

void setLight(WlkContext context, const Vec3& toLight) {
  auto light = welkin::make<WlkLight>();
  light.direction[0] = static_cast<float>(toLight.x);
  light.direction[1] = static_cast<float>(toLight.y);
  light.direction[2] = static_cast<float>(toLight.z);
  light.angularDiameter = 0;
  welkin::check(wlkSetLights(context, 1, sizeof light, &light));
}

}  // namespace

WelkinVolume::WelkinVolume(Gpu& gpu, const GpuImage& target, const Cloud* cloud,
                           const Vec3& toLight, const WelkinVolumeOptions& options) {
  const WlkVulkanDeviceInfo device = gpu.info();
  auto info = welkin::make<WlkContextInfo>();
  info.next = &device;
  welkin::check(context_.create(info));
  setLight(context_, toLight);
  if (options.underSky) {
    const auto sky = welkin::make<WlkSky>();
    welkin::check(wlkSetSky(context_, &sky));
  }
  if (cloud != nullptr) {
    addVolume(cloud, options.deep);
  }
  if (options.emptyVolume) {
    addVolume(nullptr, 1);
  }
  for (uint32_t i = 0; i < options.views; ++i) {
    auto view = welkin::make<WlkViewInfo>();
    view.width = target.extent.width;
    view.height = target.extent.height;
    view.targetFormat = WLK_TARGET_RGBA32_FLOAT;
    view.composite = WLK_COMPOSITE_BLEND;
    WlkView made{};
    welkin::check(wlkCreateView(context_, &view, &made));
    views_.push_back(made);
    targets_.push_back(described(
        i == 0 ? target
               : gpu.makeImage(target.format, target.extent, VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT)));
    host::CameraDesc eye;
    eye.position = {EYES_APART * i, EYE_ALTITUDE + (options.underSky ? 0.5 * CLOUD_EDGE : 0.0), 0};
    eye.verticalFovDeg = 2 * std::atan(CLOUD_TANGENT) / host::RADIANS_PER_DEGREE;
    auto camera = welkin::make<WlkCamera>();
    host::fillCamera(eye, view.width, view.height, camera);
    welkin::check(wlkSetCamera(context_, made, &camera));
    auto quality = welkin::make<WlkQuality>();
    quality.sliceCount = options.slices;
    quality.lightBufferSize = options.lightSize;
    quality.flags = options.fresh ? WLK_QUALITY_FLAG_NO_SKIP : 0;
    quality.volumeResolution =
        options.half ? WLK_VOLUME_RESOLUTION_HALF : WLK_VOLUME_RESOLUTION_FULL;
    quality.scattering = options.underSky ? WLK_SCATTERING_DEFAULT : WLK_SCATTERING_SINGLE;
    welkin::check(wlkSetQuality(context_, made, &quality));
  }
  welkin::check(wlkPrepare(context_));
}

void WelkinVolume::addVolume(const Cloud* cloud, uint32_t deep) {
  auto medium = welkin::make<WlkMediumInfo>();
  medium.particle = WLK_PARTICLE_HENYEY_GREENSTEIN;
  medium.asymmetry = static_cast<float>(CLOUD_G);
  WlkVolumeField field{};
  welkin::check(wlkCreateMedium(context_, &medium, &field.medium));
  field.extinctionScale = static_cast<float>(CLOUD_EXTINCTION);
  auto info = welkin::make<WlkVolumeInfo>();
  std::fill(std::begin(info.size), std::end(info.size), static_cast<uint32_t>(CLOUD_VOXELS));
  info.fieldCount = 1;
  info.fields = &field;
  info.size[2] *= deep;
  Vec3 corner = cloudCorner();
  corner.z -= (deep - 1) * CLOUD_EDGE;
  const std::array<double, 12> place{
      CLOUD_EDGE,        0,       0, corner.x, 0, CLOUD_EDGE, 0, corner.y + EYE_ALTITUDE, 0, 0,
      deep * CLOUD_EDGE, corner.z};
  std::copy(place.begin(), place.end(), info.worldFromVolume);
  WlkVolume volume{};
  welkin::check(wlkCreateVolume(context_, &info, &volume));
  if (cloud == nullptr) {
    return;
  }
  auto upload = welkin::make<WlkVolumeUpload>();
  upload.format = WLK_FORMAT_R16_FLOAT;
  std::copy(std::begin(info.size), std::end(info.size), upload.extent);
  std::vector<uint16_t> halves((deep - 1) * cloud->halves.size());
  halves.insert(halves.end(), cloud->halves.begin(), cloud->halves.end());
  upload.data = halves.data();
  upload.dataSize = halves.size() * sizeof(uint16_t);
  welkin::check(wlkUploadVolume(context_, volume, &upload));
}

void WelkinVolume::record(VkCommandBuffer commands) {
  auto frame = welkin::make<WlkFrameInfo>();
  frame.completedFrameIndex = frame_;
  frame.frameIndex = ++frame_;
  welkin::check(wlkBeginFrame(context_, &frame));
  welkin::check(wlkVulkanCmdUpdate(context_, commands));
  for (size_t i = 0; i < views_.size(); ++i) {
    clearImage(commands, targets_[i].image);
    auto images = welkin::make<WlkVulkanViewTargets>();
    images.color = &targets_[i];
    welkin::check(wlkVulkanCmdRenderView(context_, commands, views_[i], &images));
  }
}

std::vector<WlkPassStats> WelkinVolume::passes(size_t view, WlkFrameStats& stats) const {
  uint32_t count = 0;
  welkin::check(
      wlkGetFrameStats(context_, views_[view], &stats, &count, sizeof(WlkPassStats), nullptr));
  std::vector<WlkPassStats> passes(count);
  welkin::check(wlkGetFrameStats(context_, views_[view], &stats, &count, sizeof(WlkPassStats),
                                 passes.data()));
  return passes;
}

GpuCounts WelkinVolume::counts(size_t view) const {
  auto stats = welkin::make<WlkFrameStats>();
  GpuCounts counts;
  for (const WlkPassStats& pass : passes(view, stats)) {
    counts.invocations += pass.invocations;
    if (pass.recorded != 0) {
      counts.passes_ms.emplace_back(pass.name, 1e-6 * static_cast<double>(pass.gpuTime_ns));
    }
  }
  counts.dispatches = stats.dispatches;
  counts.bytes = stats.deviceMemory;
  return counts;
}

std::vector<std::pair<std::string, uint32_t>> WelkinVolume::commands(size_t view) const {
  auto stats = welkin::make<WlkFrameStats>();
  std::vector<std::pair<std::string, uint32_t>> result;
  for (const WlkPassStats& pass : passes(view, stats)) {
    result.emplace_back(pass.name, pass.commands);
  }
  return result;
}

}  // namespace bench
