// SPDX-License-Identifier: MIT
#include "cloud_stream.hpp"

#include <algorithm>
#include <exception>

#include "engine/cloud.hpp"

CloudStream::CloudStream(const Gpu& gpu) : gpu_(gpu), thread_([this] { run(); }) {}

CloudStream::~CloudStream() {
  thread_.join();
}

void CloudStream::check() const {
  if (failed_.load()) {
    std::rethrow_exception(failure_);
  }
}

void CloudStream::run() {
  try {
    const CloudField cloud = makeCloudField();
    const Buffer staging(gpu_, cloud.values.size(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
    auto* bytes = static_cast<uint8_t*>(staging.data());
    std::transform(cloud.values.begin(), cloud.values.end(), bytes,
                   [](float value) { return static_cast<uint8_t>(value * 255.0f + 0.5f); });
    image_ =
        std::make_unique<Image>(gpu_, VkExtent2D{cloud.size[0], cloud.size[1]}, VK_FORMAT_R8_UNORM,
                                VK_IMAGE_USAGE_TRANSFER_DST_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
                                VK_IMAGE_ASPECT_COLOR_BIT, cloud.size[2]);
    copy(staging);
    done_ = true;
  } catch (...) {
    failure_ = std::current_exception();
    failed_ = true;
  }
}

// Its own pool and fence; only submitting is shared.
void CloudStream::copy(const Buffer& from) const {
  VkCommandPoolCreateInfo poolInfo{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
  poolInfo.queueFamilyIndex = gpu_.family();
  VkCommandPool pool = VK_NULL_HANDLE;
  ::check(vkCreateCommandPool(gpu_.device(), &poolInfo, nullptr, &pool), "vkCreateCommandPool");
  VkCommandBufferAllocateInfo allocate{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
  allocate.commandPool = pool;
  allocate.commandBufferCount = 1;
  VkCommandBuffer commands = VK_NULL_HANDLE;
  ::check(vkAllocateCommandBuffers(gpu_.device(), &allocate, &commands),
          "vkAllocateCommandBuffers");
  VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
  begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  ::check(vkBeginCommandBuffer(commands, &begin), "vkBeginCommandBuffer");
  constexpr ImageState fresh{VK_IMAGE_LAYOUT_UNDEFINED, 0, VK_PIPELINE_STAGE_2_NONE,
                             VK_ACCESS_2_NONE};
  constexpr ImageState target{VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 0,
                              VK_PIPELINE_STAGE_2_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT};
  transition(commands, *image_, fresh, target);
  VkBufferImageCopy region{};
  region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  region.imageExtent = {WIDTH, HEIGHT, DEPTH};
  vkCmdCopyBufferToImage(commands, from.handle(), image_->handle(), target.layout, 1, &region);
  // Frames that are submitted later see it: the barrier reaches past this submission.
  transition(commands, *image_, target, SAMPLED_BY_SHADERS);
  ::check(vkEndCommandBuffer(commands), "vkEndCommandBuffer");
  const VkFenceCreateInfo fenceInfo{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
  VkFence fence = VK_NULL_HANDLE;
  ::check(vkCreateFence(gpu_.device(), &fenceInfo, nullptr, &fence), "vkCreateFence");
  VkSubmitInfo submit{VK_STRUCTURE_TYPE_SUBMIT_INFO};
  submit.commandBufferCount = 1;
  submit.pCommandBuffers = &commands;
  {
    const std::scoped_lock lock(gpu_.queueLock());
    ::check(vkQueueSubmit(gpu_.queue(), 1, &submit, fence), "vkQueueSubmit");
  }
  ::check(vkWaitForFences(gpu_.device(), 1, &fence, VK_TRUE, UINT64_MAX), "vkWaitForFences");
  vkDestroyFence(gpu_.device(), fence, nullptr);
  vkDestroyCommandPool(gpu_.device(), pool, nullptr);
}
