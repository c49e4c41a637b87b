// SPDX-License-Identifier: MIT
#include "api/engine_image.hpp"

#include <welkin/welkin_vulkan.h>

namespace welkin {

WlkVulkanImage checkedEngineImage(const WlkVulkanImage* image, const char* role,
                                  uint32_t mostLayers) {
  const WlkVulkanImage i = copyStruct(image, WLK_STRUCT_VULKAN_IMAGE);
  checkNoChain(image);
  if (i.image == VK_NULL_HANDLE) {
    fail(WLK_ERROR_INVALID_ARGUMENT, i.sType, role, "WlkVulkanImage::image of %s is null", role);
  }
  if (i.after.layout == VK_IMAGE_LAYOUT_UNDEFINED ||
      i.after.layout == VK_IMAGE_LAYOUT_PREINITIALIZED) {
    fail(WLK_ERROR_INVALID_ARGUMENT, i.sType, role, "%s: after.layout must be a real layout", role);
  }
  // No image of Vulkan's has more levels or, of any device known, layers; the driver is not asked.
  checkRange(i.sType, "mipLevel", i.mipLevel, 0, 31);
  checkRange(i.sType, "baseArrayLayer", i.baseArrayLayer, 0, i.depth > 1 ? 0 : 65535);
  checkRange(i.sType, "layerCount", i.layerCount, 1, mostLayers);
  return i;
}

void checkImageSize(const WlkVulkanImage& image, const char* role, const char* of, uint32_t width,
                    uint32_t height, uint32_t depth) {
  if (image.width != width || image.height != height || image.depth != depth) {
    fail(WLK_ERROR_INVALID_ARGUMENT, image.sType, role,
         "%s has %u x %u x %u texels, the %s %u x %u x %u", role, image.width, image.height,
         image.depth, of, width, height, depth);
  }
}

VkImageSubresourceRange rangeOf(const WlkVulkanImage& image, VkImageAspectFlags aspect) {
  return {aspect, image.mipLevel, 1, image.baseArrayLayer, image.layerCount};
}

VkImageView importView(WlkContext_T& c, const WlkVulkanImage& image, VkImageViewType type,
                       VkImageAspectFlags aspect) {
  for (const ImportedView& known : c.imported) {
    if (known.image == image.image && known.type == type && known.format == image.format &&
        known.mipLevel == image.mipLevel && known.baseArrayLayer == image.baseArrayLayer &&
        known.layerCount == image.layerCount) {
      return known.view;
    }
  }
  c.imported.reserve(c.imported.size() + 1);
  const VkImageView view =
      vk::createView(*c.device, image.image, image.format, type, rangeOf(image, aspect));
  c.imported.push_back({image.image, type, image.format, image.mipLevel, image.baseArrayLayer,
                        image.layerCount, view});
  return view;
}

TargetImage importTarget(WlkContext_T& c, const WlkVulkanImage& image, VkImageViewType type,
                         VkImageAspectFlags read, VkImageAspectFlags moved) {
  TargetImage target;
  target.image = image.image;
  target.view = importView(c, image, type, read);
  target.range = rangeOf(image, moved);
  target.before = image.before;
  target.after = image.after;
  return target;
}

}  // namespace welkin
