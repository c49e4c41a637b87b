// SPDX-License-Identifier: MIT
#include "targets.hpp"

Targets::Targets(const Gpu& gpu, VkExtent2D extent, uint32_t composite)
    : color(gpu, extent, COLOR_FORMAT,
            VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT |
                (composite == WLK_COMPOSITE_COMPUTE ? VkImageUsageFlags{VK_IMAGE_USAGE_STORAGE_BIT}
                                                    : VkImageUsageFlags{0}),
            VK_IMAGE_ASPECT_COLOR_BIT),
      depth(gpu, extent, DEPTH_FORMAT,
            VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
            VK_IMAGE_ASPECT_DEPTH_BIT) {
  if (composite == WLK_COMPOSITE_SEPARATE) {
    constexpr VkImageUsageFlags usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
    radiance.emplace(gpu, extent, COLOR_FORMAT, usage, VK_IMAGE_ASPECT_COLOR_BIT);
    transmittance.emplace(gpu, extent, COLOR_FORMAT, usage, VK_IMAGE_ASPECT_COLOR_BIT);
  }
}
