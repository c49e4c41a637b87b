// SPDX-License-Identifier: MIT
// Vulkan of Welkin's own, for headless contexts: loader, instance, device, queue, one command
// buffer.
#pragma once

#include <welkin/welkin.h>

#include "vk/device.hpp"

namespace welkin::vk {

struct HeadlessOptions {
  const char* deviceName = nullptr;  // part of the wanted device's name, or null
  bool validation = false;
  WlkLogCallback log = nullptr;
  void* logUser = nullptr;
};

class Headless {
 public:
  explicit Headless(const HeadlessOptions& options);
  ~Headless();
  Headless(const Headless&) = delete;
  Headless& operator=(const Headless&) = delete;

  DeviceInfo deviceInfo() const;
  // Makes queue and command buffer; call once, with the device made from deviceInfo().
  void attach(const Device& device);
  VkCommandBuffer begin();
  void submitAndWait();

 private:
  void createInstance(const HeadlessOptions& options);
  void pickDevice(const HeadlessOptions& options);
  void createDevice();
  void destroy();
  template <typename Function>
  Function load(const char* name) const;

  void* library_ = nullptr;
  PFN_vkGetInstanceProcAddr get_ = nullptr;
  HeadlessOptions options_;
  VkInstance instance_ = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  VkPhysicalDevice physical_ = VK_NULL_HANDLE;
  VkDevice handle_ = VK_NULL_HANDLE;
  uint32_t family_ = 0;
  bool dualSrcBlend_ = false;
  Dispatch vk_;
  VkQueue queue_ = VK_NULL_HANDLE;
  VkCommandPool pool_ = VK_NULL_HANDLE;
  VkCommandBuffer commands_ = VK_NULL_HANDLE;
  VkFence fence_ = VK_NULL_HANDLE;
};

}  // namespace welkin::vk
