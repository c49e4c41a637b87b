// SPDX-License-Identifier: MIT
// Maps of the volumes' shadow on the GPU: what they keep, and the commands that write them.
#pragma once

#include "frame/bindings.hpp"
#include "frame/record.hpp"
#include "frame/shadow_map.hpp"

namespace welkin {

struct ShadowMapInput {
  const WlkLight* light = nullptr;  // null, or with irradiance
  glm::dvec3 up{0, 1, 0};
  std::span<const ShadowCaster> volumes;
  VkImageView dummy3d = VK_NULL_HANDLE;
  uint64_t frameIndex = 0;
  uint32_t slot = 0;
  bool scattered = false;  // layers of what turns and of what absorbs light
};

// Makes pipelines and buffers for `volumeCount` volumes. Strong guarantee: on failure `made` holds
// nothing.
void prepareShadowMap(vk::Device& device, vk::Pipelines& pipelines, const WlkCloudShadowInfo& info,
                      uint32_t volumeCount, uint32_t framesInFlight,
                      std::span<const uint32_t> fieldKinds, ShadowMapResources& made);
void destroyShadowMap(vk::Device& device, ShadowMapResources& resources);

// Throws NOT_PREPARED before the first command if something is missing.
void recordShadowMap(const vk::Device& device, const vk::Pipelines& pipelines,
                     VkCommandBuffer commands, ShadowMapState& map, const ShadowMapInput& input,
                     const TargetImage& target, bool half);

// Reads the times of frames up to `completed`.
void harvestShadowMap(const vk::Device& device, ShadowMapState& map, uint64_t completed);

}  // namespace welkin
