// SPDX-License-Identifier: MIT
#include "engine/resources.hpp"

#include <stdexcept>

namespace {

VkDeviceMemory allocate(const Gpu& gpu, const VkMemoryRequirements& needs,
                        VkMemoryPropertyFlags flags) {
  VkPhysicalDeviceMemoryProperties properties{};
  vkGetPhysicalDeviceMemoryProperties(gpu.physical(), &properties);
  for (uint32_t i = 0; i < properties.memoryTypeCount; ++i) {
    if ((needs.memoryTypeBits >> i & 1u) == 0 ||
        (properties.memoryTypes[i].propertyFlags & flags) != flags) {
      continue;
    }
    const VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, nullptr, needs.size, i};
    VkDeviceMemory memory = VK_NULL_HANDLE;
    check(vkAllocateMemory(gpu.device(), &info, nullptr, &memory), "vkAllocateMemory");
    return memory;
  }
  throw std::runtime_error("no memory type fits");
}

}  // namespace

Image::Image(const Gpu& gpu, VkExtent2D extent, VkFormat format, VkImageUsageFlags usage,
             VkImageAspectFlags aspect, uint32_t depth)
    : gpu_(gpu), extent_(extent), format_(format), aspect_(aspect) {
  VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
  info.imageType = depth > 1 ? VK_IMAGE_TYPE_3D : VK_IMAGE_TYPE_2D;
  info.format = format;
  info.extent = {extent.width, extent.height, depth};
  info.mipLevels = 1;
  info.arrayLayers = 1;
  info.samples = VK_SAMPLE_COUNT_1_BIT;
  info.usage = usage;
  check(vkCreateImage(gpu.device(), &info, nullptr, &image_), "vkCreateImage");
  VkMemoryRequirements needs{};
  vkGetImageMemoryRequirements(gpu.device(), image_, &needs);
  memory_ = allocate(gpu, needs, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
  check(vkBindImageMemory(gpu.device(), image_, memory_, 0), "vkBindImageMemory");
  VkImageViewCreateInfo view{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
  view.image = image_;
  view.viewType = depth > 1 ? VK_IMAGE_VIEW_TYPE_3D : VK_IMAGE_VIEW_TYPE_2D;
  view.format = format;
  view.subresourceRange = {aspect, 0, 1, 0, 1};
  check(vkCreateImageView(gpu.device(), &view, nullptr, &view_), "vkCreateImageView");
}

Image::~Image() {
  vkDestroyImageView(gpu_.device(), view_, nullptr);
  vkDestroyImage(gpu_.device(), image_, nullptr);
  vkFreeMemory(gpu_.device(), memory_, nullptr);
}

Buffer::Buffer(const Gpu& gpu, VkDeviceSize size, VkBufferUsageFlags usage) : gpu_(gpu) {
  VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
  info.size = size;
  info.usage = usage;
  check(vkCreateBuffer(gpu.device(), &info, nullptr, &buffer_), "vkCreateBuffer");
  VkMemoryRequirements needs{};
  vkGetBufferMemoryRequirements(gpu.device(), buffer_, &needs);
  memory_ = allocate(gpu, needs,
                     VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
  check(vkBindBufferMemory(gpu.device(), buffer_, memory_, 0), "vkBindBufferMemory");
  check(vkMapMemory(gpu.device(), memory_, 0, VK_WHOLE_SIZE, 0, &data_), "vkMapMemory");
}

Buffer::~Buffer() {
  vkDestroyBuffer(gpu_.device(), buffer_, nullptr);
  vkFreeMemory(gpu_.device(), memory_, nullptr);
}

void transition(VkCommandBuffer commands, VkImage image, VkImageAspectFlags aspect,
                const ImageState& from, const ImageState& to) {
  VkImageMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
  barrier.srcStageMask = from.stages;
  barrier.srcAccessMask = from.access;
  barrier.dstStageMask = to.stages;
  barrier.dstAccessMask = to.access;
  barrier.oldLayout = from.layout;
  barrier.newLayout = to.layout;
  barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.image = image;
  barrier.subresourceRange = {aspect, 0, 1, 0, 1};
  VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
  info.imageMemoryBarrierCount = 1;
  info.pImageMemoryBarriers = &barrier;
  vkCmdPipelineBarrier2(commands, &info);
}
