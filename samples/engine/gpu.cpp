// SPDX-License-Identifier: MIT
#include "engine/gpu.hpp"

#include <welkin/welkin_vulkan.h>

#include <cstdio>
#include <stdexcept>
#include <string>
#include <welkin/welkin.hpp>

void check(VkResult result, const char* call) {
  if (result < 0) {
    throw std::runtime_error(std::string(call) + " returned VkResult " + std::to_string(result));
  }
}

Gpu::Gpu(const SurfaceSource& source, bool validate) : ownsSurface_(!source.toolkitDestroys) {
  createInstance(source.instanceExtensions, validate);
  surface_ = source.create(instance_);
  pickDevice();
  createDevice();
}

Gpu::~Gpu() {
  vkDestroyDevice(device_, nullptr);
  if (ownsSurface_) {
    vkDestroySurfaceKHR(instance_, surface_, nullptr);
  }
  if (messenger_ != VK_NULL_HANDLE) {
    const auto destroy = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(instance_, "vkDestroyDebugUtilsMessengerEXT"));
    destroy(instance_, messenger_, nullptr);
  }
  if (ownsSurface_) {
    vkDestroyInstance(instance_, nullptr);
  }
}

VkBool32 Gpu::onMessage(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                        const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
  ++static_cast<Gpu*>(user)->messages_;
  std::fprintf(stderr, "%s\n", data->pMessage);
  return VK_FALSE;
}

void Gpu::createInstance(std::vector<const char*> extensions, bool validate) {
  VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
  application.pApplicationName = "welkin sample";
  application.apiVersion = VK_API_VERSION_1_3;
  VkInstanceCreateInfo info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
  info.pApplicationInfo = &application;

  const char* layer = "VK_LAYER_KHRONOS_validation";
  const VkValidationFeatureEnableEXT synchronization =
      VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
  VkValidationFeaturesEXT features{VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT};
  features.enabledValidationFeatureCount = 1;
  features.pEnabledValidationFeatures = &synchronization;
  VkDebugUtilsMessengerCreateInfoEXT messenger{
      VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
  messenger.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                              VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  messenger.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
  messenger.pfnUserCallback = onMessage;
  messenger.pUserData = this;
  if (validate) {
    extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    info.pNext = &features;
    info.enabledLayerCount = 1;
    info.ppEnabledLayerNames = &layer;
  }
  info.enabledExtensionCount = static_cast<uint32_t>(extensions.size());
  info.ppEnabledExtensionNames = extensions.data();
  check(vkCreateInstance(&info, nullptr, &instance_), "vkCreateInstance");
  if (validate) {
    const auto create = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(instance_, "vkCreateDebugUtilsMessengerEXT"));
    check(create(instance_, &messenger, nullptr, &messenger_), "vkCreateDebugUtilsMessengerEXT");
  }
}

// The first device of Welkin's least version with one queue family for drawing, computing and
// presenting.
void Gpu::pickDevice() {
  WlkVulkanRequirements needs = welkin::make<WlkVulkanRequirements>();
  welkin::check(wlkVulkanGetRequirements(&needs));
  uint32_t count = 0;
  check(vkEnumeratePhysicalDevices(instance_, &count, nullptr), "vkEnumeratePhysicalDevices");
  std::vector<VkPhysicalDevice> devices(count);
  check(vkEnumeratePhysicalDevices(instance_, &count, devices.data()),
        "vkEnumeratePhysicalDevices");
  for (VkPhysicalDevice device : devices) {
    VkPhysicalDeviceProperties properties{};
    vkGetPhysicalDeviceProperties(device, &properties);
    if (properties.apiVersion < needs.apiVersion) {
      continue;
    }
    uint32_t families = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(device, &families, nullptr);
    std::vector<VkQueueFamilyProperties> list(families);
    vkGetPhysicalDeviceQueueFamilyProperties(device, &families, list.data());
    for (uint32_t i = 0; i < families; ++i) {
      VkBool32 presents = VK_FALSE;
      check(vkGetPhysicalDeviceSurfaceSupportKHR(device, i, surface_, &presents),
            "vkGetPhysicalDeviceSurfaceSupportKHR");
      if (presents == VK_TRUE && (list[i].queueFlags & needs.queueFlags) == needs.queueFlags) {
        physical_ = device;
        family_ = i;
        return;
      }
    }
  }
  throw std::runtime_error("no Vulkan 1.3 device draws, computes and presents on one queue");
}

// Enables what Welkin needs, and nothing else: this engine needs no feature of its own.
void Gpu::createDevice() {
  WlkVulkanRequirements needs = welkin::make<WlkVulkanRequirements>();
  welkin::check(wlkVulkanGetRequirements(&needs));
  VkPhysicalDeviceVulkan13Features features13{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
  features13.synchronization2 = needs.synchronization2;
  features13.dynamicRendering = needs.dynamicRendering;
  VkPhysicalDeviceFeatures2 features{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
  features.pNext = &features13;
  features.features.shaderStorageImageWriteWithoutFormat =
      needs.shaderStorageImageWriteWithoutFormat;
  features.features.dualSrcBlend = needs.dualSrcBlend;
  // WLK_COMPOSITE_BLEND counts non-finite pixels in its fragment shader.
  features.features.fragmentStoresAndAtomics = VK_TRUE;
  const float priority = 1.0f;
  VkDeviceQueueCreateInfo queue{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
  queue.queueFamilyIndex = family_;
  queue.queueCount = 1;
  queue.pQueuePriorities = &priority;
  const char* swapchain = VK_KHR_SWAPCHAIN_EXTENSION_NAME;
  VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
  info.pNext = &features;
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queue;
  info.enabledExtensionCount = 1;
  info.ppEnabledExtensionNames = &swapchain;
  check(vkCreateDevice(physical_, &info, nullptr, &device_), "vkCreateDevice");
  vkGetDeviceQueue(device_, family_, 0, &queue_);
}
