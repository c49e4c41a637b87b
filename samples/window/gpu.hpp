// SPDX-License-Identifier: MIT
// The engine's instance, device and queue.
#pragma once

#include <vulkan/vulkan.h>

#include <atomic>
#include <vector>

struct GLFWwindow;

// Throws std::runtime_error naming the call for a negative result.
void check(VkResult result, const char* call);

class Gpu {
 public:
  // The window must outlive it.
  Gpu(GLFWwindow* window, bool validate);
  ~Gpu();
  Gpu(const Gpu&) = delete;
  Gpu& operator=(const Gpu&) = delete;

  VkInstance instance() const { return instance_; }
  VkSurfaceKHR surface() const { return surface_; }
  VkPhysicalDevice physical() const { return physical_; }
  VkDevice device() const { return device_; }
  VkQueue queue() const { return queue_; }
  uint32_t family() const { return family_; }
  // Messages of the validation layer so far.
  uint32_t messages() const { return messages_; }
  void waitIdle() const { check(vkDeviceWaitIdle(device_), "vkDeviceWaitIdle"); }

 private:
  void createInstance(bool validate);
  void pickDevice();
  void createDevice();
  static VKAPI_ATTR VkBool32 VKAPI_CALL onMessage(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                                  VkDebugUtilsMessageTypeFlagsEXT,
                                                  const VkDebugUtilsMessengerCallbackDataEXT* data,
                                                  void* user);

  VkInstance instance_ = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  VkSurfaceKHR surface_ = VK_NULL_HANDLE;
  VkPhysicalDevice physical_ = VK_NULL_HANDLE;
  uint32_t family_ = 0;
  VkDevice device_ = VK_NULL_HANDLE;
  VkQueue queue_ = VK_NULL_HANDLE;
  std::atomic<uint32_t> messages_{0};
};
