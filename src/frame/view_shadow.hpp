// SPDX-License-Identifier: MIT
// A view's own map of the volumes' shadow, by which they shade air, fog and ground.
#pragma once

#include "frame/record.hpp"
#include "frame/resources.hpp"

namespace welkin {

// Room for the map and its image.
void makeViewShadow(vk::Device& device, vk::Pipelines& pipelines, uint32_t volumeCount,
                    uint32_t framesInFlight, std::span<const uint32_t> fieldKinds,
                    ViewResources& r);

// Records the map if the plan has shadows and it may have changed, and writes its place into the
// frame's constants. A line of the statistics, if the quality asks for shadows. Returns whether
// commands were recorded.
bool recordViewShadow(const vk::Device& device, const vk::Pipelines& pipelines,
                      VkCommandBuffer commands, ViewState& view, const RecordInput& in);

}  // namespace welkin
