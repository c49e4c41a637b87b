// SPDX-License-Identifier: MIT
// Device memory for Welkin's own buffers and images: blocks of 16 MiB handed out first-fit, larger
// resources alone. Few vkAllocateMemory calls (devices allow 4096), no other dependency.
#pragma once

#include <memory_resource>
#include <vector>

#include "vk/dispatch.hpp"

namespace welkin::vk {

struct Allocation {
  uint32_t block = ~0u;
  VkDeviceSize offset = 0;
  VkDeviceSize size = 0;
  void* mapped = nullptr;
};

class DeviceMemory {
 public:
  // At most `limit` bytes in all; 0: no limit.
  DeviceMemory(const Dispatch& table, VkPhysicalDevice physical, VkDevice device,
               VkDeviceSize limit, std::pmr::memory_resource* host);
  ~DeviceMemory();
  DeviceMemory(const DeviceMemory&) = delete;
  DeviceMemory& operator=(const DeviceMemory&) = delete;

  // Linear: a buffer; optimal images and buffers never share a block (bufferImageGranularity).
  Allocation allocate(const VkMemoryRequirements& needs, bool hostVisible, bool linear);
  void release(const Allocation& allocation);
  VkDeviceMemory memoryOf(const Allocation& allocation) const;
  VkDeviceSize bytes() const { return bytes_; }
  // Size of the largest heap: nothing larger can ever be had.
  VkDeviceSize largestHeap() const { return largestHeap_; }

 private:
  struct Range {
    VkDeviceSize offset;
    VkDeviceSize size;
  };
  struct Block {
    VkDeviceMemory memory;
    VkDeviceSize size;
    void* mapped;
    uint32_t type;
    bool linear;
    size_t live;  // allocations; free ranges are at most live + 1
    std::pmr::vector<Range> free;
  };
  uint32_t memoryType(uint32_t bits, bool hostVisible) const;
  bool place(Block& block, const VkMemoryRequirements& needs, Allocation& result);
  VkDeviceSize blockSize(VkDeviceSize needed) const;
  uint32_t newBlock(VkDeviceSize size, uint32_t type, bool hostVisible, bool linear);

  const Dispatch& vk_;
  VkDevice device_;
  VkPhysicalDeviceMemoryProperties properties_{};
  std::pmr::vector<Block> blocks_;
  VkDeviceSize limit_;
  VkDeviceSize bytes_ = 0;
  VkDeviceSize largestHeap_ = 0;
};

}  // namespace welkin::vk
