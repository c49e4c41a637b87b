// SPDX-License-Identifier: MIT
// The images of a frame, and the states in which the passes hand them on.
#pragma once

#include <optional>

#include "resources.hpp"

inline constexpr VkFormat COLOR_FORMAT = VK_FORMAT_R16G16B16A16_SFLOAT;
inline constexpr VkFormat DEPTH_FORMAT = VK_FORMAT_D32_SFLOAT;

inline constexpr ImageState COLOR_ATTACHMENT{
    VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, 0, VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
    VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT};
inline constexpr ImageState DEPTH_ATTACHMENT{
    VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL, 0,
    VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT};
// Read by the present pass.
inline constexpr ImageState SAMPLED{VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, 0,
                                    VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
                                    VK_ACCESS_2_SHADER_SAMPLED_READ_BIT};

// The same image at the start of the next frame: contents no longer needed, but the last use must
// be over before the next one overwrites it.
constexpr ImageState discarded(ImageState lastUse) {
  lastUse.layout = VK_IMAGE_LAYOUT_UNDEFINED;
  return lastUse;
}

struct Targets {
  Targets(const Gpu& gpu, VkExtent2D extent, uint32_t composite);

  Image color;  // the engine's picture; with COMPUTE and BLEND Welkin draws over it
  Image depth;
  // Welkin's layer, with WLK_COMPOSITE_SEPARATE only.
  std::optional<Image> radiance;
  std::optional<Image> transmittance;
};
