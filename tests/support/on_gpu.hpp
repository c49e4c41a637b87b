// SPDX-License-Identifier: MIT
// What Vulkan leaves to devices. Lavapipe, the driver of all recorded figures, is the one that has
// exact filters and rounds to nearest; tests allow others what the specification allows them.
#pragma once

#include <cstdlib>
#include <cstring>

namespace welkin::test {

// Whether the environment chose another driver than lavapipe for the tests.
inline bool onGpu() {
  for (const char* name : {"VK_DRIVER_FILES", "VK_ICD_FILENAMES"}) {
    if (const char* value = std::getenv(name)) {
      return std::strstr(value, "lvp_icd") == nullptr;
    }
  }
  return true;
}

// Largest relative error of a store to half floats: to nearest it is half a step, but devices may
// round towards zero (Vulkan 1.3, "Fixed-Point Data Conversions"; NVIDIA's do).
constexpr double HALF_FLOAT_STORE = 0x1p-10;

// Positions in textures are rounded to this part of a texel (subTexelPrecisionBits is 8 on all
// desktop devices): where two differ by a rounding of floats, so may the step, and what is filtered
// by as much of the difference of neighbouring texels.
constexpr double FILTER_STEP = 0x1p-8;

}  // namespace welkin::test
