// SPDX-License-Identifier: MIT
// The images of a frame, and the states in which the passes hand them on.
#pragma once

#include <optional>

#include "engine/resources.hpp"

inline constexpr VkFormat COLOR_FORMAT = VK_FORMAT_R16G16B16A16_SFLOAT;
inline constexpr VkFormat DEPTH_FORMAT = VK_FORMAT_D32_SFLOAT;

struct Targets {
  Targets(const Gpu& gpu, VkExtent2D extent, uint32_t composite);

  Image color;  // the engine's picture; with COMPUTE and BLEND Welkin draws over it
  Image depth;
  // Welkin's layer, with WLK_COMPOSITE_SEPARATE only.
  std::optional<Image> radiance;
  std::optional<Image> transmittance;
};
