// SPDX-License-Identifier: MIT
#include "device.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <welkin/welkin.hpp>

namespace engine {
namespace {

VkDeviceMemory allocate(const Device& device, const VkMemoryRequirements& needs,
                        VkMemoryPropertyFlags flags) {
  VkPhysicalDeviceMemoryProperties properties{};
  vkGetPhysicalDeviceMemoryProperties(device.physical(), &properties);
  for (uint32_t i = 0; i < properties.memoryTypeCount; ++i) {
    if ((needs.memoryTypeBits >> i & 1u) != 0 &&
        (properties.memoryTypes[i].propertyFlags & flags) == flags) {
      const VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, nullptr, needs.size,
                                      i};
      VkDeviceMemory memory = VK_NULL_HANDLE;
      check(vkAllocateMemory(device.handle(), &info, nullptr, &memory), "vkAllocateMemory");
      return memory;
    }
  }
  throw std::runtime_error("no memory type fits");
}

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

}  // namespace

void check(VkResult result, const char* call) {
  if (result < 0) {
    throw std::runtime_error(std::string(call) + " returned VkResult " + std::to_string(result));
  }
}

Device::Device() {
  createInstance();
  createDevice();
  VkCommandPoolCreateInfo pool{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
  pool.queueFamilyIndex = family_;
  check(vkCreateCommandPool(device_, &pool, nullptr, &pool_), "vkCreateCommandPool");
}

Device::~Device() {
  vkDeviceWaitIdle(device_);
  vkDestroyCommandPool(device_, pool_, nullptr);
  vkDestroyDevice(device_, nullptr);
  const auto destroy = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
      vkGetInstanceProcAddr(instance_, "vkDestroyDebugUtilsMessengerEXT"));
  destroy(instance_, messenger_, nullptr);
  vkDestroyInstance(instance_, nullptr);
  for (const std::string& message : messages_) {
    ADD_FAILURE() << message;
  }
}

VkBool32 Device::onMessage(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                           const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
  auto& self = *static_cast<Device*>(user);
  const std::lock_guard lock(self.mutex_);
  self.messages_.emplace_back(data->pMessage);
  return VK_FALSE;
}

void Device::createInstance() {
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
  info.pNext = &features;
  info.pApplicationInfo = &application;
  info.enabledLayerCount = 1;
  info.ppEnabledLayerNames = &layer;
  info.enabledExtensionCount = 1;
  info.ppEnabledExtensionNames = &extension;
  check(vkCreateInstance(&info, nullptr, &instance_), "vkCreateInstance");
  VkDebugUtilsMessengerCreateInfoEXT messenger{
      VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
  messenger.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                              VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  messenger.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
  messenger.pfnUserCallback = onMessage;
  messenger.pUserData = this;
  const auto create = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
      vkGetInstanceProcAddr(instance_, "vkCreateDebugUtilsMessengerEXT"));
  check(create(instance_, &messenger, nullptr, &messenger_), "vkCreateDebugUtilsMessengerEXT");
}

