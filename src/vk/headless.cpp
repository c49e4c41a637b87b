// SPDX-License-Identifier: MIT
#include "vk/headless.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <cstring>
#include <vector>

#include "failure.hpp"

namespace welkin::vk {
namespace {

constexpr VkQueueFlags QUEUE_FLAGS = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
constexpr const char* VALIDATION_LAYER = "VK_LAYER_KHRONOS_validation";

VKAPI_ATTR VkBool32 VKAPI_CALL onMessage(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                         VkDebugUtilsMessageTypeFlagsEXT,
                                         const VkDebugUtilsMessengerCallbackDataEXT* data,
                                         void* user) {
  const auto* options = static_cast<const HeadlessOptions*>(user);
  if (options->log != nullptr) {
    const bool error = severity >= VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    const WlkLogMessage message{WLK_STRUCT_LOG_MESSAGE,
                                sizeof(WlkLogMessage),
                                nullptr,
                                error ? uint32_t{WLK_LOG_ERROR} : uint32_t{WLK_LOG_WARNING},
                                WLK_LOG_ID_VALIDATION,
                                data->pMessage};
    options->log(options->logUser, &message);
  }
  return VK_FALSE;
}

int rank(VkPhysicalDeviceType type) {
  switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
      return 4;
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
      return 3;
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
      return 2;
    default:
      return 1;
  }
}

}  // namespace

template <typename Function>
Function Headless::load(const char* name) const {
  auto function = reinterpret_cast<Function>(get_(instance_, name));
  if (function == nullptr) {
    fail(WLK_ERROR_NO_DEVICE, WLK_STRUCT_HEADLESS_INFO, name, "the Vulkan loader does not offer %s",
         name);
  }
  return function;
}

Headless::Headless(const HeadlessOptions& options) : options_(options) {
  try {
    library_ = dlopen("libvulkan.so.1", RTLD_NOW | RTLD_LOCAL);
    if (library_ == nullptr) {
      fail(WLK_ERROR_NO_DEVICE, WLK_STRUCT_HEADLESS_INFO, "libvulkan.so.1",
           "the Vulkan loader was not found: %s", dlerror());
    }
    get_ = reinterpret_cast<PFN_vkGetInstanceProcAddr>(dlsym(library_, "vkGetInstanceProcAddr"));
    if (get_ == nullptr) {
      fail(WLK_ERROR_NO_DEVICE, WLK_STRUCT_HEADLESS_INFO, "vkGetInstanceProcAddr",
           "libvulkan.so.1 has no vkGetInstanceProcAddr");
    }
    createInstance(options);
    pickDevice(options);
    createDevice();
  } catch (...) {
    destroy();
    throw;
  }
}

Headless::~Headless() {
  destroy();
}

