// SPDX-License-Identifier: MIT
// The light of all slabs of a volume, kept by the context for every view that asks for the same
// numbers of slabs and texels: computed where light, place or density have changed, not where an
// eye has moved.
#pragma once

#include <span>

#include "frame/scene.hpp"
#include "frame/uniforms.hpp"

namespace welkin {

// What a view of this quality shares; nothing where it keeps no light.
std::optional<LightStoreShape> lightStoreShape(const SliceQuality& quality);
VkDeviceSize lightStoreBytes(const LightStoreShape& shape);

// Null if the volume keeps no light of that shape.
LightStore* findLightStore(VolumeState& volume, const SliceQuality& quality);

LightStore makeLightStore(vk::Device& device, const LightStoreShape& shape);

// Whether the store holds what would be computed from these numbers; remembers them.
bool keptInStore(LightStore& store, const VolumeState& volume, const SliceQuality& quality,
                 const interface_::VolumeUniforms& uniforms);

}  // namespace welkin
