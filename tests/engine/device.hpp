// SPDX-License-Identifier: MIT
// An engine's Vulkan device under validation, with images and buffers on it.
#pragma once

#include <vulkan/vulkan.h>
#include <welkin/welkin_vulkan.h>

#include "support/test_device.hpp"

namespace engine {

using support::Buffer;
using support::check;

// Its destructor fails the test if the validation layer said anything, objects left over included.
class Device : public support::TestDevice {
 public:
  Device();
  ~Device();

  bool supports(VkFormat format, VkFormatFeatureFlags features) const;
  WlkVulkanDeviceInfo info() const;
};

inline constexpr WlkVulkanImageState COPY_TARGET{VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 0,
                                                 VK_PIPELINE_STAGE_2_COPY_BIT,
                                                 VK_ACCESS_2_TRANSFER_WRITE_BIT};
inline constexpr WlkVulkanImageState COPY_SOURCE{VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, 0,
                                                 VK_PIPELINE_STAGE_2_COPY_BIT,
                                                 VK_ACCESS_2_TRANSFER_READ_BIT};
inline constexpr WlkVulkanImageState UNDEFINED{VK_IMAGE_LAYOUT_UNDEFINED, 0,
                                               VK_PIPELINE_STAGE_2_NONE, VK_ACCESS_2_NONE};

class Image : public support::Image {
 public:
  using support::Image::Image;

  WlkVulkanImage imported(const WlkVulkanImageState& before,
                          const WlkVulkanImageState& after) const;
  void transition(VkCommandBuffer commands, const WlkVulkanImageState& from,
                  const WlkVulkanImageState& to) const;
  // Of some layers alone.
  void transition(VkCommandBuffer commands, const WlkVulkanImageState& from,
                  const WlkVulkanImageState& to, uint32_t firstLayer, uint32_t count) const;
  // Discards the contents, copies a buffer of encoded texels; leaves COPY_TARGET.
  void write(VkCommandBuffer commands, const Buffer& from) const;
  // Expects COPY_SOURCE.
  void read(VkCommandBuffer commands, const Buffer& to) const;

 private:
  VkBufferImageCopy wholeImage() const;
};

// Makes copies into host buffers readable after the fence.
void orderCopiesBeforeHost(VkCommandBuffer commands);

}  // namespace engine
