// SPDX-License-Identifier: MIT
// A test's own Vulkan device: validation whose messages are kept, one queue, command buffers that
// are submitted and waited for, mapped buffers and images. It knows nothing of Welkin.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

namespace support {

// Throws std::runtime_error.
void check(VkResult result, const char* call);

// The Khronos layer.
bool validationInstalled();

struct DeviceOptions {
  bool validation = true;       // synchronisation validation included
  bool preferSoftware = false;  // the first llvmpipe device, else the first device
  VkQueueFlags queueFlags = VK_QUEUE_COMPUTE_BIT;
  uint32_t timestampBits = 0;  // of the queue, at least
  VkPhysicalDeviceFeatures features{};
  VkPhysicalDeviceVulkan13Features features13{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
};

// Throws std::runtime_error where a Vulkan call fails or there is no such device or queue.
class TestDevice {
 public:
  explicit TestDevice(const DeviceOptions& options);
  ~TestDevice();
  TestDevice(const TestDevice&) = delete;
  TestDevice& operator=(const TestDevice&) = delete;

  VkInstance instance() const { return instance_; }
  VkPhysicalDevice physical() const { return physical_; }
  const VkPhysicalDeviceProperties& properties() const { return properties_; }
  VkDevice handle() const { return device_; }
  uint32_t family() const { return family_; }
  VkDeviceMemory allocate(const VkMemoryRequirements& needs, VkMemoryPropertyFlags flags) const;

  // A command buffer that is being recorded.
  VkCommandBuffer begin();
  // Ends and submits it; nothing waits.
  void submit(VkCommandBuffer commands);
  // Waits for everything; begin() hands out the same command buffers again.
  void wait();
  // Begins, records, submits, waits.
  void run(const std::function<void(VkCommandBuffer)>& record);

  bool validated() const { return messenger_ != VK_NULL_HANDLE; }
  // Warnings and errors of the validation layer.
  const std::vector<std::string>& messages() const { return messages_; }
  // What the destructor does, for whoever reads the messages about objects left over.
  void destroy();

 private:
  void makeInstance(bool validation);
  void choosePhysical(bool preferSoftware);
  void makeDevice(const DeviceOptions& options);

  std::mutex mutex_;  // the layer speaks from any thread
  std::vector<std::string> messages_;
  VkInstance instance_ = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  VkPhysicalDevice physical_ = VK_NULL_HANDLE;
  VkPhysicalDeviceProperties properties_{};
  uint32_t family_ = 0;
  VkDevice device_ = VK_NULL_HANDLE;
  VkQueue queue_ = VK_NULL_HANDLE;
  VkCommandPool pool_ = VK_NULL_HANDLE;
  std::vector<VkCommandBuffer> commands_;
  size_t begun_ = 0;
};

// Host-visible, coherent and mapped.
class Buffer {
 public:
  Buffer(const TestDevice& device, VkDeviceSize size,
         VkBufferUsageFlags usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT |
                                    VK_BUFFER_USAGE_TRANSFER_DST_BIT);
  ~Buffer();
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;
  VkBuffer handle() const { return buffer_; }
  unsigned char* data() const { return data_; }
  VkDeviceSize size() const { return size_; }

 private:
  const TestDevice& device_;
  VkDeviceSize size_;
  VkBuffer buffer_ = VK_NULL_HANDLE;
  VkDeviceMemory memory_ = VK_NULL_HANDLE;
  unsigned char* data_ = nullptr;
};

// One level, one layer, in the device's own memory.
class Image {
 public:
  // depth > 1 makes a 3-D image. Transfer usages are added to `usage`.
  Image(const TestDevice& device, VkFormat format, VkExtent3D extent, VkImageUsageFlags usage,
        uint32_t layers = 1);
  ~Image();
  Image(const Image&) = delete;
  Image& operator=(const Image&) = delete;
  VkImage handle() const { return image_; }
  VkFormat format() const { return format_; }
  VkExtent3D extent() const { return extent_; }
  uint32_t layers() const { return layers_; }

 private:
  const TestDevice& device_;
  VkFormat format_;
  VkExtent3D extent_;
  uint32_t layers_;
  VkImage image_ = VK_NULL_HANDLE;
  VkDeviceMemory memory_ = VK_NULL_HANDLE;
};

}  // namespace support
