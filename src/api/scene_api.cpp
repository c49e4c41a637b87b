// SPDX-License-Identifier: MIT
// Volumes: boxes of density fields.
#include <algorithm>
#include <cmath>
#include <utility>

#include "api/context.hpp"
#include "api/light_stores.hpp"

namespace {

using namespace welkin;

// Whether all colours scatter alike: equal curves make equal tables.
bool scattersGrey(const VolumeState& volume) {
  return std::all_of(volume.fields.begin(), volume.fields.begin() + volume.fieldCount,
                     [](const FieldState& field) {
                       const auto albedo = field.medium.scaledAlbedo();
                       const auto& value = field.medium.particle->curve.value;
                       return albedo[0] == albedo[1] && albedo[1] == albedo[2] &&
                              value[0] == value[1] && value[1] == value[2];
                     });
}

glm::dmat4x3 transformOf(const double* m) {
  return {m[0], m[4], m[8], m[1], m[5], m[9], m[2], m[6], m[10], m[3], m[7], m[11]};
}

void checkVolumeSize(const vk::Device& device, const WlkVolumeInfo& info) {
  const uint32_t limit = device.properties().limits.maxImageDimension3D;
  for (const uint32_t n : info.size) {
    if (n < 1) {
      fail(WLK_ERROR_INVALID_ARGUMENT, info.sType, "size", "WlkVolumeInfo::size holds a 0");
    }
    if (n > limit) {
      fail(WLK_ERROR_LIMIT_EXCEEDED, info.sType, "size",
           "WlkVolumeInfo::size holds %u, the device allows %u", n, limit);
    }
  }
}

// A field takes at least 2 bytes per voxel; refuses what no heap can hold before the driver does.
void checkVolumeMemory(vk::Device& device, const WlkVolumeInfo& info) {
  const double bytes = 2.0 * info.size[0] * info.size[1] * info.size[2] * info.fieldCount;
  const auto heap = static_cast<double>(device.memory().largestHeap());
  if (bytes > heap) {
    fail(WLK_ERROR_OUT_OF_DEVICE_MEMORY, info.sType, "size",
         "a volume of %u x %u x %u voxels needs %.0f MiB, the device's heap has %.0f", info.size[0],
         info.size[1], info.size[2], bytes / 1048576.0, heap / 1048576.0);
  }
}

}  // namespace

WlkResult wlkCreateVolume(WlkContext context, const WlkVolumeInfo* info, WlkVolume* volume) {
  return guarded([&] {
    WlkContext_T& c = checkContext(context);
    checkPointer(volume, "volume");
    const WlkVolumeInfo v = copyStruct(info, WLK_STRUCT_VOLUME_INFO);
    checkNoChain(info);
    vk::Device& device = c.requireDevice("wlkCreateVolume");
    checkRange(v.sType, "fieldCount", v.fieldCount, 1, WLK_MAX_FIELDS);
    checkVolumeSize(device, v);
    checkVolumeMemory(device, v);
    checkTransform(v.sType, "worldFromVolume", v.worldFromVolume);
    if (v.fieldStride < FIRST_SIZE<WlkVolumeField>) {
      fail(WLK_ERROR_INVALID_ARGUMENT, v.sType, "fieldStride",
           "WlkVolumeInfo::fieldStride is %u, expected at least %u", v.fieldStride,
           FIRST_SIZE<WlkVolumeField>);
    }
    checkPointer(v.fields, "fields");
    std::array<WlkVolumeField, WLK_MAX_FIELDS> fields{};
    for (uint32_t i = 0; i < v.fieldCount; ++i) {
      fields[i] = copyElement(v.fields, v.fieldStride, i, v.sType);
      c.medium(fields[i].medium);
      checkRange(v.sType, "extinctionScale", fields[i].extinctionScale, 0, 1e6);
    }
    const uint64_t id = c.volumes.create(&c.memory);
    VolumeState& state = *c.volumes.find(id);
    state.size = {v.size[0], v.size[1], v.size[2]};
    state.fieldCount = v.fieldCount;
    state.worldFromBox = transformOf(v.worldFromVolume);
    for (uint32_t i = 0; i < v.fieldCount; ++i) {
      const MediumState& used = c.medium(fields[i].medium);
      state.fields[i].medium = used.medium;
      state.fields[i].tables = used.tables;
      state.fields[i].nodes = used.nodes;
      state.fields[i].extinctionScale = fields[i].extinctionScale;
      const std::array<double, RGB> albedo = used.medium.scaledAlbedo();
      const double scattered = (albedo[0] + albedo[1] + albedo[2]) / RGB;
      const double turned = scattered * meanOneMinusCosine(*used.medium.particle);
      state.fields[i].transportShare = static_cast<float>(1 - scattered + turned);
      state.fields[i].absorbedShare = static_cast<float>(1 - scattered);
    }
    state.grey = scattersGrey(state);
    c.invalidate();
    volume->id = id;
    return WLK_SUCCESS;
  });
}

WlkResult wlkDestroyVolume(WlkContext context, WlkVolume volume) {
  return guarded([&] {
    WlkContext_T& c = checkContext(context);
    VolumeState& state = c.volume(volume);
    retireLightStores(c, state, {});
    Retired& entry = c.retired.emplace_back(&c.memory);
    entry.frame = c.frameIndex;
    for (uint32_t i = 0; i < state.fieldCount; ++i) {
      entry.images[i] = std::move(state.fields[i].image);
    }
    for (uint32_t form = 0; form < SCATTERING_FORMS; ++form) {
      entry.images[WLK_MAX_FIELDS + form] = std::move(state.tables[form].image);
      entry.buffers[form] = std::move(state.tables[form].staging);
    }
    entry.images[WLK_MAX_FIELDS + SCATTERING_FORMS] = std::move(state.pages);
    entry.images[WLK_MAX_FIELDS + SCATTERING_FORMS + 1] = std::move(state.leaps);
    entry.images[WLK_MAX_FIELDS + SCATTERING_FORMS + 2] = std::move(state.diameters);
    entry.buffers[SCATTERING_FORMS] = std::move(state.pairTable);
    std::erase_if(c.pending, [&](const PendingUpload& p) { return p.volumeId == volume.id; });
    c.volumes.destroy(volume.id);
    c.forgetBindings();
    c.collect();
    return WLK_SUCCESS;
  });
}

WlkResult wlkSetVolumeTransform(WlkContext context, WlkVolume volume,
                                const double worldFromVolume[12]) {
  return guarded([&] {
    WlkContext_T& c = checkContext(context);
    VolumeState& state = c.volume(volume);
    checkPointer(worldFromVolume, "worldFromVolume");
    checkTransform(WLK_STRUCT_VOLUME_INFO, "worldFromVolume", worldFromVolume);
    state.worldFromBox = transformOf(worldFromVolume);
    return WLK_SUCCESS;
  });
}
