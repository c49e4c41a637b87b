// SPDX-License-Identifier: MIT
// The commands of a view's frame as they are recorded: dispatches and barriers, counted in the
// statistics and timed.
#pragma once

#include "frame/bindings.hpp"
#include "frame/record.hpp"

namespace welkin {

inline constexpr VkPipelineStageFlags2 COMPUTE = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
inline constexpr VkAccessFlags2 SHADER_ACCESS = VK_ACCESS_2_SHADER_STORAGE_READ_BIT |
                                                VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT |
                                                VK_ACCESS_2_SHADER_SAMPLED_READ_BIT;
inline constexpr WlkVulkanImageState GENERAL_STATE{VK_IMAGE_LAYOUT_GENERAL, 0, COMPUTE,
                                                   SHADER_ACCESS};

// Groups of 8 that cover `pixels`.
inline uint32_t groups(uint32_t pixels) {
  return (pixels + 7) / 8;
}

// Aerial perspective in the frame: its line of the statistics, to which the volumes add, and the
// slices of froxels in which volumes are marched.
struct AerialPass {
  bool recorded = false;
  WlkPassStats stats{};
  uint32_t statsIndex = 0;
  uint32_t firstSlice = 0;
  uint32_t endSlice = 0;
};

struct FrameCommands {
  FrameCommands(const vk::Device& device_, const vk::Pipelines& pipelines_,
                VkCommandBuffer commands_, ViewState& view_, const RecordInput& in_)
      : device(device_),
        vk(device_.vk()),
        pipelines(pipelines_),
        commands(commands_),
        view(view_),
        in(in_),
        slot(view_.resources.slots[in_.slot]),
        quality(view_.plan.quality),
        bindings(device_) {}

  const vk::Device& device;
  const vk::Dispatch& vk;
  const vk::Pipelines& pipelines;
  VkCommandBuffer commands;
  ViewState& view;
  const RecordInput& in;
  ViewSlot& slot;
  SliceQuality quality;
  Bindings bindings;
  AerialPass aerial;

  // Throws NOT_PREPARED if the pipeline is missing.
  VkPipeline find(const vk::PipelineKey& key) const;

  // Counts towards the pass `stats`, which will be line `statsIndex` of the statistics.
  void dispatch(VkPipeline pipeline, VkPipelineLayout layout,
                const interface_::SliceConstants* push, uint32_t x, uint32_t y, WlkPassStats& stats,
                uint32_t statsIndex, uint32_t z = 1);
  // With the last command's constants, and counts that the buffer has at an offset: invocations are
  // not counted.
  void dispatchIndirect(VkPipeline pipeline, VkBuffer counts, VkDeviceSize offset,
                        WlkPassStats& stats, uint32_t statsIndex);
  // Those constants, without a command.
  void push(VkPipelineLayout layout, const interface_::SliceConstants& constants);
  // Ends a command of pass `index`; without one, starts the clock.
  void timestamp(uint32_t index = ~0u);

  // Everything shaders have written, to shaders.
  void orderShaders();
  void barrier(const Access& from, const Access& to);
  void image(VkImage handle, const VkImageSubresourceRange& range, const WlkVulkanImageState& from,
             const WlkVulkanImageState& to);
  // Brings an image that nothing has been written to yet into the layout GENERAL.
  void firstUse(vk::Image& target);
};

WlkPassStats passStats(const char* name, uint32_t pass, uint64_t volume, uint64_t surface = 0);

}  // namespace welkin
