// SPDX-License-Identifier: MIT
// Writes descriptors only where they change: a steady frame writes none.
#pragma once

#include "frame/scene.hpp"

namespace welkin {

class Bindings {
 public:
  explicit Bindings(const vk::Device& device) : device_(device) {}
  // A storage image without a sampler, a sampled one with it.
  void image(BoundSet& set, uint32_t binding, VkImageView view, VkSampler sampler,
             VkImageLayout layout);
  void buffer(BoundSet& set, uint32_t binding, VkDescriptorType type, VkBuffer buffer,
              VkDeviceSize offset, VkDeviceSize range);
  // Its rows as texels where they are; else nothing, which no shader then reads.
  void texels(BoundSet& set, uint32_t binding, const vk::Buffer& buffer);
  uint32_t writes() const { return writes_; }

 private:
  bool changed(BoundSet& set, uint32_t binding, uint64_t identity);
  void write(const VkWriteDescriptorSet& write);

  const vk::Device& device_;
  uint32_t writes_ = 0;
};

}  // namespace welkin
