// SPDX-License-Identifier: MIT
// Maps of the volumes' shadow on the GPU: what they keep, and the commands that write them.
#pragma once

#include "frame/bindings.hpp"
#include "frame/record.hpp"
#include "frame/shadow_map.hpp"

namespace welkin {

struct ShadowSlot {
  uint64_t frameIndex = 0;  // that wrote the queries, 0 if none waits to be read
};

// Remade by wlkPrepare when sizes change. Nothing in here is destroyed by its destructor except
// buffers: destroyShadowMap.
struct ShadowMapResources {
  explicit ShadowMapResources(std::pmr::memory_resource* memory)
      : sets(memory), slots(memory), key(memory), now(memory) {}
  vk::Buffer uniforms;  // per slot: volumes
  VkDeviceSize stride = 0;
  vk::Buffer sums;
  VkDescriptorPool pool = VK_NULL_HANDLE;
  VkQueryPool queries = VK_NULL_HANDLE;
  std::pmr::vector<BoundSet> sets;  // per slot: one of each volume
  std::pmr::vector<ShadowSlot> slots;
  uint32_t volumeCapacity = 0;
  std::pmr::vector<char> key;  // what the image was made from; empty: it holds nothing
  std::pmr::vector<char> now;  // room for the next key
};

struct ShadowMapState {
  explicit ShadowMapState(std::pmr::memory_resource* memory) : resources(memory) {}
  WlkShadowMapInfo info{};
  ShadowMapResources resources;
  bool prepared = false;
  VkImage image = VK_NULL_HANDLE;  // that holds it
  uint64_t lastFrame = 0;          // 0: none recorded yet
  uint64_t gpuTime_ns = 0;
  WlkShadowMapState last{};
};

// A volume of the context that the map may show.
struct ShadowCaster {
  uint64_t id = 0;
  const VolumeState* state = nullptr;
  std::array<VkImageView, WLK_MAX_FIELDS> externalViews{};
};

struct ShadowMapInput {
  const WlkLight* light = nullptr;  // null, or with irradiance
  glm::dvec3 up{0, 1, 0};
  std::span<const ShadowCaster> volumes;
  VkImageView dummy3d = VK_NULL_HANDLE;
  uint64_t frameIndex = 0;
  uint32_t slot = 0;
};

// Makes pipelines and buffers for `volumeCount` volumes. Strong guarantee: on failure `made` holds
// nothing.
void prepareShadowMap(vk::Device& device, vk::Pipelines& pipelines, const WlkShadowMapInfo& info,
                      uint32_t volumeCount, uint32_t framesInFlight,
                      std::span<const uint32_t> fieldCounts, ShadowMapResources& made);
void destroyShadowMap(vk::Device& device, ShadowMapResources& resources);

// Throws NOT_PREPARED before the first command if something is missing.
void recordShadowMap(const vk::Device& device, const vk::Pipelines& pipelines,
                     VkCommandBuffer commands, ShadowMapState& map, const ShadowMapInput& input,
                     const TargetImage& target, bool half);

// Reads the times of frames up to `completed`.
void harvestShadowMap(const vk::Device& device, ShadowMapState& map, uint64_t completed);

}  // namespace welkin
