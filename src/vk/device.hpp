// SPDX-License-Identifier: MIT
// The device Welkin works on, borrowed from the engine or its own, and the resources made on it.
#pragma once

#include <welkin/welkin.h>

#include <memory_resource>
#include <optional>

#include "vk/dispatch.hpp"
#include "vk/memory.hpp"

namespace welkin::vk {

struct DeviceInfo {
  PFN_vkGetInstanceProcAddr getInstanceProcAddr = nullptr;
  VkInstance instance = VK_NULL_HANDLE;
  VkPhysicalDevice physicalDevice = VK_NULL_HANDLE;
  VkDevice device = VK_NULL_HANDLE;
  VkPipelineCache pipelineCache = VK_NULL_HANDLE;
  uint32_t queueFamilyIndex = 0;
  bool blend = false;  // dualSrcBlend and fragmentStoresAndAtomics are enabled
  bool headless = false;
  VkDeviceSize memoryLimit = 0;  // 0: none
};

class Device {
 public:
  Device(const DeviceInfo& info, std::pmr::memory_resource* host);
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  const Dispatch& vk() const { return vk_; }
  VkDevice handle() const { return info_.device; }
  const DeviceInfo& info() const { return info_; }
  const VkPhysicalDeviceProperties& properties() const { return properties_; }
  DeviceMemory& memory() { return *memory_; }
  bool supports(VkFormat format, VkFormatFeatureFlags features) const;
  // Whether buffers of rows of 16 bytes are read as texels (Buffer::texels): any buffer that the
  // device takes for storage then has a view of all its rows. Drivers such as lavapipe fetch a
  // texel for less than they read a word. Shaders read words where it is not so, and nothing is
  // bound in the place of texels.
  bool texels() const { return texels_; }
  // Whether the queue writes timestamps.
  bool timestamps() const { return timestampMask_ != 0; }
  // Between two timestamps of the queue, which starts again at 0 after its last valid bit.
  double nanoseconds(uint64_t from, uint64_t to) const {
    return static_cast<double>((to - from) & timestampMask_) *
           static_cast<double>(properties_.limits.timestampPeriod);
  }

 private:
  uint64_t timestampMask() const;
  DeviceInfo info_;
  Dispatch vk_;
  VkPhysicalDeviceProperties properties_{};
  bool texels_ = false;
  uint64_t timestampMask_ = 0;  // their valid bits; 0: none
  std::optional<DeviceMemory> memory_;
};

// Texels of a buffer's rows.
constexpr VkDeviceSize ROW_BYTES = 16;
constexpr VkDeviceSize wholeRows(VkDeviceSize bytes) {
  return (bytes + ROW_BYTES - 1) / ROW_BYTES * ROW_BYTES;
}
// Sampled images and texels of a set of Welkin's, at most: any device has room for so many.
constexpr uint32_t MOST_SAMPLED = 16;
// Of a buffer of such rows.
constexpr VkBufferUsageFlags ROWS =
    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT;

// A buffer with its memory; host-visible ones stay mapped. With
// VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT its rows are texels too where the device allows, the
// last one whole.
class Buffer {
 public:
  Buffer() = default;
  Buffer(Device& device, VkDeviceSize size, VkBufferUsageFlags usage, bool hostVisible);
  Buffer(Buffer&& other) noexcept { swap(other); }
  Buffer& operator=(Buffer&& other) noexcept {
    swap(other);
    return *this;
  }
  ~Buffer();
  explicit operator bool() const { return buffer_ != VK_NULL_HANDLE; }
  VkBuffer handle() const { return buffer_; }
  // Of VK_FORMAT_R32G32B32A32_UINT; null where there is none.
  VkBufferView texels() const { return texels_; }
  VkDeviceSize size() const { return size_; }
  void* data() const { return allocation_.mapped; }

 private:
  void swap(Buffer& other) noexcept;
  Device* device_ = nullptr;
  VkBuffer buffer_ = VK_NULL_HANDLE;
  VkBufferView texels_ = VK_NULL_HANDLE;
  VkDeviceSize size_ = 0;
  Allocation allocation_;
};

struct ImageInfo {
  VkImageType type = VK_IMAGE_TYPE_2D;
  VkFormat format = VK_FORMAT_UNDEFINED;
  VkExtent3D extent{1, 1, 1};
  uint32_t layers = 1;
  uint32_t levels = 1;
  VkImageUsageFlags usage = 0;
  bool arrayView = false;
};

// An image with its memory and one view of all of it.
class Image {
 public:
  Image() = default;
  Image(Device& device, const ImageInfo& info);
  Image(Image&& other) noexcept { swap(other); }
  Image& operator=(Image&& other) noexcept {
    swap(other);
    return *this;
  }
  ~Image();
  explicit operator bool() const { return image_ != VK_NULL_HANDLE; }
  VkImage handle() const { return image_; }
  VkImageView view() const { return view_; }
  const ImageInfo& info() const { return info_; }
  // Layout it has when the commands recorded so far have run.
  VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;

 private:
  void swap(Image& other) noexcept;
  Device* device_ = nullptr;
  VkImage image_ = VK_NULL_HANDLE;
  VkImageView view_ = VK_NULL_HANDLE;
  ImageInfo info_;
  Allocation allocation_;
};

// Whether a device can draw WLK_COMPOSITE_BLEND.
inline bool canBlend(const VkPhysicalDeviceFeatures& features) {
  return features.dualSrcBlend == VK_TRUE && features.fragmentStoresAndAtomics == VK_TRUE;
}

VkImageView createView(const Device& device, VkImage image, VkFormat format, VkImageViewType type,
                       const VkImageSubresourceRange& range);

}  // namespace welkin::vk
