// SPDX-License-Identifier: MIT
// Turns a view's plan into commands. Allocates nothing and creates nothing on the device.
#pragma once

#include <span>

#include "frame/light_shadow.hpp"
#include "frame/scene.hpp"
#include "frame/uniforms.hpp"

namespace welkin {

// An image the commands use: its view, and the states it comes from and goes to.
struct TargetImage {
  VkImage image = VK_NULL_HANDLE;
  VkImageView view = VK_NULL_HANDLE;
  VkImageSubresourceRange range{VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};  // that is moved
  WlkVulkanImageState before{};
  WlkVulkanImageState after{};
  explicit operator bool() const { return image != VK_NULL_HANDLE; }
};

struct ViewTargets {
  TargetImage depth;
  TargetImage colorInput;
  bool inputIsTarget = false;  // colorInput is `target0` itself
  TargetImage target0;         // colour, or radiance
  TargetImage target1;         // transmittance
  TargetImage shadowMap;       // the engine's, with all its cascades
  LightShadow lightShadow;     // where it lies
  TargetImage aerialRadiance;  // both or none
  TargetImage aerialTransmittance;
  bool aerialHalf = false;  // these two hold half floats
  TargetImage volumeDistance;
  bool distanceHalf = false;
};

// Volumes of the context in plan order of index, with the views of the engine's field images.
struct RecordVolume {
  const VolumeState* state = nullptr;
  LightStore* store = nullptr;  // where the view's light of it is kept
  std::array<VkImageView, WLK_MAX_FIELDS> externalViews{};
};

// Surfaces of the context in plan order of index.
struct RecordSurface {
  SurfaceState* state = nullptr;
  SurfaceLight* light = nullptr;  // of the view's size
  SurfaceLight* up = nullptr;     // where there is light of sky and ground
};

struct RecordInput {
  const AirState* air = nullptr;
  const SkyLightState* sky = nullptr;
  std::span<const RecordVolume> volumes;    // by PlannedVolume::index
  std::span<const RecordSurface> surfaces;  // by the plan's index
  const SurfaceTables* surfaceTables = nullptr;
  VkImageView dummy2d = VK_NULL_HANDLE;
  VkImageView dummy3d = VK_NULL_HANDLE;
  VkImageView dummyArray = VK_NULL_HANDLE;  // of layers
  uint64_t frameIndex = 0;
  uint32_t slot = 0;
};

// Records the plan in `view.plan`. Throws NOT_PREPARED before the first command if a pipeline is
// missing.
void recordView(vk::Device& device, const vk::Pipelines& pipelines, VkCommandBuffer commands,
                ViewState& view, const RecordInput& input, const ViewTargets& targets);

// Reads counters and timestamps of frames up to `completed` into view.record and view.nonFinite.
void harvest(vk::Device& device, ViewState& view, uint64_t completed);

// One image barrier over a part of an image, or over all of one of ours.
void imageBarrier(const vk::Dispatch& vk, VkCommandBuffer commands, VkImage image,
                  const VkImageSubresourceRange& range, const WlkVulkanImageState& from,
                  const WlkVulkanImageState& to);
constexpr VkImageSubresourceRange WHOLE_IMAGE{VK_IMAGE_ASPECT_COLOR_BIT, 0, VK_REMAINING_MIP_LEVELS,
                                              0, VK_REMAINING_ARRAY_LAYERS};

/// Which stages a memory barrier separates, and the accesses it makes visible.
struct Access {
  VkPipelineStageFlags2 stages;
  VkAccessFlags2 access;
};

void memoryBarrier(const vk::Dispatch& vk, VkCommandBuffer commands, const Access& from,
                   const Access& to);

}  // namespace welkin
