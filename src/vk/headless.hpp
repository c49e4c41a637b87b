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
  // Commands that an earlier submitAndWait() could not bring to their end go first.
  VkCommandBuffer begin();
  // What fails for want of memory comes with the next begin(). Commands that cannot be ended are
  // gone, with uploads that nothing makes again: that is a lost device.
  void submitAndWait();
  // Before anything is destroyed: waits for commands that nobody has waited for.
  void settle() noexcept;

 private:
  void createInstance(const HeadlessOptions& options);
  void pickDevice(const HeadlessOptions& options);
  void createDevice();
  void destroy();
  void finish();
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
  Dispatch vk_;
  VkQueue queue_ = VK_NULL_HANDLE;
  VkCommandPool pool_ = VK_NULL_HANDLE;
  VkCommandBuffer commands_ = VK_NULL_HANDLE;
  VkFence fence_ = VK_NULL_HANDLE;
  enum class Pending { NOTHING, ENDED, SUBMITTED } pending_ = Pending::NOTHING;
};

}  // namespace welkin::vk
