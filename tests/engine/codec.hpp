// SPDX-License-Identifier: MIT
// Texels of the formats in these tests, to and from floats.
#pragma once

#include <vulkan/vulkan_core.h>

#include <span>
#include <vector>

namespace engine {

uint32_t texelBytes(VkFormat format);
// Floats per texel: 4 for colours (RGBA; alpha is 1 where the format has none), else 1.
uint32_t channels(VkFormat format);

// Values as the nearest texels. Depth values must lie in [0, 1].
std::vector<unsigned char> encode(VkFormat format, std::span<const float> values);
std::vector<float> decode(VkFormat format, std::span<const unsigned char> bytes);

// What the format keeps of the values.
inline std::vector<float> quantised(VkFormat format, std::span<const float> values) {
  return decode(format, encode(format, values));
}

}  // namespace engine
