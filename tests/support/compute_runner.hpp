// SPDX-License-Identifier: MIT
// Runs one compute shader over a buffer of floats: the least Vulkan that a parity test needs.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace support {

// Throws std::runtime_error where a Vulkan call fails or there is no device.
class ComputeRunner {
 public:
  // Takes the first llvmpipe device, else the first device; with the Khronos validation layer,
  // synchronisation validation included, where it is installed.
  ComputeRunner();
  ~ComputeRunner();
  ComputeRunner(const ComputeRunner&) = delete;
  ComputeRunner& operator=(const ComputeRunner&) = delete;

  // Dispatches `groups` workgroups of a shader with entry point "main", storage buffers at
  // set 0 bindings 0 (input) and 1 (output, zeroed before), and specialisation constant 0 of type
  // int. Waits, and returns the output.
  std::vector<float> run(std::span<const uint32_t> spirv, int specialisation,
                         std::span<const float> input, size_t outputFloats, uint32_t groups);

  const std::string& deviceName() const { return deviceName_; }
  bool validated() const { return validated_; }
  // Warnings and errors of the validation layer so far.
  const std::vector<std::string>& messages() const { return messages_; }

 private:
  struct Buffer {
    VkBuffer buffer = VK_NULL_HANDLE;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    float* data = nullptr;
  };

  void makeInstance();
  void makeDevice();
  Buffer makeBuffer(VkDeviceSize bytes);
  void free(Buffer& buffer);
  void destroy();
  void submit(VkPipeline pipeline, VkPipelineLayout layout, VkDescriptorSet set, uint32_t groups,
              VkBuffer output);

  VkInstance instance_ = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  VkPhysicalDevice physical_ = VK_NULL_HANDLE;
  VkDevice device_ = VK_NULL_HANDLE;
  VkQueue queue_ = VK_NULL_HANDLE;
  uint32_t family_ = 0;
  std::string deviceName_;
  bool validated_ = false;
  std::vector<std::string> messages_;
};

}  // namespace support
