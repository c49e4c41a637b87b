// SPDX-License-Identifier: MIT
#include "engine/screenshot.hpp"

#include <stdexcept>
#include <utility>
#include <vector>

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#endif
#include <stb/stb_image_write.h>
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

Screenshot::Screenshot(const Gpu& gpu, VkExtent2D extent, VkFormat format)
    : extent_(extent),
      format_(format),
      pixels_(gpu, VkDeviceSize{extent.width} * extent.height * 4,
              VK_BUFFER_USAGE_TRANSFER_DST_BIT) {}

void Screenshot::record(VkCommandBuffer commands, VkImage image) const {
  transition(commands, image, VK_IMAGE_ASPECT_COLOR_BIT, COLOR_ATTACHMENT, TRANSFER_SOURCE);
  VkBufferImageCopy region{};
  region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  region.imageExtent = {extent_.width, extent_.height, 1};
  vkCmdCopyImageToBuffer(commands, image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, pixels_.handle(), 1,
                         &region);
  VkMemoryBarrier2 toHost{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
  toHost.srcStageMask = VK_PIPELINE_STAGE_2_TRANSFER_BIT;
  toHost.srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
  toHost.dstStageMask = VK_PIPELINE_STAGE_2_HOST_BIT;
  toHost.dstAccessMask = VK_ACCESS_2_HOST_READ_BIT;
  VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
  info.memoryBarrierCount = 1;
  info.pMemoryBarriers = &toHost;
  vkCmdPipelineBarrier2(commands, &info);
}

void Screenshot::save(const std::string& path) const {
  const auto* bytes = static_cast<const uint8_t*>(pixels_.data());
  std::vector<uint8_t> rgba(bytes, bytes + size_t{extent_.width} * extent_.height * 4);
  const bool blueFirst = format_ == VK_FORMAT_B8G8R8A8_SRGB;
  for (size_t i = 0; i < rgba.size(); i += 4) {
    if (blueFirst) {
      std::swap(rgba[i], rgba[i + 2]);
    }
    rgba[i + 3] = 255;
  }
  const int width = static_cast<int>(extent_.width);
  if (stbi_write_png(path.c_str(), width, static_cast<int>(extent_.height), 4, rgba.data(),
                     4 * width) == 0) {
    throw std::runtime_error(path + ": cannot be written");
  }
}
