// SPDX-License-Identifier: MIT
#include "frame/surface_buffers.hpp"

#include <algorithm>

#include "failure.hpp"
#include "frame/frame_commands.hpp"
#include "frame/resources.hpp"

namespace welkin {

using interface_::SurfaceFaces;

VkDeviceSize coverBytes(VkDeviceSize pixels, bool further) {
  return pixels * (sizeof(interface_::SurfaceCover) + (further ? sizeof(uint32_t) : 0));
}

// Of pixels, and before of large triangles: shaders/interface/surface.glsl.
static VkDeviceSize surfaceListBytes(const WlkViewInfo& info, const SliceQuality& quality) {
  const VkDeviceSize pixels = VkDeviceSize{info.width} * info.height;
  return sizeof(uint32_t) *
         std::max<VkDeviceSize>(
             interface_::SURFACE_LIST_HEAD + pixels * (quality.halfVolumes ? 2 : 1),
             interface_::SURFACE_LARGE_HEAD + interface_::SURFACE_LARGE_MOST);
}

void makeSurfaces(vk::Device& device, const WlkViewInfo& info, const SliceQuality& quality,
                  uint32_t surfaces, ViewResources& r) {
  r.surfaceCapacity = surfaces;
  if (surfaces == 0) {
    return;
  }
  const uint32_t size = surfaceMapSize(quality);
  const VkDeviceSize texels = VkDeviceSize{size} * size;
  const VkDeviceSize pixels = std::max(VkDeviceSize{info.width} * info.height, texels);
  const VkDeviceSize bytes = vk::wholeRows(coverBytes(pixels, true));
  if (bytes > device.properties().limits.maxStorageBufferRange) {
    fail(WLK_ERROR_LIMIT_EXCEEDED, WLK_STRUCT_VIEW_INFO, "width",
         "%u x %u pixels with cloud surfaces exceed the device's storage buffers", info.width,
         info.height);
  }
  constexpr VkBufferUsageFlags CLEARED =
      VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
  r.surfaceCover = vk::Buffer(device, bytes, vk::ROWS | CLEARED, false);
  r.surfaceList = vk::Buffer(device, surfaceListBytes(info, quality),
                             CLEARED | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT, false);
  r.surfaceFaces = vk::Buffer(device, texels * sizeof(SurfaceFaces), CLEARED, false);
  r.surfaceLevels =
      vk::Buffer(device, VkDeviceSize{32} * surfaceMapTexels(size),
                 VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT, false);
}

VkDeviceSize uploadSurface(const vk::Device& device, VkCommandBuffer commands,
                           SurfaceState& surface) {
  const vk::Dispatch& vk = device.vk();
  VkDeviceSize bytes = 0;
  const auto copy = [&](const vk::Buffer& from, vk::Image& to) {
    if (!from) {
      return;
    }
    const WlkVulkanImageState target{VK_IMAGE_LAYOUT_GENERAL, 0, VK_PIPELINE_STAGE_2_TRANSFER_BIT,
                                     VK_ACCESS_2_TRANSFER_WRITE_BIT};
    WlkVulkanImageState before = GENERAL_STATE;
    before.layout = to.layout;
    VkBufferImageCopy region{};
    region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    region.imageExtent = to.info().extent;
    imageBarrier(vk, commands, to.handle(), WHOLE_IMAGE, before, target);
    vk.CmdCopyBufferToImage(commands, from.handle(), to.handle(), target.layout, 1, &region);
    imageBarrier(vk, commands, to.handle(), WHOLE_IMAGE, target, GENERAL_STATE);
    to.layout = VK_IMAGE_LAYOUT_GENERAL;
    bytes += from.size();
  };
  copy(surface.newVertices, surface.vertices);
  copy(surface.newCorners, surface.corners);
  surface.low = surface.newLow;
  surface.high = surface.newHigh;
  ++surface.version;
  return bytes;
}

}  // namespace welkin
