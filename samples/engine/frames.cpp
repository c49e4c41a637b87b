// SPDX-License-Identifier: MIT
#include "engine/frames.hpp"

Frames::Frames(const Gpu& gpu, uint32_t inFlight) : gpu_(gpu), slots_(inFlight) {
  for (Slot& slot : slots_) {
    VkCommandPoolCreateInfo pool{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    pool.queueFamilyIndex = gpu.family();
    check(vkCreateCommandPool(gpu.device(), &pool, nullptr, &slot.pool), "vkCreateCommandPool");
    VkCommandBufferAllocateInfo commands{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
    commands.commandPool = slot.pool;
    commands.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    commands.commandBufferCount = 1;
    check(vkAllocateCommandBuffers(gpu.device(), &commands, &slot.commands),
          "vkAllocateCommandBuffers");
    VkFenceCreateInfo fence{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    fence.flags = VK_FENCE_CREATE_SIGNALED_BIT;
    check(vkCreateFence(gpu.device(), &fence, nullptr, &slot.done), "vkCreateFence");
    const VkSemaphoreCreateInfo semaphore{VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
    check(vkCreateSemaphore(gpu.device(), &semaphore, nullptr, &slot.imageReady),
          "vkCreateSemaphore");
  }
}

Frames::~Frames() {
  for (const Slot& slot : slots_) {
    vkDestroySemaphore(gpu_.device(), slot.imageReady, nullptr);
    vkDestroyFence(gpu_.device(), slot.done, nullptr);
    vkDestroyCommandPool(gpu_.device(), slot.pool, nullptr);
  }
}

void Frames::wait() {
  check(vkWaitForFences(gpu_.device(), 1, &next().done, VK_TRUE, UINT64_MAX), "vkWaitForFences");
}

VkCommandBuffer Frames::begin() {
  const Slot& slot = next();
  ++index_;
  check(vkResetCommandPool(gpu_.device(), slot.pool, 0), "vkResetCommandPool");
  VkCommandBufferBeginInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
  info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  check(vkBeginCommandBuffer(slot.commands, &info), "vkBeginCommandBuffer");
  return slot.commands;
}

void Frames::submit(VkSemaphore rendered) {
  const Slot& slot = next();
  check(vkEndCommandBuffer(slot.commands), "vkEndCommandBuffer");
  check(vkResetFences(gpu_.device(), 1, &slot.done), "vkResetFences");
  VkSemaphoreSubmitInfo wait{VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO};
  wait.semaphore = slot.imageReady;
  wait.stageMask = VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT;
  VkSemaphoreSubmitInfo signal{VK_STRUCTURE_TYPE_SEMAPHORE_SUBMIT_INFO};
  signal.semaphore = rendered;
  signal.stageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  VkCommandBufferSubmitInfo commands{VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO};
  commands.commandBuffer = slot.commands;
  VkSubmitInfo2 info{VK_STRUCTURE_TYPE_SUBMIT_INFO_2};
  info.waitSemaphoreInfoCount = 1;
  info.pWaitSemaphoreInfos = &wait;
  info.commandBufferInfoCount = 1;
  info.pCommandBufferInfos = &commands;
  info.signalSemaphoreInfoCount = 1;
  info.pSignalSemaphoreInfos = &signal;
  const std::scoped_lock lock(gpu_.queueLock());
  check(vkQueueSubmit2(gpu_.queue(), 1, &info, slot.done), "vkQueueSubmit2");
  ++submitted_;
}
