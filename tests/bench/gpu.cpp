// SPDX-License-Identifier: MIT
#include "bench/gpu.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <stdexcept>
#include <welkin/welkin.hpp>

namespace bench {
namespace {

constexpr VkImageUsageFlags IMAGE_USAGE = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_STORAGE_BIT |
                                          VK_IMAGE_USAGE_TRANSFER_SRC_BIT |
                                          VK_IMAGE_USAGE_TRANSFER_DST_BIT;

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

VKAPI_ATTR VkBool32 VKAPI_CALL onMessage(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                         VkDebugUtilsMessageTypeFlagsEXT,
                                         const VkDebugUtilsMessengerCallbackDataEXT* data,
                                         void* user) {
  static_cast<std::vector<std::string>*>(user)->emplace_back(data->pMessage);
  return VK_FALSE;
}

}  // namespace

void check(VkResult result, const char* call) {
  if (result < 0) {
    throw std::runtime_error(std::string(call) + " returned VkResult " + std::to_string(result));
  }
}

Gpu::Gpu(bool validation) {
  try {
    makeInstance(validation);
    makeDevice();
  } catch (...) {
    destroy();
    throw;
  }
}

Gpu::~Gpu() {
  destroy();
}

void Gpu::makeInstance(bool validation) {
  VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
  application.apiVersion = VK_API_VERSION_1_3;
  const char* layer = "VK_LAYER_KHRONOS_validation";
  const char* extension = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
  const VkValidationFeatureEnableEXT synchronization =
      VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
  VkValidationFeaturesEXT features{VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT};
  features.enabledValidationFeatureCount = 1;
  features.pEnabledValidationFeatures = &synchronization;
  VkInstanceCreateInfo info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
  info.pApplicationInfo = &application;
  if (validation) {
    info.pNext = &features;
    info.enabledLayerCount = 1;
    info.ppEnabledLayerNames = &layer;
    info.enabledExtensionCount = 1;
    info.ppEnabledExtensionNames = &extension;
  }
  check(vkCreateInstance(&info, nullptr, &instance_), "vkCreateInstance");
  if (validation) {
    VkDebugUtilsMessengerCreateInfoEXT messenger{
        VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
    messenger.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                                VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    messenger.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
    messenger.pfnUserCallback = onMessage;
    messenger.pUserData = &messages_;
    const auto create = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(instance_, "vkCreateDebugUtilsMessengerEXT"));
    check(create(instance_, &messenger, nullptr, &messenger_), "vkCreateDebugUtilsMessengerEXT");
  }
}

void Gpu::makeDevice() {
  auto needs = welkin::make<WlkVulkanRequirements>();
  welkin::check(wlkVulkanGetRequirements(&needs));
  uint32_t count = 1;
  check(vkEnumeratePhysicalDevices(instance_, &count, &physical_), "vkEnumeratePhysicalDevices");
  if (count == 0) {
    throw std::runtime_error("no Vulkan device");
  }
  vkGetPhysicalDeviceProperties(physical_, &properties_);
  uint32_t families = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(physical_, &families, nullptr);
  std::vector<VkQueueFamilyProperties> list(families);
  vkGetPhysicalDeviceQueueFamilyProperties(physical_, &families, list.data());
  const auto fits = [&](const VkQueueFamilyProperties& family) {
    return (family.queueFlags & needs.queueFlags) == needs.queueFlags &&
           family.timestampValidBits > 0;
  };
  const auto found = std::find_if(list.begin(), list.end(), fits);
  if (found == list.end()) {
    throw std::runtime_error("no queue with graphics, compute and timestamps");
  }
  family_ = static_cast<uint32_t>(found - list.begin());
  VkPhysicalDeviceVulkan13Features features13{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
  features13.synchronization2 = VK_TRUE;
  features13.dynamicRendering = VK_TRUE;
  VkPhysicalDeviceFeatures2 features{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
  features.pNext = &features13;
  features.features.shaderStorageImageWriteWithoutFormat = VK_TRUE;
  const float priority = 1.0f;
  VkDeviceQueueCreateInfo queue{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
  queue.queueFamilyIndex = family_;
  queue.queueCount = 1;
  queue.pQueuePriorities = &priority;
  VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
  info.pNext = &features;
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue;
  check(vkCreateDevice(physical_, &info, nullptr, &device_), "vkCreateDevice");
  vkGetDeviceQueue(device_, family_, 0, &queue_);

  VkCommandPoolCreateInfo pool{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
  pool.queueFamilyIndex = family_;
  check(vkCreateCommandPool(device_, &pool, nullptr, &pool_), "vkCreateCommandPool");
  VkCommandBufferAllocateInfo commands{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
  commands.commandPool = pool_;
  commands.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  commands.commandBufferCount = 1;
  check(vkAllocateCommandBuffers(device_, &commands, &commands_), "vkAllocateCommandBuffers");
  VkFenceCreateInfo fence{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
  check(vkCreateFence(device_, &fence, nullptr, &fence_), "vkCreateFence");
  VkQueryPoolCreateInfo queries{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
  queries.queryType = VK_QUERY_TYPE_TIMESTAMP;
  queries.queryCount = 2;
  check(vkCreateQueryPool(device_, &queries, nullptr, &queries_), "vkCreateQueryPool");
}

std::string Gpu::driver() const {
  VkPhysicalDeviceDriverProperties driver{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES};
  VkPhysicalDeviceProperties2 all{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2};
  all.pNext = &driver;
  vkGetPhysicalDeviceProperties2(physical_, &all);
  return std::string(driver.driverName) + ", " + driver.driverInfo;
}

WlkVulkanDeviceInfo Gpu::info() const {
  auto info = welkin::make<WlkVulkanDeviceInfo>();
  info.getInstanceProcAddr = vkGetInstanceProcAddr;
  info.instance = instance_;
  info.physicalDevice = physical_;
  info.device = device_;
  info.apiVersion = VK_API_VERSION_1_3;
  info.queueFamilyIndex = family_;
  return info;
}

VkDeviceMemory Gpu::allocate(const VkMemoryRequirements& needs, VkMemoryPropertyFlags flags) {
  VkPhysicalDeviceMemoryProperties properties{};
  vkGetPhysicalDeviceMemoryProperties(physical_, &properties);
  for (uint32_t i = 0; i < properties.memoryTypeCount; ++i) {
    if ((needs.memoryTypeBits >> i & 1u) != 0 &&
        (properties.memoryTypes[i].propertyFlags & flags) == flags) {
      VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
      info.allocationSize = needs.size;
      info.memoryTypeIndex = i;
      VkDeviceMemory memory = VK_NULL_HANDLE;
      check(vkAllocateMemory(device_, &info, nullptr, &memory), "vkAllocateMemory");
      memory_.push_back(memory);
      return memory;
    }
  }
  throw std::runtime_error("no memory type fits");
}

GpuImage Gpu::makeImage(VkFormat format, VkExtent3D extent) {
  GpuImage image{VK_NULL_HANDLE, VK_NULL_HANDLE, format, extent};
  VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
  info.imageType = extent.depth > 1 ? VK_IMAGE_TYPE_3D : VK_IMAGE_TYPE_2D;
  info.format = format;
  info.extent = extent;
  info.mipLevels = 1;
  info.arrayLayers = 1;
  info.samples = VK_SAMPLE_COUNT_1_BIT;
  info.usage = IMAGE_USAGE;
  check(vkCreateImage(device_, &info, nullptr, &image.handle), "vkCreateImage");
  images_.push_back(image);
  VkMemoryRequirements needs{};
  vkGetImageMemoryRequirements(device_, image.handle, &needs);
  const VkDeviceMemory memory = allocate(needs, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
  check(vkBindImageMemory(device_, image.handle, memory, 0), "vkBindImageMemory");
  VkImageViewCreateInfo view{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
  view.image = image.handle;
  view.viewType = extent.depth > 1 ? VK_IMAGE_VIEW_TYPE_3D : VK_IMAGE_VIEW_TYPE_2D;
  view.format = format;
  view.subresourceRange = wholeColor();
  check(vkCreateImageView(device_, &view, nullptr, &image.view), "vkCreateImageView");
  images_.back() = image;
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
  GpuBuffer buffer;
  VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
  info.size = size;
  info.usage = usage;
  check(vkCreateBuffer(device_, &info, nullptr, &buffer.handle), "vkCreateBuffer");
  buffers_.push_back(buffer);
  VkMemoryRequirements needs{};
  vkGetBufferMemoryRequirements(device_, buffer.handle, &needs);
  const VkDeviceMemory memory =
      allocate(needs, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
  check(vkBindBufferMemory(device_, buffer.handle, memory, 0), "vkBindBufferMemory");
  check(vkMapMemory(device_, memory, 0, VK_WHOLE_SIZE, 0, &buffer.data), "vkMapMemory");
  return buffer;
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
  const GpuBuffer buffer = staging(texels.size_bytes());
  std::memcpy(buffer.data, texels.data(), texels.size_bytes());
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
  check(vkResetCommandPool(device_, pool_, 0), "vkResetCommandPool");
  VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
  begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  check(vkBeginCommandBuffer(commands_, &begin), "vkBeginCommandBuffer");
  vkCmdResetQueryPool(commands_, queries_, 0, 2);
  VkMemoryBarrier last{VK_STRUCTURE_TYPE_MEMORY_BARRIER};
  last.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
  last.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
  vkCmdPipelineBarrier(commands_, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                       VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 1, &last, 0, nullptr, 0, nullptr);
  vkCmdWriteTimestamp2(commands_, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, queries_, 0);
  record(commands_);
  vkCmdWriteTimestamp2(commands_, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, queries_, 1);
  check(vkEndCommandBuffer(commands_), "vkEndCommandBuffer");
  check(vkResetFences(device_, 1, &fence_), "vkResetFences");
  VkSubmitInfo submit{VK_STRUCTURE_TYPE_SUBMIT_INFO};
  submit.commandBufferCount = 1;
  submit.pCommandBuffers = &commands_;
  check(vkQueueSubmit(queue_, 1, &submit, fence_), "vkQueueSubmit");
  check(vkWaitForFences(device_, 1, &fence_, VK_TRUE, UINT64_MAX), "vkWaitForFences");
  std::array<uint64_t, 2> ticks{};
  check(vkGetQueryPoolResults(device_, queries_, 0, 2, sizeof ticks, ticks.data(), sizeof ticks[0],
                              VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
        "vkGetQueryPoolResults");
  return 1e-6 * double{properties_.limits.timestampPeriod} *
         static_cast<double>(ticks[1] - ticks[0]);
}

void Gpu::destroy() {
  if (device_ != VK_NULL_HANDLE) {
    vkDeviceWaitIdle(device_);
    for (const GpuImage& image : images_) {
      vkDestroyImageView(device_, image.view, nullptr);
      vkDestroyImage(device_, image.handle, nullptr);
    }
    for (const GpuBuffer& buffer : buffers_) {
      vkDestroyBuffer(device_, buffer.handle, nullptr);
    }
    for (VkDeviceMemory memory : memory_) {
      vkFreeMemory(device_, memory, nullptr);
    }
    vkDestroyQueryPool(device_, queries_, nullptr);
    vkDestroyFence(device_, fence_, nullptr);
    vkDestroyCommandPool(device_, pool_, nullptr);
    vkDestroyDevice(device_, nullptr);
  }
  if (messenger_ != VK_NULL_HANDLE) {
    const auto destroyMessenger = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(instance_, "vkDestroyDebugUtilsMessengerEXT"));
    destroyMessenger(instance_, messenger_, nullptr);
  }
  if (instance_ != VK_NULL_HANDLE) {
    vkDestroyInstance(instance_, nullptr);
  }
}

}  // namespace bench
