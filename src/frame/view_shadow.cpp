// SPDX-License-Identifier: MIT
#include "frame/view_shadow.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <cstring>

#include "frame/shadow_map_record.hpp"

namespace welkin {
namespace {

// Texels along the map's edges, whatever the volumes' size: shadows in air are soft.
constexpr uint32_t SIZE = 256;
constexpr uint32_t MARGIN = 2;  // empty texels on each side
constexpr uint32_t MAX_SAMPLES = 256;
constexpr WlkVulkanImageState SAMPLED{
    VK_IMAGE_LAYOUT_GENERAL, 0,
    VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
    VK_ACCESS_2_SHADER_SAMPLED_READ_BIT};

WlkCloudShadowInfo emptyInfo() {
  WlkCloudShadowInfo info{};
  info.width = info.height = SIZE;
  info.content = WLK_CLOUD_SHADOW_LAYER;
  info.maxSamples = MAX_SAMPLES;
  info.extent[0] = info.extent[1] = 1;
  return info;
}

// Places the map around all volumes that cast shadows: it does not move with the camera. Returns
// the volumes' least distance along the light from the world's origin. m.
double coverVolumes(std::span<const ShadowCaster> casters, const glm::dvec3& toLight,
                    const glm::dvec3& up, WlkCloudShadowInfo& info) {
  const ShadowLayout axes = layoutShadowMap(info, toLight, up);
  glm::dvec3 lo(1e300);
  glm::dvec3 hi(-1e300);
  for (const ShadowCaster& caster : casters) {
    for (int i = 0; i < 8 && caster.state->anyDensity(); ++i) {
      const glm::dvec3 p =
          caster.state->worldFromBox * glm::dvec4(i & 1, i >> 1 & 1, i >> 2 & 1, 1);
      const glm::dvec3 at(glm::dot(p, axes.acrossU), glm::dot(p, axes.acrossV),
                          glm::dot(p, axes.along));
      lo = glm::min(lo, at);
      hi = glm::max(hi, at);
    }
  }
  const glm::dvec3 middle = 0.5 * (lo + hi);
  const glm::dvec3 center = axes.acrossU * middle.x + axes.acrossV * middle.y + axes.along * lo.z;
  for (int i = 0; i < 3; ++i) {
    info.center[i] = center[i];
  }
  constexpr double GROWN = double{SIZE} / (SIZE - 2 * MARGIN);
  info.extent[0] = (hi.x - lo.x) * GROWN;
  info.extent[1] = (hi.y - lo.y) * GROWN;
  return lo.z;
}

// Rows from positions relative to the eye, and where the first volume begins.
void writePlace(const WlkCloudShadowState& state, const glm::dvec3& eye, double least,
                const glm::dvec3& along, char* uniforms) {
  std::array<glm::vec4, 4> rows{};
  const double* m = state.mapFromWorld;
  for (size_t i = 0; i < 3; ++i) {
    const glm::dvec3 row(m[4 * i], m[4 * i + 1], m[4 * i + 2]);
    rows[i] = glm::vec4(glm::vec3(row), static_cast<float>(glm::dot(row, eye) + m[4 * i + 3]));
  }
  rows[3].x = static_cast<float>(least - glm::dot(along, eye) + static_cast<double>(rows[2].w));
  static_assert(offsetof(interface_::FrameUniforms, shadowRange) ==
                offsetof(interface_::FrameUniforms, shadow) + 3 * sizeof(glm::vec4));
  // Of the last row the rest is there already.
  std::memcpy(uniforms + offsetof(interface_::FrameUniforms, shadow), rows.data(),
              3 * sizeof(glm::vec4) + sizeof(float));
}

}  // namespace

void makeViewShadow(vk::Device& device, vk::Pipelines& pipelines, uint32_t volumeCount,
                    uint32_t framesInFlight, std::span<const uint32_t> fieldKinds,
                    ViewResources& r) {
  vk::ImageInfo image;
  image.format = VK_FORMAT_R32G32B32A32_SFLOAT;
  image.extent = {SIZE, SIZE, 1};
  image.usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
  r.shadowImage = vk::Image(device, image);
  r.shadowCasters.reserve(volumeCount);
  prepareShadowMap(device, pipelines, emptyInfo(), volumeCount, framesInFlight, fieldKinds,
                   r.shadow.resources);
}

bool recordViewShadow(const vk::Device& device, const vk::Pipelines& pipelines,
                      VkCommandBuffer commands, ViewState& view, const RecordInput& in) {
  ViewResources& r = view.resources;
  if (!resolveQuality(view.quality).volumeShadows || !r.shadowImage) {
    return false;
  }
  WlkPassStats stats{};
  std::snprintf(stats.name, sizeof stats.name, "cloud shadow");
  stats.pass = WLK_PASS_CLOUD_SHADOW;
  stats.reason = view.plan.shadowReason;
  if (view.plan.shadows) {
    r.shadowCasters.clear();
    for (const PlanVolume& volume : view.planVolumes) {
      const RecordVolume& from = in.volumes[volume.index];
      r.shadowCasters.push_back({volume.id, from.state, from.externalViews});
    }
    const PlanLight& light = view.plan.lights.light[0];
    ShadowMapInput input;
    input.light = &in.air->lights[light.index];
    input.up = glm::normalize(
        glm::dvec3(in.air->planet.up[0], in.air->planet.up[1], in.air->planet.up[2]));
    input.volumes = r.shadowCasters;
    input.dummy3d = in.dummy3d;
    input.frameIndex = in.frameIndex;
    input.slot = in.slot;
    input.scattered = view.plan.quality.multipleSky;
    r.shadow.info = emptyInfo();
    const double least = coverVolumes(r.shadowCasters, light.toLight, input.up, r.shadow.info);
    TargetImage target;
    target.image = r.shadowImage.handle();
    target.view = r.shadowImage.view();
    target.before = SAMPLED;
    target.before.layout = r.shadowImage.layout;
    target.after = SAMPLED;
    recordShadowMap(device, pipelines, commands, r.shadow, input, target, false);
    r.shadowImage.layout = SAMPLED.layout;
    const WlkCloudShadowState& state = r.shadow.last;
    stats.reason = state.reason;
    stats.recorded = state.recorded;
    stats.commands = state.commands;
    stats.invocations = state.invocations;
    view.record.stats.dispatches += stats.commands;
    view.record.stats.barriers += state.barriers;
    view.record.stats.descriptorWrites += state.descriptorWrites;
    const glm::dvec3 eye(view.camera.position[0], view.camera.position[1], view.camera.position[2]);
    writePlace(state, eye, least, -light.toLight,
               static_cast<char*>(r.uniforms.data()) + in.slot * r.slotStride);
  }
  view.record.passes.push_back(stats);
  return stats.recorded != 0;
}

}  // namespace welkin
