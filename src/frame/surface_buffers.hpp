// SPDX-License-Identifier: MIT
// What surfaces of a view keep on the device beside their own meshes and light maps.
#pragma once

#include "frame/scene.hpp"

namespace welkin {

// Of the cover of so many pixels, with the word behind those of all that each has, or without.
VkDeviceSize coverBytes(VkDeviceSize pixels, bool further);

// Copies a waiting mesh; returns how many bytes.
VkDeviceSize uploadSurface(const vk::Device& device, VkCommandBuffer commands,
                           SurfaceState& surface);

// Buffers that all surfaces of a view use in turn.
void makeSurfaces(vk::Device& device, const WlkViewInfo& info, const SliceQuality& quality,
                  uint32_t surfaces, ViewResources& resources);

}  // namespace welkin
