// SPDX-License-Identifier: MIT
// What Vulkan leaves to devices: lavapipe, the driver of all recorded figures, fuses no products
// and filters with exact weights; tests allow others what the specification allows them.
#pragma once

#include <cstdlib>
#include <cstring>

namespace welkin::test {

// Whether the environment chose another driver than lavapipe for the tests, which take that one
// otherwise.
inline bool onGpu() {
  if (std::getenv("WELKIN_ANY_DEVICE") != nullptr) {
    return true;
  }
  for (const char* name : {"VK_DRIVER_FILES", "VK_ICD_FILENAMES"}) {
    if (const char* value = std::getenv(name)) {
      return std::strstr(value, "lvp_icd") == nullptr;
    }
  }
  return false;
}

// Positions in textures are rounded to this part of a texel (subTexelPrecisionBits is 8 on all
// desktop devices): where two differ by a rounding of floats, so may the step, and what is filtered
// by as much of the difference of neighbouring texels.
constexpr double FILTER_STEP = 0x1p-8;

}  // namespace welkin::test