void Device::createDevice() {
  auto needs = welkin::make<WlkVulkanRequirements>();
  welkin::check(wlkVulkanGetRequirements(&needs));
  uint32_t count = 1;
  check(vkEnumeratePhysicalDevices(instance_, &count, &physical_), "vkEnumeratePhysicalDevices");
  uint32_t families = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(physical_, &families, nullptr);
  std::vector<VkQueueFamilyProperties> list(families);
  vkGetPhysicalDeviceQueueFamilyProperties(physical_, &families, list.data());
  while (family_ < families && (list[family_].queueFlags & needs.queueFlags) != needs.queueFlags) {
    ++family_;
  }
  // What Welkin asks for and one feature more: another one that it forgot is an error here.
  VkPhysicalDeviceVulkan13Features features13{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
  features13.synchronization2 = needs.synchronization2;
  features13.dynamicRendering = needs.dynamicRendering;
  VkPhysicalDeviceFeatures2 features{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
  features.pNext = &features13;
  features.features.shaderStorageImageWriteWithoutFormat =
      needs.shaderStorageImageWriteWithoutFormat;
  features.features.dualSrcBlend = needs.dualSrcBlend;
  // WLK_COMPOSITE_BLEND counts non-finite pixels in its fragment shader; WlkVulkanRequirements
  // has no field for it.
  features.features.fragmentStoresAndAtomics = VK_TRUE;
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
}

bool Device::supports(VkFormat format, VkFormatFeatureFlags features) const {
  VkFormatProperties properties{};
  vkGetPhysicalDeviceFormatProperties(physical_, format, &properties);
  return (properties.optimalTilingFeatures & features) == features;
}

WlkVulkanDeviceInfo Device::info() const {
  auto info = welkin::make<WlkVulkanDeviceInfo>();
  info.getInstanceProcAddr = vkGetInstanceProcAddr;
  info.instance = instance_;
  info.physicalDevice = physical_;
  info.device = device_;
  info.apiVersion = VK_API_VERSION_1_3;
  info.queueFamilyIndex = family_;
  info.dualSrcBlendEnabled = 1;
  return info;
}

VkCommandBuffer Device::begin() {
  VkCommandBufferAllocateInfo allocate{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
  allocate.commandPool = pool_;
  allocate.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  allocate.commandBufferCount = 1;
  VkCommandBuffer commands = VK_NULL_HANDLE;
  check(vkAllocateCommandBuffers(device_, &allocate, &commands), "vkAllocateCommandBuffers");
  VkCommandBufferBeginInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
  info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  check(vkBeginCommandBuffer(commands, &info), "vkBeginCommandBuffer");
  return commands;
}

void Device::submit(VkCommandBuffer commands) {
  check(vkEndCommandBuffer(commands), "vkEndCommandBuffer");
  VkCommandBufferSubmitInfo buffer{VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO};
  buffer.commandBuffer = commands;
  VkSubmitInfo2 info{VK_STRUCTURE_TYPE_SUBMIT_INFO_2};
  info.commandBufferInfoCount = 1;
  info.pCommandBufferInfos = &buffer;
  check(vkQueueSubmit2(queue_, 1, &info, VK_NULL_HANDLE), "vkQueueSubmit2");
}

void Device::wait() {
  check(vkDeviceWaitIdle(device_), "vkDeviceWaitIdle");
  check(vkResetCommandPool(device_, pool_, 0), "vkResetCommandPool");
}

Buffer::Buffer(const Device& device, VkDeviceSize size) : device_(device), size_(size) {
  VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
  info.size = size;
  info.usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
  check(vkCreateBuffer(device.handle(), &info, nullptr, &buffer_), "vkCreateBuffer");
  VkMemoryRequirements needs{};
  vkGetBufferMemoryRequirements(device.handle(), buffer_, &needs);
  memory_ = allocate(device, needs,
                     VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
  check(vkBindBufferMemory(device.handle(), buffer_, memory_, 0), "vkBindBufferMemory");
  void* mapped = nullptr;
  check(vkMapMemory(device.handle(), memory_, 0, VK_WHOLE_SIZE, 0, &mapped), "vkMapMemory");
  data_ = static_cast<unsigned char*>(mapped);
}

Buffer::~Buffer() {
  vkDestroyBuffer(device_.handle(), buffer_, nullptr);
  vkFreeMemory(device_.handle(), memory_, nullptr);
}

Image::Image(const Device& device, VkFormat format, VkExtent3D extent, VkImageUsageFlags usage)
    : device_(device), format_(format), extent_(extent) {
  VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
  info.imageType = extent.depth > 1 ? VK_IMAGE_TYPE_3D : VK_IMAGE_TYPE_2D;
  info.format = format;
  info.extent = extent;
  info.mipLevels = 1;
  info.arrayLayers = 1;
  info.samples = VK_SAMPLE_COUNT_1_BIT;
  info.usage = usage | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  check(vkCreateImage(device.handle(), &info, nullptr, &image_), "vkCreateImage");
  VkMemoryRequirements needs{};
  vkGetImageMemoryRequirements(device.handle(), image_, &needs);
  memory_ = allocate(device, needs, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
  check(vkBindImageMemory(device.handle(), image_, memory_, 0), "vkBindImageMemory");
}

Image::~Image() {
  vkDestroyImage(device_.handle(), image_, nullptr);
  vkFreeMemory(device_.handle(), memory_, nullptr);
}

WlkVulkanImage Image::imported(const WlkVulkanImageState& before,
                               const WlkVulkanImageState& after) const {
  auto image = welkin::make<WlkVulkanImage>();
  image.image = image_;
  image.format = format_;
  image.width = extent_.width;
  image.height = extent_.height;
  image.depth = extent_.depth;
  image.before = before;
  image.after = after;
  return image;
}

void Image::transition(VkCommandBuffer commands, const WlkVulkanImageState& from,
                       const WlkVulkanImageState& to) const {
  VkImageMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
  barrier.srcStageMask = from.stages;
  barrier.srcAccessMask = from.access;
  barrier.dstStageMask = to.stages;
  barrier.dstAccessMask = to.access;
  barrier.oldLayout = from.layout;
  barrier.newLayout = to.layout;
  barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.image = image_;
  barrier.subresourceRange = {aspects(format_), 0, 1, 0, 1};
  VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
  info.imageMemoryBarrierCount = 1;
  info.pImageMemoryBarriers = &barrier;
  vkCmdPipelineBarrier2(commands, &info);
}

VkBufferImageCopy Image::wholeImage() const {
  const VkImageAspectFlags aspect =
      aspects(format_) & ~VkImageAspectFlags{VK_IMAGE_ASPECT_STENCIL_BIT};
  VkBufferImageCopy region{};
  region.imageSubresource = {aspect, 0, 0, 1};
  region.imageExtent = extent_;
  return region;
}

void Image::write(VkCommandBuffer commands, const Buffer& from) const {
  transition(commands, UNDEFINED, COPY_TARGET);
  const VkBufferImageCopy region = wholeImage();
  vkCmdCopyBufferToImage(commands, from.handle(), image_, COPY_TARGET.layout, 1, &region);
}

void Image::read(VkCommandBuffer commands, const Buffer& to) const {
  const VkBufferImageCopy region = wholeImage();
  vkCmdCopyImageToBuffer(commands, image_, COPY_SOURCE.layout, to.handle(), 1, &region);
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
