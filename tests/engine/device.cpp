// SPDX-License-Identifier: MIT
#include "device.hpp"

#include <gtest/gtest.h>

#include <welkin/welkin.hpp>

namespace engine {
namespace {

VkImageAspectFlags aspects(VkFormat format) {
  switch (format) {
    case VK_FORMAT_D16_UNORM:
    case VK_FORMAT_X8_D24_UNORM_PACK32:
    case VK_FORMAT_D32_SFLOAT:
      return VK_IMAGE_ASPECT_DEPTH_BIT;
    case VK_FORMAT_D24_UNORM_S8_UINT:
    case VK_FORMAT_D32_SFLOAT_S8_UINT:
      return VK_IMAGE_ASPECT_DEPTH_BIT | VK_IMAGE_ASPECT_STENCIL_BIT;
    default:
      return VK_IMAGE_ASPECT_COLOR_BIT;
  }
}

support::DeviceOptions options() {
  auto needs = welkin::make<WlkVulkanRequirements>();
  welkin::check(wlkVulkanGetRequirements(&needs));
  // Nothing but what Welkin asks for: another feature that it forgot is an error here.
  support::DeviceOptions result;
  result.queueFlags = needs.queueFlags;
  result.features13.synchronization2 = needs.synchronization2;
  result.features13.dynamicRendering = needs.dynamicRendering;
  result.features.shaderStorageImageWriteWithoutFormat = needs.shaderStorageImageWriteWithoutFormat;
  result.features.dualSrcBlend = needs.dualSrcBlend;
  result.features.fragmentStoresAndAtomics = needs.fragmentStoresAndAtomics;
  return result;
}

}  // namespace

Device::Device() : TestDevice(options()) {}

Device::~Device() {
  destroy();
  for (const std::string& message : messages()) {
    ADD_FAILURE() << message;
  }
}

bool Device::supports(VkFormat format, VkFormatFeatureFlags features) const {
  VkFormatProperties properties{};
  vkGetPhysicalDeviceFormatProperties(physical(), format, &properties);
  return (properties.optimalTilingFeatures & features) == features;
}

WlkVulkanDeviceInfo Device::info() const {
  auto info = welkin::make<WlkVulkanDeviceInfo>();
  info.getInstanceProcAddr = vkGetInstanceProcAddr;
  info.instance = instance();
  info.physicalDevice = physical();
  info.device = handle();
  info.apiVersion = VK_API_VERSION_1_3;
  info.queueFamilyIndex = family();
  info.enabledFeatures = WLK_VULKAN_FEATURE_BLEND;
  return info;
}

WlkVulkanImage Image::imported(const WlkVulkanImageState& before,
                               const WlkVulkanImageState& after) const {
  auto image = welkin::make<WlkVulkanImage>();
  image.image = handle();
  image.format = format();
  image.width = extent().width;
  image.height = extent().height;
  image.depth = extent().depth;
  image.layerCount = layers();
  image.before = before;
  image.after = after;
  return image;
}

void Image::transition(VkCommandBuffer commands, const WlkVulkanImageState& from,
                       const WlkVulkanImageState& to) const {
  transition(commands, from, to, 0, layers());
}

void Image::transition(VkCommandBuffer commands, const WlkVulkanImageState& from,
                       const WlkVulkanImageState& to, uint32_t firstLayer, uint32_t count) const {
  VkImageMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
  barrier.srcStageMask = from.stages;
  barrier.srcAccessMask = from.access;
  barrier.dstStageMask = to.stages;
  barrier.dstAccessMask = to.access;
  barrier.oldLayout = from.layout;
  barrier.newLayout = to.layout;
  barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.image = handle();
  barrier.subresourceRange = {aspects(format()), 0, 1, firstLayer, count};
  VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
  info.imageMemoryBarrierCount = 1;
  info.pImageMemoryBarriers = &barrier;
  vkCmdPipelineBarrier2(commands, &info);
}

VkBufferImageCopy Image::wholeImage() const {
  const VkImageAspectFlags aspect =
      aspects(format()) & ~VkImageAspectFlags{VK_IMAGE_ASPECT_STENCIL_BIT};
  VkBufferImageCopy region{};
  region.imageSubresource = {aspect, 0, 0, layers()};
  region.imageExtent = extent();
  return region;
}

void Image::write(VkCommandBuffer commands, const Buffer& from) const {
  transition(commands, UNDEFINED, COPY_TARGET);
  const VkBufferImageCopy region = wholeImage();
  vkCmdCopyBufferToImage(commands, from.handle(), handle(), COPY_TARGET.layout, 1, &region);
}

void Image::read(VkCommandBuffer commands, const Buffer& to) const {
  const VkBufferImageCopy region = wholeImage();
  vkCmdCopyImageToBuffer(commands, handle(), COPY_SOURCE.layout, to.handle(), 1, &region);
}

void orderCopiesBeforeHost(VkCommandBuffer commands) {
  VkMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
  barrier.srcStageMask = VK_PIPELINE_STAGE_2_COPY_BIT;
  barrier.srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
  barrier.dstStageMask = VK_PIPELINE_STAGE_2_HOST_BIT;
  barrier.dstAccessMask = VK_ACCESS_2_HOST_READ_BIT;
  VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
  info.memoryBarrierCount = 1;
  info.pMemoryBarriers = &barrier;
  vkCmdPipelineBarrier2(commands, &info);
}

}  // namespace engine
