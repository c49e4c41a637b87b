// SPDX-License-Identifier: MIT
// A Vulkan device without validation, whose images and buffers live as long as it: the engine's
// side of a benchmark in which the library and something else do the same on one device. Times in
// ms.
#pragma once

#include <vulkan/vulkan.h>
#include <welkin/welkin_vulkan.h>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "support/test_device.hpp"

namespace bench {

using support::check;

struct GpuImage {
  VkImage handle = VK_NULL_HANDLE;
  VkImageView view = VK_NULL_HANDLE;
  VkFormat format = VK_FORMAT_UNDEFINED;
  VkExtent3D extent{};
};

struct GpuBuffer {
  VkBuffer handle = VK_NULL_HANDLE;
  void* data = nullptr;  // mapped
};

// As the library is told of it: a compute shader writes and reads it in the general layout.
WlkVulkanImage described(const GpuImage& image);

// Images of one size that a frame is drawn with; depth is reversed and infinite.
struct GpuTargets {
  GpuImage depth;
  GpuImage color;
  GpuImage target;
};

// What a frame recorded.
struct GpuCounts {
  uint64_t dispatches = 0;
  uint64_t invocations = 0;
  uint64_t bytes = 0;  // of device memory
  std::vector<std::pair<std::string, double>> passes_ms;
};

class Gpu {
 public:
  explicit Gpu(bool validation = false);
  ~Gpu();
  Gpu(const Gpu&) = delete;
  Gpu& operator=(const Gpu&) = delete;

  VkDevice handle() const { return device_.handle(); }
  const VkPhysicalDeviceProperties& properties() const { return device_.properties(); }
  // Of the driver.
  std::string driver() const;
  WlkVulkanDeviceInfo info() const;

  // In layout GENERAL, where it stays. Sampled and stored to, and what else is asked for.
  GpuImage makeImage(VkFormat format, VkExtent3D extent, VkImageUsageFlags more = 0);
  GpuBuffer makeBuffer(VkDeviceSize size, VkBufferUsageFlags usage);
  // Of texels of 4 or 16 bytes.
  void upload(const GpuImage& image, std::span<const float> texels);
  // Any texels.
  void uploadBytes(const GpuImage& image, std::span<const std::byte> bytes);
  std::vector<float> download(const GpuImage& image);

  // Records, submits, waits; the time between the first and the last command.
  double run(const std::function<void(VkCommandBuffer)>& record);

  // Messages of the validation layer.
  const std::vector<std::string>& messages() const { return device_.messages(); }

 private:
  GpuBuffer staging(VkDeviceSize size);

  support::TestDevice device_;
  VkQueryPool queries_ = VK_NULL_HANDLE;
  std::deque<support::Image> images_;
  std::vector<VkImageView> views_;
  std::deque<support::Buffer> buffers_;
  GpuBuffer staging_;
  VkDeviceSize stagingSize_ = 0;
};

}  // namespace bench
