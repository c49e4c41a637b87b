// SPDX-License-Identifier: MIT
// An engine's Vulkan device under validation, with images and buffers on it.
#pragma once

#include <vulkan/vulkan.h>
#include <welkin/welkin_vulkan.h>

#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace engine {

void check(VkResult result, const char* call);

// Its destructor fails the test if the validation layer said anything, objects left over included.
class Device {
 public:
  Device();
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  VkInstance instance() const { return instance_; }
  VkPhysicalDevice physical() const { return physical_; }
  VkDevice handle() const { return device_; }
  uint32_t family() const { return family_; }
  bool supports(VkFormat format, VkFormatFeatureFlags features) const;
  WlkVulkanDeviceInfo info() const;

  // A new command buffer that is being recorded.
  VkCommandBuffer begin();
  // Ends and submits it; nothing waits.
  void submit(VkCommandBuffer commands);
  // Waits for everything and frees the command buffers.
  void wait();

 private:
  static VKAPI_ATTR VkBool32 VKAPI_CALL onMessage(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                                  VkDebugUtilsMessageTypeFlagsEXT,
                                                  const VkDebugUtilsMessengerCallbackDataEXT* data,
                                                  void* user);
  void createInstance();
  void createDevice();

  std::mutex mutex_;
  std::vector<std::string> messages_;
  VkInstance instance_ = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  VkPhysicalDevice physical_ = VK_NULL_HANDLE;
  uint32_t family_ = 0;
  VkDevice device_ = VK_NULL_HANDLE;
  VkQueue queue_ = VK_NULL_HANDLE;
  VkCommandPool pool_ = VK_NULL_HANDLE;
};

// Host-visible and mapped.
class Buffer {
 public:
  Buffer(const Device& device, VkDeviceSize size);
  ~Buffer();
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;
  VkBuffer handle() const { return buffer_; }
  unsigned char* data() const { return data_; }
  VkDeviceSize size() const { return size_; }

 private:
  const Device& device_;
  VkDeviceSize size_;
  VkBuffer buffer_ = VK_NULL_HANDLE;
  VkDeviceMemory memory_ = VK_NULL_HANDLE;
  unsigned char* data_ = nullptr;
};

inline constexpr WlkVulkanImageState COPY_TARGET{VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 0,
                                                 VK_PIPELINE_STAGE_2_COPY_BIT,
                                                 VK_ACCESS_2_TRANSFER_WRITE_BIT};
inline constexpr WlkVulkanImageState COPY_SOURCE{VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, 0,
                                                 VK_PIPELINE_STAGE_2_COPY_BIT,
                                                 VK_ACCESS_2_TRANSFER_READ_BIT};
inline constexpr WlkVulkanImageState UNDEFINED{VK_IMAGE_LAYOUT_UNDEFINED, 0,
                                               VK_PIPELINE_STAGE_2_NONE, VK_ACCESS_2_NONE};

class Image {
 public:
  // depth > 1 makes a 3-D image. Transfer usages are added to `usage`.
  Image(const Device& device, VkFormat format, VkExtent3D extent, VkImageUsageFlags usage);
  ~Image();
  Image(const Image&) = delete;
  Image& operator=(const Image&) = delete;

  VkImage handle() const { return image_; }
  VkFormat format() const { return format_; }
  WlkVulkanImage imported(const WlkVulkanImageState& before,
                          const WlkVulkanImageState& after) const;
  void transition(VkCommandBuffer commands, const WlkVulkanImageState& from,
                  const WlkVulkanImageState& to) const;
  // Discards the contents, copies a buffer of encoded texels; leaves COPY_TARGET.
  void write(VkCommandBuffer commands, const Buffer& from) const;
  // Expects COPY_SOURCE.
  void read(VkCommandBuffer commands, const Buffer& to) const;

 private:
  VkBufferImageCopy wholeImage() const;
  const Device& device_;
  VkFormat format_;
  VkExtent3D extent_;
  VkImage image_ = VK_NULL_HANDLE;
  VkDeviceMemory memory_ = VK_NULL_HANDLE;
};

// Makes copies into host buffers readable after the fence.
void orderCopiesBeforeHost(VkCommandBuffer commands);

}  // namespace engine