void Headless::createInstance(const HeadlessOptions& options) {
  VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
  application.pApplicationName = "welkin headless";
  application.apiVersion = VK_API_VERSION_1_3;
  VkInstanceCreateInfo info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
  info.pApplicationInfo = &application;
  const char* extension = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
  VkDebugUtilsMessengerCreateInfoEXT messenger{
      VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
  messenger.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                              VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  messenger.messageType =
      VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_GENERAL_BIT_EXT;
  messenger.pfnUserCallback = onMessage;
  messenger.pUserData = &options_;
  const VkValidationFeatureEnableEXT synchronization =
      VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
  VkValidationFeaturesEXT features{VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT};
  features.enabledValidationFeatureCount = 1;
  features.pEnabledValidationFeatures = &synchronization;
  if (options.validation) {
    messenger.pNext = &features;
    info.pNext = &messenger;
    info.enabledLayerCount = 1;
    info.ppEnabledLayerNames = &VALIDATION_LAYER;
    info.enabledExtensionCount = 1;
    info.ppEnabledExtensionNames = &extension;
  }
  const auto create = load<PFN_vkCreateInstance>("vkCreateInstance");
  const VkResult result = create(&info, nullptr, &instance_);
  if (result == VK_ERROR_LAYER_NOT_PRESENT) {
    fail(WLK_ERROR_NO_DEVICE, WLK_STRUCT_HEADLESS_INFO, "flags", "the layer %s is not installed",
         VALIDATION_LAYER);
  }
  if (result == VK_ERROR_OUT_OF_HOST_MEMORY || result == VK_ERROR_OUT_OF_DEVICE_MEMORY) {
    check(result, "vkCreateInstance");
  }
  if (result < 0) {
    fail(WLK_ERROR_NO_DEVICE, WLK_STRUCT_HEADLESS_INFO, "vkCreateInstance",
         "vkCreateInstance returned VkResult %d", static_cast<int>(result));
  }
  if (options.validation) {
    messenger.pNext = nullptr;
    check(load<PFN_vkCreateDebugUtilsMessengerEXT>("vkCreateDebugUtilsMessengerEXT")(
              instance_, &messenger, nullptr, &messenger_),
          "vkCreateDebugUtilsMessengerEXT");
  }
}

void Headless::pickDevice(const HeadlessOptions& options) {
  const auto enumerate = load<PFN_vkEnumeratePhysicalDevices>("vkEnumeratePhysicalDevices");
  const auto getProperties =
      load<PFN_vkGetPhysicalDeviceProperties>("vkGetPhysicalDeviceProperties");
  const auto getFamilies = load<PFN_vkGetPhysicalDeviceQueueFamilyProperties>(
      "vkGetPhysicalDeviceQueueFamilyProperties");
  uint32_t count = 0;
  check(enumerate(instance_, &count, nullptr), "vkEnumeratePhysicalDevices");
  std::vector<VkPhysicalDevice> devices(count);
  check(enumerate(instance_, &count, devices.data()), "vkEnumeratePhysicalDevices");
  int best = 0;
  for (VkPhysicalDevice device : devices) {
    VkPhysicalDeviceProperties properties{};
    getProperties(device, &properties);
    if (properties.apiVersion < VK_API_VERSION_1_3 ||
        (options.deviceName != nullptr &&
         std::strstr(properties.deviceName, options.deviceName) == nullptr) ||
        rank(properties.deviceType) <= best) {
      continue;
    }
    uint32_t families = 0;
    getFamilies(device, &families, nullptr);
    std::vector<VkQueueFamilyProperties> list(families);
    getFamilies(device, &families, list.data());
    const auto found = std::find_if(list.begin(), list.end(), [](const auto& family) {
      return (family.queueFlags & QUEUE_FLAGS) == QUEUE_FLAGS;
    });
    if (found != list.end()) {
      best = rank(properties.deviceType);
      physical_ = device;
      family_ = static_cast<uint32_t>(found - list.begin());
    }
  }
  if (physical_ == VK_NULL_HANDLE) {
    fail(WLK_ERROR_NO_DEVICE, WLK_STRUCT_HEADLESS_INFO, "deviceName",
         "none of %u Vulkan devices has version 1.3, graphics and compute%s%s", count,
         options.deviceName == nullptr ? "" : " and the name ",
         options.deviceName == nullptr ? "" : options.deviceName);
  }
}

void Headless::createDevice() {
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
  check(load<PFN_vkCreateDevice>("vkCreateDevice")(physical_, &info, nullptr, &handle_),
        "vkCreateDevice");
}

DeviceInfo Headless::deviceInfo() const {
  DeviceInfo info;
  info.getInstanceProcAddr = get_;
  info.instance = instance_;
  info.physicalDevice = physical_;
  info.device = handle_;
  info.queueFamilyIndex = family_;
  info.headless = true;
  return info;
}

void Headless::attach(const Device& device) {
  vk_ = device.vk();
  const Dispatch& vk = vk_;
  vk.GetDeviceQueue(handle_, family_, 0, &queue_);
  VkCommandPoolCreateInfo pool{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
  pool.queueFamilyIndex = family_;
  check(vk.CreateCommandPool(handle_, &pool, nullptr, &pool_), "vkCreateCommandPool");
  VkCommandBufferAllocateInfo commands{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
  commands.commandPool = pool_;
  commands.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  commands.commandBufferCount = 1;
  check(vk.AllocateCommandBuffers(handle_, &commands, &commands_), "vkAllocateCommandBuffers");
  VkFenceCreateInfo fence{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
  check(vk.CreateFence(handle_, &fence, nullptr, &fence_), "vkCreateFence");
}

VkCommandBuffer Headless::begin() {
  finish();
  const Dispatch& vk = vk_;
  check(vk.ResetCommandPool(handle_, pool_, 0), "vkResetCommandPool");
  VkCommandBufferBeginInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
  info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  check(vk.BeginCommandBuffer(commands_, &info), "vkBeginCommandBuffer");
  return commands_;
}

void Headless::submitAndWait() {
  if (const VkResult result = vk_.EndCommandBuffer(commands_); result < 0) {
    Failure failure;
    failure.result = WLK_ERROR_DEVICE_LOST;
    failure.vkResult = result;
    std::snprintf(failure.field, sizeof failure.field, "vkEndCommandBuffer");
    std::snprintf(failure.message, sizeof failure.message,
                  "vkEndCommandBuffer returned VkResult %d: the recorded uploads are gone",
                  static_cast<int>(result));
    throw failure;
  }
  pending_ = Pending::ENDED;
  finish();
}

void Headless::finish() {
  const Dispatch& vk = vk_;
  if (pending_ == Pending::ENDED) {
    check(vk.ResetFences(handle_, 1, &fence_), "vkResetFences");
    VkSubmitInfo submit{VK_STRUCTURE_TYPE_SUBMIT_INFO};
    submit.commandBufferCount = 1;
    submit.pCommandBuffers = &commands_;
    check(vk.QueueSubmit(queue_, 1, &submit, fence_), "vkQueueSubmit");
    pending_ = Pending::SUBMITTED;
  }
  if (pending_ == Pending::SUBMITTED) {
    check(vk.WaitForFences(handle_, 1, &fence_, VK_TRUE, UINT64_MAX), "vkWaitForFences");
    pending_ = Pending::NOTHING;
  }
}

void Headless::settle() noexcept {
  if (pending_ == Pending::SUBMITTED) {
    (void)vk_.DeviceWaitIdle(handle_);
  }
}

void Headless::destroy() {
  if (fence_ != VK_NULL_HANDLE) {
    vk_.DestroyFence(handle_, fence_, nullptr);
  }
  if (pool_ != VK_NULL_HANDLE) {
    vk_.DestroyCommandPool(handle_, pool_, nullptr);
  }
  if (handle_ != VK_NULL_HANDLE) {
    load<PFN_vkDestroyDevice>("vkDestroyDevice")(handle_, nullptr);
  }
  if (messenger_ != VK_NULL_HANDLE) {
    load<PFN_vkDestroyDebugUtilsMessengerEXT>("vkDestroyDebugUtilsMessengerEXT")(
        instance_, messenger_, nullptr);
  }
  if (instance_ != VK_NULL_HANDLE) {
    load<PFN_vkDestroyInstance>("vkDestroyInstance")(instance_, nullptr);
  }
  if (library_ != nullptr) {
    dlclose(library_);
  }
}

}  // namespace welkin::vk
