// SPDX-License-Identifier: MIT
#include "frame/record.hpp"

namespace welkin {

void imageBarrier(const vk::Dispatch& vk, VkCommandBuffer commands, VkImage image,
                  const VkImageSubresourceRange& range, const WlkVulkanImageState& from,
                  const WlkVulkanImageState& to) {
  VkImageMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
  barrier.srcStageMask = from.stages;
  barrier.srcAccessMask = from.access;
  barrier.dstStageMask = to.stages;
  barrier.dstAccessMask = to.access;
  barrier.oldLayout = from.layout;
  barrier.newLayout = to.layout;
  barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.image = image;
  barrier.subresourceRange = range;
  VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
  info.imageMemoryBarrierCount = 1;
  info.pImageMemoryBarriers = &barrier;
  vk.CmdPipelineBarrier2(commands, &info);
}

void memoryBarrier(const vk::Dispatch& vk, VkCommandBuffer commands, const Access& from,
                   const Access& to) {
  VkMemoryBarrier2 memory{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
  memory.srcStageMask = from.stages;
  memory.srcAccessMask = from.access;
  memory.dstStageMask = to.stages;
  memory.dstAccessMask = to.access;
  VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
  info.memoryBarrierCount = 1;
  info.pMemoryBarriers = &memory;
  vk.CmdPipelineBarrier2(commands, &info);
}

}  // namespace welkin
