// SPDX-License-Identifier: MIT
#include "vk/memory.hpp"

#include <algorithm>

#include "failure.hpp"

namespace welkin::vk {
namespace {

constexpr VkDeviceSize BLOCK_SIZE = VkDeviceSize{16} << 20;

VkDeviceSize alignUp(VkDeviceSize x, VkDeviceSize alignment) {
  return (x + alignment - 1) / alignment * alignment;
}

}  // namespace

DeviceMemory::DeviceMemory(const Dispatch& table, VkPhysicalDevice physical, VkDevice device,
                           VkDeviceSize limit, std::pmr::memory_resource* host)
    : vk_(table), device_(device), blocks_(host), limit_(limit != 0 ? limit : ~VkDeviceSize{0}) {
  vk_.GetPhysicalDeviceMemoryProperties(physical, &properties_);
  for (uint32_t i = 0; i < properties_.memoryHeapCount; ++i) {
    largestHeap_ = std::max(largestHeap_, properties_.memoryHeaps[i].size);
  }
}

DeviceMemory::~DeviceMemory() {
  for (const Block& block : blocks_) {
    if (block.memory != VK_NULL_HANDLE) {
      vk_.FreeMemory(device_, block.memory, nullptr);
    }
  }
}

uint32_t DeviceMemory::memoryType(uint32_t bits, bool hostVisible) const {
  constexpr VkMemoryPropertyFlags host =
      VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
  const VkMemoryPropertyFlags wanted =
      hostVisible ? host : VkMemoryPropertyFlags{VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT};
  for (VkMemoryPropertyFlags flags : {wanted, hostVisible ? host : VkMemoryPropertyFlags{0}}) {
    for (uint32_t i = 0; i < properties_.memoryTypeCount; ++i) {
      if ((bits >> i & 1u) != 0 && (properties_.memoryTypes[i].propertyFlags & flags) == flags) {
        return i;
      }
    }
  }
  fail(WLK_ERROR_OUT_OF_DEVICE_MEMORY, 0, "memoryType", "no memory type fits the resource");
}

bool DeviceMemory::place(Block& block, const VkMemoryRequirements& needs, Allocation& result) {
  for (size_t i = 0; i < block.free.size(); ++i) {
    const Range range = block.free[i];
    const VkDeviceSize begin = alignUp(range.offset, needs.alignment);
    if (begin + needs.size > range.offset + range.size) {
      continue;
    }
    // Room for every range that splitting now and releasing later can make: release never throws.
    block.free.reserve(block.live + 3);
    ++block.live;
    block.free.erase(block.free.begin() + static_cast<std::ptrdiff_t>(i));
    if (begin > range.offset) {
      block.free.push_back({range.offset, begin - range.offset});
    }
    const VkDeviceSize end = begin + needs.size;
    if (end < range.offset + range.size) {
      block.free.push_back({end, range.offset + range.size - end});
    }
    result.offset = begin;
    result.size = needs.size;
    result.mapped = block.mapped == nullptr ? nullptr : static_cast<char*>(block.mapped) + begin;
    return true;
  }
  return false;
}

VkDeviceSize DeviceMemory::blockSize(VkDeviceSize needed) const {
  const VkDeviceSize room = limit_ - bytes_;
  if (needed > room) {
    fail(WLK_ERROR_OUT_OF_DEVICE_MEMORY, WLK_STRUCT_CONTEXT_INFO, "deviceMemoryLimit",
         "%llu bytes more than the %llu in use exceed WlkContextInfo::deviceMemoryLimit, %llu",
         static_cast<unsigned long long>(needed), static_cast<unsigned long long>(bytes_),
         static_cast<unsigned long long>(limit_));
  }
  // The last block under a limit may be a small one.
  return std::max(needed, std::min(BLOCK_SIZE, room));
}

uint32_t DeviceMemory::newBlock(VkDeviceSize size, uint32_t type, bool hostVisible, bool linear) {
  size_t slot = 0;
  while (slot < blocks_.size() && blocks_[slot].memory != VK_NULL_HANDLE) {
    ++slot;
  }
  if (slot == blocks_.size()) {
    blocks_.push_back({VK_NULL_HANDLE, 0, nullptr, 0, false, 0,
                       std::pmr::vector<Range>(blocks_.get_allocator().resource())});
  }
  Block& block = blocks_[slot];
  block.free.clear();
  block.free.reserve(4);
  VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, nullptr, size, type};
  VkDeviceMemory memory = VK_NULL_HANDLE;
  check(vk_.AllocateMemory(device_, &info, nullptr, &memory), "vkAllocateMemory");
  void* mapped = nullptr;
  if (hostVisible) {
    const VkResult result = vk_.MapMemory(device_, memory, 0, VK_WHOLE_SIZE, 0, &mapped);
    if (result < 0) {
      vk_.FreeMemory(device_, memory, nullptr);
      check(result, "vkMapMemory");
    }
  }
  block.memory = memory;
  block.size = size;
  block.mapped = mapped;
  block.type = type;
  block.linear = linear;
  block.live = 0;
  block.free.push_back({0, size});
  bytes_ += size;
  return static_cast<uint32_t>(slot);
}

Allocation DeviceMemory::allocate(const VkMemoryRequirements& needs, bool hostVisible,
                                  bool linear) {
  if (needs.size > largestHeap_) {
    fail(WLK_ERROR_OUT_OF_DEVICE_MEMORY, 0, "size",
         "a resource of %llu bytes exceeds the device's largest heap of %llu",
         static_cast<unsigned long long>(needs.size),
         static_cast<unsigned long long>(largestHeap_));
  }
  const uint32_t type = memoryType(needs.memoryTypeBits, hostVisible);
  Allocation result;
  for (uint32_t i = 0; i < blocks_.size(); ++i) {
    Block& block = blocks_[i];
    if (block.memory != VK_NULL_HANDLE && block.type == type && block.linear == linear &&
        (block.mapped != nullptr) == hostVisible && place(block, needs, result)) {
      result.block = i;
      return result;
    }
  }
  result.block = newBlock(blockSize(needs.size), type, hostVisible, linear);
  if (!place(blocks_[result.block], needs, result)) {
    fail(WLK_ERROR_INTERNAL, 0, "size", "a fresh block did not hold its resource");
  }
  return result;
}

void DeviceMemory::release(const Allocation& allocation) {
  if (allocation.block == ~0u) {
    return;
  }
  Block& block = blocks_[allocation.block];
  // Merge with free neighbours; the vector keeps its room, so this cannot throw.
  Range range{allocation.offset, allocation.size};
  for (size_t i = 0; i < block.free.size();) {
    const Range other = block.free[i];
    if (other.offset + other.size == range.offset || range.offset + range.size == other.offset) {
      range = {std::min(range.offset, other.offset), range.size + other.size};
      block.free[i] = block.free.back();
      block.free.pop_back();
      i = 0;
    } else {
      ++i;
    }
  }
  --block.live;
  if (range.size == block.size) {
    vk_.FreeMemory(device_, block.memory, nullptr);
    bytes_ -= block.size;
    block.memory = VK_NULL_HANDLE;
    block.free.clear();
    return;
  }
  block.free.push_back(range);
}

VkDeviceMemory DeviceMemory::memoryOf(const Allocation& allocation) const {
  return blocks_[allocation.block].memory;
}

}  // namespace welkin::vk
