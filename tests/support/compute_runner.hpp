// SPDX-License-Identifier: MIT
// Runs one compute shader over a buffer of floats: the least Vulkan that a parity test needs.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "support/test_device.hpp"

namespace support {

// Throws std::runtime_error where a Vulkan call fails or there is no device.
class ComputeRunner {
 public:
  // Takes the first llvmpipe device, else (or by WELKIN_ANY_DEVICE) the first; with the Khronos
  // validation layer, synchronisation validation included, where it is installed.
  ComputeRunner();

  // Dispatches `groups` workgroups of a shader with entry point "main", storage buffers at
  // set 0 bindings 0 (input) and 1 (output, zeroed before), and specialisation constant 0 of type
  // int. Waits, and returns the output.
  std::vector<float> run(std::span<const uint32_t> spirv, int specialisation,
                         std::span<const float> input, size_t outputFloats, uint32_t groups);

  const std::string& deviceName() const { return deviceName_; }
  bool validated() const { return device_.validated(); }
  // Warnings and errors of the validation layer so far.
  const std::vector<std::string>& messages() const { return device_.messages(); }

 private:
  TestDevice device_;
  std::string deviceName_;
};

}  // namespace support
