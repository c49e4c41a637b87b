// SPDX-License-Identifier: MIT
// Images and buffers of the engine: one allocation each, which is enough for a dozen of them.
#pragma once

#include <welkin/welkin_vulkan.h>

#include "gpu.hpp"

// Layout, stages and accesses of an image; Welkin's structure is as good as one of our own.
using ImageState = WlkVulkanImageState;

class Image {
 public:
  Image(const Gpu& gpu, VkExtent2D extent, VkFormat format, VkImageUsageFlags usage,
        VkImageAspectFlags aspect);
  ~Image();
  Image(const Image&) = delete;
  Image& operator=(const Image&) = delete;

  VkImage handle() const { return image_; }
  VkImageView view() const { return view_; }
  VkFormat format() const { return format_; }
  VkExtent2D extent() const { return extent_; }
  VkImageAspectFlags aspect() const { return aspect_; }

 private:
  const Gpu& gpu_;
  VkExtent2D extent_;
  VkFormat format_;
  VkImageAspectFlags aspect_;
  VkImage image_ = VK_NULL_HANDLE;
  VkDeviceMemory memory_ = VK_NULL_HANDLE;
  VkImageView view_ = VK_NULL_HANDLE;
};

// Host-visible and mapped.
class Buffer {
 public:
  Buffer(const Gpu& gpu, VkDeviceSize size, VkBufferUsageFlags usage);
  ~Buffer();
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;

  VkBuffer handle() const { return buffer_; }
  void* data() const { return data_; }

 private:
  const Gpu& gpu_;
  VkBuffer buffer_ = VK_NULL_HANDLE;
  VkDeviceMemory memory_ = VK_NULL_HANDLE;
  void* data_ = nullptr;
};

// Moves all of an image from one state to another.
void transition(VkCommandBuffer commands, VkImage image, VkImageAspectFlags aspect,
                const ImageState& from, const ImageState& to);
inline void transition(VkCommandBuffer commands, const Image& image, const ImageState& from,
                       const ImageState& to) {
  transition(commands, image.handle(), image.aspect(), from, to);
}
