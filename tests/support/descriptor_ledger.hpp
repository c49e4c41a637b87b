// SPDX-License-Identifier: MIT
// What descriptor sets take from their pools, by type: drivers may count that, and need not.
#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <map>

namespace welkin::test {

class DescriptorLedger {
 public:
  void made(VkDescriptorSetLayout layout, const VkDescriptorSetLayoutCreateInfo& info);
  void made(VkDescriptorPool pool, const VkDescriptorPoolCreateInfo& info);
  // Returns how many descriptors and sets the pool does not have.
  uint64_t allocated(const VkDescriptorSetAllocateInfo& info);

 private:
  using Descriptors = std::map<VkDescriptorType, int64_t>;
  struct Pool {
    Descriptors left;
    int64_t sets = 0;
  };
  std::map<VkDescriptorSetLayout, Descriptors> layouts_;
  std::map<VkDescriptorPool, Pool> pools_;
};

}  // namespace welkin::test
