// SPDX-License-Identifier: MIT
#include "frame/bindings.hpp"

namespace welkin {
namespace {

// Mixes what a descriptor points to into one number. Handles are addresses or counters of the
// driver: two different bindings of one frame never agree in all inputs, and the constants spread
// them over 64 bits.
uint64_t mix(uint64_t a, uint64_t b, uint64_t c) {
  uint64_t x = a * 0x9e3779b97f4a7c15u;
  x = (x ^ x >> 29 ^ b) * 0xbf58476d1ce4e5b9u;
  x = (x ^ x >> 32 ^ c) * 0x94d049bb133111ebu;
  return x ^ x >> 31;
}

template <typename Handle>
uint64_t bits(Handle handle) {
  return reinterpret_cast<uint64_t>(handle);
}

VkWriteDescriptorSet writeOf(const BoundSet& set, uint32_t binding, VkDescriptorType type) {
  VkWriteDescriptorSet w{VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
  w.dstSet = set.set;
  w.dstBinding = binding;
  w.descriptorCount = 1;
  w.descriptorType = type;
  return w;
}

}  // namespace

bool Bindings::changed(BoundSet& set, uint32_t binding, uint64_t identity) {
  if (set.bound[binding] == identity) {
    return false;
  }
  set.bound[binding] = identity;
  return true;
}

void Bindings::write(const VkWriteDescriptorSet& write) {
  device_.vk().UpdateDescriptorSets(device_.handle(), 1, &write, 0, nullptr);
  ++writes_;
}

void Bindings::image(BoundSet& set, uint32_t binding, VkImageView view, VkSampler sampler,
                     VkImageLayout layout) {
  if (!changed(set, binding, mix(bits(view), bits(sampler), layout))) {
    return;
  }
  const VkDescriptorImageInfo info{sampler, view, layout};
  VkWriteDescriptorSet w =
      writeOf(set, binding,
              sampler == VK_NULL_HANDLE ? VK_DESCRIPTOR_TYPE_STORAGE_IMAGE
                                        : VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER);
  w.pImageInfo = &info;
  write(w);
}

void Bindings::buffer(BoundSet& set, uint32_t binding, VkDescriptorType type, VkBuffer buffer,
                      VkDeviceSize offset, VkDeviceSize range) {
  if (!changed(set, binding, mix(bits(buffer), offset, range))) {
    return;
  }
  const VkDescriptorBufferInfo info{buffer, offset, range};
  VkWriteDescriptorSet w = writeOf(set, binding, type);
  w.pBufferInfo = &info;
  write(w);
}

void Bindings::texels(BoundSet& set, uint32_t binding, const vk::Buffer& buffer) {
  const VkBufferView view = buffer.texels();
  if (view == VK_NULL_HANDLE || !changed(set, binding, mix(bits(view), 0, 0))) {
    return;
  }
  VkWriteDescriptorSet w = writeOf(set, binding, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER);
  w.pTexelBufferView = &view;
  write(w);
}

}  // namespace welkin
