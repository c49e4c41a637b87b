// SPDX-License-Identifier: MIT
// Images of the engine: what the caller says of them, and views of the part that is used.
#pragma once

#include "api/context.hpp"

namespace welkin {

// A copy of the caller's description, with its image, subresources and `after` checked; errors name
// `role`. One layer, or up to `mostLayers`.
WlkVulkanImage checkedEngineImage(const WlkVulkanImage* image, const char* role,
                                  uint32_t mostLayers = 1);

// Throws unless the image has this size. `of` says whose it is.
void checkImageSize(const WlkVulkanImage& image, const char* role, const char* of, uint32_t width,
                    uint32_t height, uint32_t depth = 1);

// What is viewed, and what barriers move: the mip level and layers that were named, no other.
VkImageSubresourceRange rangeOf(const WlkVulkanImage& image, VkImageAspectFlags aspect);

// View of an engine's image from the cache, made when it is new.
VkImageView importView(WlkContext_T& context, const WlkVulkanImage& image, VkImageViewType type,
                       VkImageAspectFlags aspect = VK_IMAGE_ASPECT_COLOR_BIT);

// An image for commands: `read` is viewed, `moved` goes from `before` to `after`.
TargetImage importTarget(WlkContext_T& context, const WlkVulkanImage& image, VkImageViewType type,
                         VkImageAspectFlags read = VK_IMAGE_ASPECT_COLOR_BIT,
                         VkImageAspectFlags moved = VK_IMAGE_ASPECT_COLOR_BIT);

}  // namespace welkin
