// SPDX-License-Identifier: MIT
// Images and buffers of the engine: one allocation each, which is enough for a dozen of them.
#pragma once

#include <welkin/welkin_vulkan.h>

#include "engine/gpu.hpp"

// Layout, stages and accesses of an image; Welkin's structure is as good as one of our own.
using ImageState = WlkVulkanImageState;

inline constexpr ImageState COLOR_ATTACHMENT{
    VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, 0, VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
    VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT};
inline constexpr ImageState DEPTH_ATTACHMENT{
    VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL, 0,
    VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT};
// Read by the pass that shows the picture.
inline constexpr ImageState SAMPLED{VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, 0,
                                    VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
                                    VK_ACCESS_2_SHADER_SAMPLED_READ_BIT};

// The same image at the start of the next frame: contents no longer needed, but the last use must
// be over before the next one overwrites it.
constexpr ImageState discarded(ImageState lastUse) {
  lastUse.layout = VK_IMAGE_LAYOUT_UNDEFINED;
  return lastUse;
}

class Image {
 public:
  // 3-D with a depth above 1.
  Image(const Gpu& gpu, VkExtent2D extent, VkFormat format, VkImageUsageFlags usage,
        VkImageAspectFlags aspect, uint32_t depth = 1);
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
