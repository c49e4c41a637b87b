// SPDX-License-Identifier: MIT
// An engine's instance, device and queue. What the sample hosts with a window have in common.
#pragma once

#include <vulkan/vulkan.h>

#include <atomic>
#include <functional>
#include <mutex>
#include <vector>

// Throws std::runtime_error naming the call for a negative result.
void check(VkResult result, const char* call);

// How a toolkit's window gets its surface.
struct SurfaceSource {
  std::vector<const char*> instanceExtensions;
  std::function<VkSurfaceKHR(VkInstance)> create;
  // The toolkit destroys the surface with the window; the instance is left to the source's maker.
  bool toolkitDestroys = false;
};

class Gpu {
 public:
  // The window must outlive it.
  Gpu(const SurfaceSource& source, bool validate);
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
  // Held while anything is submitted or presented: threads may share the queue.
  std::mutex& queueLock() const { return queueLock_; }
  void waitIdle() const {
    const std::scoped_lock lock(queueLock_);
    check(vkDeviceWaitIdle(device_), "vkDeviceWaitIdle");
  }

 private:
  void createInstance(std::vector<const char*> extensions, bool validate);
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
  mutable std::mutex queueLock_;
  bool ownsSurface_;
  std::atomic<uint32_t> messages_{0};
};
