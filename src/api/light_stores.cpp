// SPDX-License-Identifier: MIT
#include "api/light_stores.hpp"

#include <algorithm>

#include "frame/ladder.hpp"

namespace welkin {
namespace {

// Device memory for all of a context's stores: room for 15 volumes at the level high. What finds no
// room is drawn in batches.
constexpr VkDeviceSize MOST_STORED = VkDeviceSize{512} << 20;

bool among(std::span<const LightStoreShape> shapes, const LightStoreShape& shape) {
  return std::find(shapes.begin(), shapes.end(), shape) != shapes.end();
}

// The same on every rung.
SliceQuality qualityOf(const ViewState& view) {
  return governed(view.quality) ? rungQuality(view.quality, rungRange(view.quality).highest)
                                : resolveQuality(view.quality);
}

bool has(const VolumeState& volume, const LightStoreShape& shape) {
  return std::any_of(volume.lightStores.begin(), volume.lightStores.end(),
                     [&](const LightStore& store) { return store.shape == shape; });
}

}  // namespace

void retireLightStores(WlkContext_T& c, VolumeState& volume,
                       std::span<const LightStoreShape> wanted) {
  c.retired.reserve(c.retired.size() + volume.lightStores.size() + 1);  // one for the volume itself
  bool gone = false;
  for (LightStore& store : volume.lightStores) {
    if (!among(wanted, store.shape)) {
      Retired& entry = c.retired.emplace_back(&c.memory);
      entry.frame = c.frameIndex;
      entry.images[0] = std::move(store.image);
      gone = true;
    }
  }
  std::erase_if(volume.lightStores,
                [&](const LightStore& store) { return !among(wanted, store.shape); });
  if (gone) {
    c.forgetBindings();
  }
}

void prepareLightStores(WlkContext_T& c) {
  std::vector<LightStoreShape> wanted;
  for (uint32_t i = 0; i < c.views.slotCount(); ++i) {
    if (const ViewState* view = c.views.at(i)) {
      const std::optional<LightStoreShape> shape = lightStoreShape(qualityOf(*view));
      if (shape && !among(wanted, *shape)) {
        wanted.push_back(*shape);
      }
    }
  }
  VkDeviceSize bytes = 0;
  for (uint32_t i = 0; i < c.volumes.slotCount(); ++i) {
    if (VolumeState* volume = c.volumes.at(i)) {
      retireLightStores(c, *volume, wanted);
      for (const LightStore& store : volume->lightStores) {
        bytes += lightStoreBytes(store.shape);
      }
    }
  }
  for (uint32_t i = 0; i < c.volumes.slotCount(); ++i) {
    VolumeState* volume = c.volumes.at(i);
    for (const LightStoreShape& shape : wanted) {
      const VkDeviceSize more = lightStoreBytes(shape);
      const bool fits =
          std::max(shape.size, shape.layers) <= c.device->properties().limits.maxImageDimension3D;
      if (volume != nullptr && fits && !has(*volume, shape) && bytes + more <= MOST_STORED) {
        volume->lightStores.push_back(makeLightStore(*c.device, shape));
        bytes += more;
      }
    }
  }
}

void chooseStores(WlkContext_T& c, const ViewState& view, SceneFeatures& features) {
  features.stores = features.batches = false;
  const SliceQuality quality = qualityOf(view);
  for (uint32_t i = 0; i < c.volumes.slotCount(); ++i) {
    if (VolumeState* volume = c.volumes.at(i)) {
      (findLightStore(*volume, quality) != nullptr ? features.stores : features.batches) = true;
    }
  }
}

}  // namespace welkin
