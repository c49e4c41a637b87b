// SPDX-License-Identifier: MIT
#include "support/descriptor_ledger.hpp"

#include <algorithm>
#include <span>

namespace welkin::test {

void DescriptorLedger::made(VkDescriptorSetLayout layout,
                            const VkDescriptorSetLayoutCreateInfo& info) {
  Descriptors& needs = layouts_[layout] = {};
  for (const VkDescriptorSetLayoutBinding& b : std::span(info.pBindings, info.bindingCount)) {
    needs[b.descriptorType] += b.descriptorCount;
  }
}

void DescriptorLedger::made(VkDescriptorPool pool, const VkDescriptorPoolCreateInfo& info) {
  Pool& made = pools_[pool] = {};
  made.sets = info.maxSets;
  for (const VkDescriptorPoolSize& size : std::span(info.pPoolSizes, info.poolSizeCount)) {
    made.left[size.type] += size.descriptorCount;
  }
}

uint64_t DescriptorLedger::allocated(const VkDescriptorSetAllocateInfo& info) {
  uint64_t missing = 0;
  Pool& pool = pools_[info.descriptorPool];
  for (VkDescriptorSetLayout layout : std::span(info.pSetLayouts, info.descriptorSetCount)) {
    missing += --pool.sets < 0 ? 1U : 0U;
    for (const auto& [type, count] : layouts_[layout]) {
      int64_t& left = pool.left[type];
      left -= count;
      missing += left < 0 ? static_cast<uint64_t>(std::min(-left, count)) : 0;
    }
  }
  return missing;
}

}  // namespace welkin::test
