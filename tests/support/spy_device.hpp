// SPDX-License-Identifier: MIT
// The engine's side of the engine-device mode: a Vulkan device under validation whose
// vkGetInstanceProcAddr hands out functions that count their calls.
#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <vector>

namespace welkin::test {

// Calls through the spied functions since the last reset.
struct VulkanCounts {
  uint64_t dispatches = 0;
  uint64_t draws = 0;
  uint64_t barriers = 0;          // vkCmdPipelineBarrier2
  uint64_t copies = 0;            // vkCmdCopy*, vkCmdFillBuffer, vkCmdUpdateBuffer, vkCmdClear*
  uint64_t created = 0;           // vkCreate*
  uint64_t destroyed = 0;         // vkDestroy*
  uint64_t allocated = 0;         // vkAllocate*
  uint64_t descriptorWrites = 0;  // writes and copies of vkUpdateDescriptorSets
  uint64_t timestamps = 0;        // vkCmdWriteTimestamp2
  uint64_t descriptorsShort = 0;  // descriptors and sets beyond what their pools were made for
};

class SpyDevice {
 public:
  // Validation with synchronisation validation; messages land in messages().
  explicit SpyDevice(bool validation = true);
  ~SpyDevice();
  SpyDevice(const SpyDevice&) = delete;
  SpyDevice& operator=(const SpyDevice&) = delete;

  VkInstance instance = VK_NULL_HANDLE;
  VkPhysicalDevice physical = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  VkQueue queue = VK_NULL_HANDLE;
  uint32_t family = 0;

  // What the library gets instead of the loader's.
  static PFN_vkGetInstanceProcAddr getInstanceProcAddr();
  static VulkanCounts& counts();
  // Every name that the library asked of vkGetDeviceProcAddr.
  static const std::set<std::string>& namesAsked();

  // Until the next spied device dies: queues tell of as many bits in their timestamps, and each one
  // read is TICK after the last, the second of them beyond those bits.
  static constexpr uint64_t TICK = 1000;
  static void fakeTimestamps(uint32_t bits);
  // Likewise: devices tell of buffers of as many texels at most.
  static void fakeTexels(uint32_t most);

  // Records with `record`, submits, waits. Where `record` throws, nothing is submitted.
  void run(const std::function<void(VkCommandBuffer)>& record) const;
  // Records and throws away.
  void record(const std::function<void(VkCommandBuffer)>& record) const;
  const std::vector<std::string>& messages() const { return messages_; }

 private:
  void createInstance(bool validation);
  void createDevice();
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  VkCommandPool pool_ = VK_NULL_HANDLE;
  VkCommandBuffer commands_ = VK_NULL_HANDLE;
  VkFence fence_ = VK_NULL_HANDLE;
  std::vector<std::string> messages_;
};

// An image of the engine and, if it is 2-D, a buffer to read it through.
class SpyImage {
 public:
  SpyImage(const SpyDevice& spy, VkFormat format, VkExtent3D extent, VkImageUsageFlags usage);
  ~SpyImage();
  SpyImage(const SpyImage&) = delete;
  SpyImage& operator=(const SpyImage&) = delete;

  VkImage handle = VK_NULL_HANDLE;
  VkFormat format;
  VkExtent3D extent;
  // Copies the buffer into the image and leaves it in `after`, or back from `before`. Texels are
  // 16 bytes at most.
  void* bytes() const { return mapped_; }
  void write(VkImageLayout after) const;
  void read(VkImageLayout before) const;

 private:
  VkDeviceMemory allocate(const VkMemoryRequirements& needs, bool hostVisible) const;
  void copy(bool toImage, VkImageLayout from, VkImageLayout to) const;
  const SpyDevice& spy_;
  VkDeviceMemory memory_ = VK_NULL_HANDLE;
  VkBuffer buffer_ = VK_NULL_HANDLE;
  VkDeviceMemory bufferMemory_ = VK_NULL_HANDLE;
  void* mapped_ = nullptr;
};

}  // namespace welkin::test
