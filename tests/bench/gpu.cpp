// SPDX-License-Identifier: MIT
#include "bench/gpu.hpp"

#include <array>
#include <cstring>
#include <welkin/welkin.hpp>

namespace bench {
namespace {

VkImageSubresourceRange wholeColor() {
  return {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
}

VkBufferImageCopy wholeImage(const GpuImage& image) {
  VkBufferImageCopy copy{};
  copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  copy.imageExtent = image.extent;
  return copy;
}

size_t floatsOf(const GpuImage& image) {
  const size_t texels = size_t{image.extent.width} * image.extent.height * image.extent.depth;
  return texels * (image.format == VK_FORMAT_R32_SFLOAT ? 1 : 4);
}

WlkVulkanRequirements requirements() {
  auto needs = welkin::make<WlkVulkanRequirements>();
  welkin::check(wlkVulkanGetRequirements(&needs));
  return needs;
}

support::DeviceOptions options(bool validation) {
  const WlkVulkanRequirements needs = requirements();
  support::DeviceOptions result;
  result.validation = validation;
  result.queueFlags = needs.queueFlags;
  result.timestampBits = 1;
  result.features13.synchronization2 = VK_TRUE;
  result.features13.dynamicRendering = VK_TRUE;
  result.features.shaderStorageImageWriteWithoutFormat = VK_TRUE;
  result.features.dualSrcBlend = needs.dualSrcBlend;
  result.features.fragmentStoresAndAtomics = needs.fragmentStoresAndAtomics;
  return result;
}

}  // namespace

WlkVulkanImage described(const GpuImage& image) {
  auto result = welkin::make<WlkVulkanImage>();
  result.image = image.handle;
  result.format = image.format;
  result.width = image.extent.width;
  result.height = image.extent.height;
  result.depth = image.extent.depth;
  result.before = {VK_IMAGE_LAYOUT_GENERAL, 0, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                   VK_ACCESS_2_SHADER_READ_BIT | VK_ACCESS_2_SHADER_WRITE_BIT};
  result.after = result.before;
  return result;
}

Gpu::Gpu(bool validation) : device_(options(validation)) {
  VkQueryPoolCreateInfo queries{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
  queries.queryType = VK_QUERY_TYPE_TIMESTAMP;
  queries.queryCount = 2;
  check(vkCreateQueryPool(handle(), &queries, nullptr, &queries_), "vkCreateQueryPool");
}

Gpu::~Gpu() {
  vkDeviceWaitIdle(handle());
  for (VkImageView view : views_) {
    vkDestroyImageView(handle(), view, nullptr);
  }
  vkDestroyQueryPool(handle(), queries_, nullptr);
}

std::string Gpu::driver() const {
  VkPhysicalDeviceDriverProperties driver{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES};
  VkPhysicalDeviceProperties2 all{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2};
  all.pNext = &driver;
  vkGetPhysicalDeviceProperties2(device_.physical(), &all);
  return std::string(driver.driverName) + ", " + driver.driverInfo;
}

WlkVulkanDeviceInfo Gpu::info() const {
  auto info = welkin::make<WlkVulkanDeviceInfo>();
  info.getInstanceProcAddr = vkGetInstanceProcAddr;
  info.instance = device_.instance();
  info.physicalDevice = device_.physical();
  info.device = handle();
  info.apiVersion = VK_API_VERSION_1_3;
  info.queueFamilyIndex = device_.family();
  info.enabledFeatures = WLK_VULKAN_FEATURE_BLEND;
  return info;
}

GpuImage Gpu::makeImage(VkFormat format, VkExtent3D extent, VkImageUsageFlags more) {
  const support::Image& made = images_.emplace_back(
      device_, format, extent, VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_STORAGE_BIT | more);
  GpuImage image{made.handle(), VK_NULL_HANDLE, format, extent};
  VkImageViewCreateInfo view{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
  view.image = image.handle;
  view.viewType = extent.depth > 1 ? VK_IMAGE_VIEW_TYPE_3D : VK_IMAGE_VIEW_TYPE_2D;
  view.format = format;
  view.subresourceRange = wholeColor();
  check(vkCreateImageView(handle(), &view, nullptr, &image.view), "vkCreateImageView");
  views_.push_back(image.view);
  run([&](VkCommandBuffer commands) {
    VkImageMemoryBarrier barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER};
    barrier.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
    barrier.newLayout = VK_IMAGE_LAYOUT_GENERAL;
    barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image.handle;
    barrier.subresourceRange = wholeColor();
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TOP_OF_PIPE_BIT,
                         VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 0, nullptr, 0, nullptr, 1,
                         &barrier);
  });
  return image;
}

GpuBuffer Gpu::makeBuffer(VkDeviceSize size, VkBufferUsageFlags usage) {
  const support::Buffer& made = buffers_.emplace_back(device_, size, usage);
  return {made.handle(), made.data()};
}

GpuBuffer Gpu::staging(VkDeviceSize size) {
  if (size > stagingSize_) {
    staging_ =
        makeBuffer(size, VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT);
    stagingSize_ = size;
  }
  return staging_;
}

void Gpu::upload(const GpuImage& image, std::span<const float> texels) {
  uploadBytes(image, std::as_bytes(texels));
}

void Gpu::uploadBytes(const GpuImage& image, std::span<const std::byte> bytes) {
  const GpuBuffer buffer = staging(bytes.size());
  std::memcpy(buffer.data, bytes.data(), bytes.size());
  run([&](VkCommandBuffer commands) {
    const VkBufferImageCopy copy = wholeImage(image);
    vkCmdCopyBufferToImage(commands, buffer.handle, image.handle, VK_IMAGE_LAYOUT_GENERAL, 1,
                           &copy);
  });
}

std::vector<float> Gpu::download(const GpuImage& image) {
  std::vector<float> texels(floatsOf(image));
  const GpuBuffer buffer = staging(texels.size() * sizeof(float));
  run([&](VkCommandBuffer commands) {
    const VkBufferImageCopy copy = wholeImage(image);
    vkCmdCopyImageToBuffer(commands, image.handle, VK_IMAGE_LAYOUT_GENERAL, buffer.handle, 1,
                           &copy);
    VkMemoryBarrier barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER};
    barrier.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1,
                         &barrier, 0, nullptr, 0, nullptr);
  });
  std::memcpy(texels.data(), buffer.data, texels.size() * sizeof(float));
  return texels;
}

double Gpu::run(const std::function<void(VkCommandBuffer)>& record) {
  device_.run([&](VkCommandBuffer commands) {
    vkCmdResetQueryPool(commands, queries_, 0, 2);
    VkMemoryBarrier last{VK_STRUCTURE_TYPE_MEMORY_BARRIER};
    last.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
    last.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                         VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 1, &last, 0, nullptr, 0, nullptr);
    vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, queries_, 0);
    record(commands);
    vkCmdWriteTimestamp2(commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, queries_, 1);
  });
  std::array<uint64_t, 2> ticks{};
  check(vkGetQueryPoolResults(handle(), queries_, 0, 2, sizeof ticks, ticks.data(), sizeof ticks[0],
                              VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
        "vkGetQueryPoolResults");
  return 1e-6 * double{properties().limits.timestampPeriod} *
         static_cast<double>(ticks[1] - ticks[0]);
}

}  // namespace bench
