// SPDX-License-Identifier: MIT
#include "support/test_device.hpp"

#include <algorithm>
#include <cstring>
#include <stdexcept>

namespace support {
namespace {

constexpr const char* VALIDATION = "VK_LAYER_KHRONOS_validation";

template <typename Function>
Function instanceFunction(VkInstance instance, const char* name) {
  return reinterpret_cast<Function>(vkGetInstanceProcAddr(instance, name));
}

}  // namespace

void check(VkResult result, const char* call) {
  if (result < 0) {
    throw std::runtime_error(std::string(call) + " returned VkResult " + std::to_string(result));
  }
}

bool validationInstalled() {
  uint32_t count = 0;
  check(vkEnumerateInstanceLayerProperties(&count, nullptr), "vkEnumerateInstanceLayerProperties");
  std::vector<VkLayerProperties> layers(count);
  check(vkEnumerateInstanceLayerProperties(&count, layers.data()),
        "vkEnumerateInstanceLayerProperties");
  return std::any_of(layers.begin(), layers.end(), [](const VkLayerProperties& layer) {
    return std::strcmp(layer.layerName, VALIDATION) == 0;
  });
}

TestDevice::TestDevice(const DeviceOptions& options) {
  try {
    makeInstance(options.validation);
    choosePhysical(options.preferSoftware);
    makeDevice(options);
  } catch (...) {
    destroy();
    throw;
  }
}

TestDevice::~TestDevice() {
  destroy();
}

void TestDevice::makeInstance(bool validation) {
  VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
  application.apiVersion = VK_API_VERSION_1_3;
  const VkValidationFeatureEnableEXT synchronization =
      VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
  VkValidationFeaturesEXT features{VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT};
  features.enabledValidationFeatureCount = 1;
  features.pEnabledValidationFeatures = &synchronization;
  VkDebugUtilsMessengerCreateInfoEXT messenger{
      VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
  messenger.pNext = &features;
  messenger.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                              VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  messenger.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
  messenger.pfnUserCallback =
      [](VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
         const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) -> VkBool32 {
    auto& self = *static_cast<TestDevice*>(user);
    const std::lock_guard lock(self.mutex_);
    self.messages_.emplace_back(data->pMessage);
    return VK_FALSE;
  };
  messenger.pUserData = this;
  const char* extension = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
  VkInstanceCreateInfo info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
  info.pApplicationInfo = &application;
  if (validation) {
    info.pNext = &messenger;
    info.enabledLayerCount = 1;
    info.ppEnabledLayerNames = &VALIDATION;
    info.enabledExtensionCount = 1;
    info.ppEnabledExtensionNames = &extension;
  }
  check(vkCreateInstance(&info, nullptr, &instance_), "vkCreateInstance");
  if (validation) {
    messenger.pNext = nullptr;
    const auto create = instanceFunction<PFN_vkCreateDebugUtilsMessengerEXT>(
        instance_, "vkCreateDebugUtilsMessengerEXT");
    check(create(instance_, &messenger, nullptr, &messenger_), "vkCreateDebugUtilsMessengerEXT");
  }
}

void TestDevice::choosePhysical(bool preferSoftware) {
  uint32_t count = 0;
  check(vkEnumeratePhysicalDevices(instance_, &count, nullptr), "vkEnumeratePhysicalDevices");
  std::vector<VkPhysicalDevice> devices(count);
  check(vkEnumeratePhysicalDevices(instance_, &count, devices.data()),
        "vkEnumeratePhysicalDevices");
  const auto software = [](VkPhysicalDevice device) {
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(device, &properties);
    return std::strstr(properties.deviceName, "llvmpipe") != nullptr;
  };
  if (preferSoftware) {
    std::stable_partition(devices.begin(), devices.end(), software);
  }
  if (devices.empty()) {
    throw std::runtime_error("no Vulkan device");
  }
  physical_ = devices.front();
  vkGetPhysicalDeviceProperties(physical_, &properties_);
}

void TestDevice::makeDevice(const DeviceOptions& options) {
  uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(physical_, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(physical_, &count, families.data());
  const auto fits = [&](const VkQueueFamilyProperties& family) {
    return (family.queueFlags & options.queueFlags) == options.queueFlags &&
           family.timestampValidBits >= options.timestampBits;
  };
  const auto found = std::find_if(families.begin(), families.end(), fits);
  if (found == families.end()) {
    throw std::runtime_error("no queue does what is asked for");
  }
  family_ = static_cast<uint32_t>(found - families.begin());
  VkPhysicalDeviceVulkan13Features features13 = options.features13;
  const VkPhysicalDeviceFeatures2 features{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2,
                                           &features13, options.features};
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
}

void TestDevice::destroy() {
  if (device_ != VK_NULL_HANDLE) {
    vkDeviceWaitIdle(device_);
    vkDestroyCommandPool(device_, pool_, nullptr);
    vkDestroyDevice(device_, nullptr);
    device_ = VK_NULL_HANDLE;
  }
  if (messenger_ != VK_NULL_HANDLE) {
    instanceFunction<PFN_vkDestroyDebugUtilsMessengerEXT>(
        instance_, "vkDestroyDebugUtilsMessengerEXT")(instance_, messenger_, nullptr);
    messenger_ = VK_NULL_HANDLE;
  }
  if (instance_ != VK_NULL_HANDLE) {
    vkDestroyInstance(instance_, nullptr);
    instance_ = VK_NULL_HANDLE;
  }
}

VkDeviceMemory TestDevice::allocate(const VkMemoryRequirements& needs,
                                    VkMemoryPropertyFlags flags) const {
  VkPhysicalDeviceMemoryProperties properties{};
  vkGetPhysicalDeviceMemoryProperties(physical_, &properties);
  for (uint32_t i = 0; i < properties.memoryTypeCount; ++i) {
    if ((needs.memoryTypeBits >> i & 1u) != 0 &&
        (properties.memoryTypes[i].propertyFlags & flags) == flags) {
      const VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, nullptr, needs.size,
                                      i};
      VkDeviceMemory memory = VK_NULL_HANDLE;
      check(vkAllocateMemory(device_, &info, nullptr, &memory), "vkAllocateMemory");
      return memory;
    }
  }
  throw std::runtime_error("no memory type fits");
}

VkCommandBuffer TestDevice::begin() {
  if (begun_ == commands_.size()) {
    const VkCommandBufferAllocateInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO, nullptr,
                                           pool_, VK_COMMAND_BUFFER_LEVEL_PRIMARY, 1};
    VkCommandBuffer made = VK_NULL_HANDLE;
    check(vkAllocateCommandBuffers(device_, &info, &made), "vkAllocateCommandBuffers");
    commands_.push_back(made);
  }
  VkCommandBuffer commands = commands_[begun_++];
  VkCommandBufferBeginInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
  info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  check(vkBeginCommandBuffer(commands, &info), "vkBeginCommandBuffer");
  return commands;
}

void TestDevice::submit(VkCommandBuffer commands) {
  check(vkEndCommandBuffer(commands), "vkEndCommandBuffer");
  VkSubmitInfo info{VK_STRUCTURE_TYPE_SUBMIT_INFO};
  info.commandBufferCount = 1;
  info.pCommandBuffers = &commands;
  check(vkQueueSubmit(queue_, 1, &info, VK_NULL_HANDLE), "vkQueueSubmit");
}

void TestDevice::wait() {
  check(vkDeviceWaitIdle(device_), "vkDeviceWaitIdle");
  check(vkResetCommandPool(device_, pool_, 0), "vkResetCommandPool");
  begun_ = 0;
}

void TestDevice::run(const std::function<void(VkCommandBuffer)>& record) {
  VkCommandBuffer commands = begin();
  record(commands);
  submit(commands);
  wait();
}

Buffer::Buffer(const TestDevice& device, VkDeviceSize size, VkBufferUsageFlags usage)
    : device_(device), size_(size) {
  VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
  info.size = size;
  info.usage = usage;
  check(vkCreateBuffer(device.handle(), &info, nullptr, &buffer_), "vkCreateBuffer");
  VkMemoryRequirements needs{};
  vkGetBufferMemoryRequirements(device.handle(), buffer_, &needs);
  memory_ = device.allocate(
      needs, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
  check(vkBindBufferMemory(device.handle(), buffer_, memory_, 0), "vkBindBufferMemory");
  void* mapped = nullptr;
  check(vkMapMemory(device.handle(), memory_, 0, VK_WHOLE_SIZE, 0, &mapped), "vkMapMemory");
  data_ = static_cast<unsigned char*>(mapped);
}

Buffer::~Buffer() {
  vkDestroyBuffer(device_.handle(), buffer_, nullptr);
  vkFreeMemory(device_.handle(), memory_, nullptr);
}

Image::Image(const TestDevice& device, VkFormat format, VkExtent3D extent, VkImageUsageFlags usage,
             uint32_t layers)
    : device_(device), format_(format), extent_(extent), layers_(layers) {
  VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
  info.imageType = extent.depth > 1 ? VK_IMAGE_TYPE_3D : VK_IMAGE_TYPE_2D;
  info.format = format;
  info.extent = extent;
  info.mipLevels = 1;
  info.arrayLayers = layers;
  info.samples = VK_SAMPLE_COUNT_1_BIT;
  info.usage = usage | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  check(vkCreateImage(device.handle(), &info, nullptr, &image_), "vkCreateImage");
  VkMemoryRequirements needs{};
  vkGetImageMemoryRequirements(device.handle(), image_, &needs);
  memory_ = device.allocate(needs, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
  check(vkBindImageMemory(device.handle(), image_, memory_, 0), "vkBindImageMemory");
}

Image::~Image() {
  vkDestroyImage(device_.handle(), image_, nullptr);
  vkFreeMemory(device_.handle(), memory_, nullptr);
}

}  // namespace support
