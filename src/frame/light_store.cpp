// SPDX-License-Identifier: MIT
#include "frame/light_store.hpp"

#include <algorithm>
#include <cstring>

namespace welkin {

std::optional<LightStoreShape> lightStoreShape(const SliceQuality& quality) {
  if (!quality.stored) {
    return std::nullopt;
  }
  const uint32_t form = quality.forwardScattering ? 1 + quality.form() : 0;
  return LightStoreShape{quality.lightRoom, quality.sliceRoom + 1, form};
}

VkDeviceSize lightStoreBytes(const LightStoreShape& shape) {
  const VkDeviceSize texels = VkDeviceSize{shape.size} * shape.size * shape.layers;
  return texels * (shape.form > 0 ? 2 : 1) * sizeof(float);
}

LightStore* findLightStore(VolumeState& volume, const SliceQuality& quality) {
  const std::optional<LightStoreShape> shape = lightStoreShape(quality);
  const auto found =
      std::find_if(volume.lightStores.begin(), volume.lightStores.end(),
                   [&](const LightStore& store) { return shape && store.shape == *shape; });
  return found == volume.lightStores.end() ? nullptr : &*found;
}

LightStore makeLightStore(vk::Device& device, const LightStoreShape& shape) {
  vk::ImageInfo info;
  info.type = VK_IMAGE_TYPE_3D;
  info.format = shape.form > 0 ? VK_FORMAT_R32G32_SFLOAT : VK_FORMAT_R32_SFLOAT;
  info.extent = {shape.size, shape.size, shape.layers};
  info.usage = VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
  LightStore store;
  store.shape = shape;
  store.image = vk::Image(device, info);
  return store;
}

bool keptInStore(LightStore& store, const VolumeState& volume, const SliceQuality& quality,
                 const interface_::VolumeUniforms& uniforms) {
  // The rows that the light's pass reads, less what only the eye's does.
  constexpr size_t ROWS = 6;
  std::array<glm::vec4, ROWS> rows{uniforms.texelOrigin,     uniforms.texelA,
                                   uniforms.texelB,          uniforms.texelC,
                                   uniforms.extinctionScale, uniforms.meanAlbedo};
  rows[0].w = rows[2].w = rows[3].w = 0;
  if (store.shape.form == 0) {
    rows[5] = glm::vec4(0);
  }
  LightStoreKey now{};
  static_assert(sizeof now.rows == sizeof rows + sizeof uniforms.forwardFraction);
  std::memcpy(now.rows.data(), rows.data(), sizeof rows);
  if (store.shape.form > 0) {
    std::memcpy(now.rows.data() + ROWS * 4, uniforms.forwardFraction,
                sizeof uniforms.forwardFraction);
  }
  now.slices = quality.sliceCount;
  now.size = quality.lightSize;
  now.version = volume.version;
  now.filled = true;
  const bool kept = now == store.key;
  store.key = now;
  return kept;
}

}  // namespace welkin
