// SPDX-License-Identifier: MIT
#include "frame/frame_commands.hpp"

#include <cstdio>

#include "failure.hpp"

namespace welkin {

VkPipeline FrameCommands::find(const vk::PipelineKey& key) const {
  const VkPipeline pipeline = pipelines.find(key);
  if (pipeline == VK_NULL_HANDLE) {
    fail(WLK_ERROR_NOT_PREPARED, 0, "",
         "the scene changed in a way that needs wlkPrepare before recording");
  }
  return pipeline;
}

void FrameCommands::dispatch(VkPipeline pipeline, VkPipelineLayout layout,
                             const interface_::SliceConstants* push, uint32_t x, uint32_t y,
                             WlkPassStats& stats, uint32_t statsIndex, uint32_t z) {
  vk.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
  if (push != nullptr) {
    vk.CmdPushConstants(commands, layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof *push, push);
  }
  vk.CmdDispatch(commands, x, y, z);
  stats.recorded = 1;
  stats.commands += 1;
  stats.invocations += uint64_t{x} * y * z * 64;
  view.record.stats.dispatches += 1;
  timestamp(statsIndex);
}

void FrameCommands::dispatchIndirect(VkPipeline pipeline, VkBuffer counts, VkDeviceSize offset,
                                     WlkPassStats& stats, uint32_t statsIndex) {
  vk.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline);
  vk.CmdDispatchIndirect(commands, counts, offset);
  stats.commands += 1;
  view.record.stats.dispatches += 1;
  timestamp(statsIndex);
}

void FrameCommands::push(VkPipelineLayout layout, const interface_::SliceConstants& constants) {
  vk.CmdPushConstants(commands, layout, VK_SHADER_STAGE_COMPUTE_BIT, 0, sizeof constants,
                      &constants);
}

void FrameCommands::timestamp(uint32_t index) {
  if (!device.timestamps()) {
    return;
  }
  const auto query = static_cast<uint32_t>(slot.passOfQuery.size()) + (index == ~0u ? 0 : 1);
  if (index != ~0u) {
    slot.passOfQuery.push_back(index);
  }
  vk.CmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, slot.queries, query);
}

void FrameCommands::orderShaders() {
  barrier({COMPUTE, SHADER_ACCESS},
          {COMPUTE | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT, SHADER_ACCESS});
}

void FrameCommands::barrier(const Access& from, const Access& to) {
  memoryBarrier(vk, commands, from, to);
  view.record.stats.barriers += 1;
}

void FrameCommands::image(VkImage handle, const VkImageSubresourceRange& range,
                          const WlkVulkanImageState& from, const WlkVulkanImageState& to) {
  imageBarrier(vk, commands, handle, range, from, to);
  view.record.stats.barriers += 1;
}

void FrameCommands::firstUse(vk::Image& target) {
  if (target && target.layout == VK_IMAGE_LAYOUT_UNDEFINED) {
    image(target.handle(), WHOLE_IMAGE,
          {VK_IMAGE_LAYOUT_UNDEFINED, 0, VK_PIPELINE_STAGE_2_NONE, VK_ACCESS_2_NONE},
          GENERAL_STATE);
    target.layout = VK_IMAGE_LAYOUT_GENERAL;
  }
}

WlkPassStats passStats(const char* name, uint32_t pass, uint64_t volume, uint64_t surface) {
  WlkPassStats stats{};
  std::snprintf(stats.name, sizeof stats.name, "%s", name);
  stats.pass = pass;
  stats.volume.id = volume;
  stats.surface.id = surface;
  return stats;
}

}  // namespace welkin
