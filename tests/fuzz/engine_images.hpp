// SPDX-License-Identifier: MIT
// An engine's images for fuzzing, one for each role that views and maps of shadows know.
#pragma once

#include <algorithm>
#include <limits>

#include "framed.hpp"
#include "support/spy_device.hpp"

namespace fuzz {

using welkin::test::SpyDevice;
using welkin::test::SpyImage;

inline constexpr VkExtent3D VIEW{8, 6, 1};
inline constexpr VkExtent3D OTHER{4, 4, 1};
inline constexpr VkExtent3D MAP{16, 12, 1};
inline constexpr VkExtent3D FROXELS{5, 4, 3};
inline constexpr VkExtent3D VOXELS{4, 3, 2};
inline constexpr VkFormat RGBA32 = VK_FORMAT_R32G32B32A32_SFLOAT;
inline constexpr VkFormat RGBA16 = VK_FORMAT_R16G16B16A16_SFLOAT;

// Images of the roles that views and maps know, all in the layout GENERAL between frames.
struct Images {
  explicit Images(const SpyDevice& spy)
      : color32(spy, RGBA32, VIEW, ALL),
        color16(spy, RGBA16, VIEW, ALL),
        radiance32(spy, RGBA32, VIEW, ALL),
        radiance16(spy, RGBA16, VIEW, ALL),
        transmittance32(spy, RGBA32, VIEW, ALL),
        transmittance16(spy, RGBA16, VIEW, ALL),
        other(spy, RGBA32, OTHER, ALL),
        input(spy, RGBA32, VIEW, ALL),
        depth(spy, VK_FORMAT_R32_SFLOAT, VIEW, ALL),
        shadow(spy, VK_FORMAT_R32_SFLOAT, MAP, ALL),
        mapDepth(spy, VK_FORMAT_R32_SFLOAT, MAP, ALL),
        mapColor(spy, RGBA16, MAP, ALL),
        aerialRadiance(spy, RGBA16, FROXELS, STORED),
        aerialTransmittance(spy, RGBA16, FROXELS, STORED),
        distance(spy, VK_FORMAT_R32G32_SFLOAT, VIEW, ALL),
        voxels(spy, VK_FORMAT_R16_SFLOAT, VOXELS, STORED) {
    fill(input, 0.5f);
    fill(depth, 0.25f);
    fill(shadow, 0.5f);
    for (const SpyImage* image :
         {&color32, &color16, &radiance32, &radiance16, &transmittance32, &transmittance16, &other,
          &mapDepth, &mapColor, &aerialRadiance, &aerialTransmittance, &distance}) {
      fill(*image, 0.0f);
    }
    // Half floats: ones, a half, nothing, what is no density.
    static constexpr uint16_t HALVES[] = {0x3c00, 0x3800, 0, 0x7e00, 0xbc00, 0x3c00};
    auto* voxel = static_cast<uint16_t*>(voxels.bytes());
    for (uint32_t i = 0; i < VOXELS.width * VOXELS.height * VOXELS.depth; ++i) {
      voxel[i] = HALVES[i % std::size(HALVES)];
    }
    voxels.write(VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
  }

  static void fill(const SpyImage& image, float value) {
    auto* values = static_cast<float*>(image.bytes());
    std::fill_n(values, texels(image) * 4, value);
    image.write(VK_IMAGE_LAYOUT_GENERAL);
  }
  static size_t texels(const SpyImage& image) {
    return size_t{image.extent.width} * image.extent.height * image.extent.depth;
  }

  static constexpr VkImageUsageFlags STORED =
      VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
  static constexpr VkImageUsageFlags ALL = STORED | VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
  SpyImage color32, color16, radiance32, radiance16, transmittance32, transmittance16, other, input,
      depth, shadow, mapDepth, mapColor, aerialRadiance, aerialTransmittance, distance, voxels;
};

// Of floats or half floats, read back from an image.
inline void requireLightIn(const SpyImage& image) {
  image.read(VK_IMAGE_LAYOUT_GENERAL);
  const size_t count = Images::texels(image) * (image.format == VK_FORMAT_R32_SFLOAT      ? 1
                                                : image.format == VK_FORMAT_R32G32_SFLOAT ? 2
                                                                                          : 4);
  if (image.format != RGBA16) {
    requireLight(static_cast<const float*>(image.bytes()), count, std::numeric_limits<float>::max(),
                 "texels are finite and not negative");
    return;
  }
  constexpr uint16_t INFINITE = 0x7c00;
  constexpr uint16_t MINUS_ZERO = 0x8000;
  for (size_t i = 0; i < count; ++i) {
    const uint16_t half = static_cast<const uint16_t*>(image.bytes())[i];
    require(half < INFINITE || half == MINUS_ZERO, "half floats are finite and not negative");
  }
}

}  // namespace fuzz
