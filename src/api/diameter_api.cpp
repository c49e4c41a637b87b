// SPDX-License-Identifier: MIT
// Droplets whose diameter changes inside a volume.
#include <algorithm>
#include <utility>

#include "api/context.hpp"
#include "api/leap_maps.hpp"
#include "api/volume_data.hpp"

namespace {

using namespace welkin;

// Fails where the medium is not of droplets as the tables have them.
const std::shared_ptr<const DiameterNodes>& nodesOf(const Medium& medium, LateNodes& late) {
  if (!variesInDiameter(medium)) {
    fail(WLK_ERROR_INVALID_ARGUMENT, 0, "medium",
         "diameters need a medium of cloud, fog, haze or rain with the default spread");
  }
  if (!late.made) {
    late.made = std::make_shared<const DiameterNodes>(makeDiameterNodes(medium));
  }
  return late.made;
}

void checkDiameters(const VolumeState& volume, const WlkVolumeUpload& u) {
  checkUpload(volume, u);
  if (u.format == WLK_FORMAT_R8_UNORM) {
    fail(WLK_ERROR_UNSUPPORTED_FORMAT, u.sType, "format", "diameters in um need floats");
  }
  if (!std::equal(volume.size.begin(), volume.size.end(), u.extent)) {
    fail(WLK_ERROR_INVALID_ARGUMENT, u.sType, "extent",
         "diameters are given for all voxels at once, %u x %u x %u", volume.size[0], volume.size[1],
         volume.size[2]);
  }
}

// Voxels in nodes, tightly, as half floats: under 1/128 of a step beside.
void placeVoxels(const DiameterNodes& nodes, const WlkVolumeUpload& u, uint16_t* to) {
  const uint64_t voxel = bytesPerVoxel(u.format);
  const uint64_t rowPitch = u.rowPitch == 0 ? voxel * u.extent[0] : u.rowPitch;
  const uint64_t slicePitch = u.slicePitch == 0 ? rowPitch * u.extent[1] : u.slicePitch;
  for (uint32_t z = 0; z < u.extent[2]; ++z) {
    for (uint32_t y = 0; y < u.extent[1]; ++y) {
      const auto* from = static_cast<const unsigned char*>(u.data) + z * slicePitch + y * rowPitch;
      for (uint32_t x = 0; x < u.extent[0]; ++x, from += voxel, ++to) {
        const auto diameter = static_cast<double>(readVoxel(from, u.format));
        *to = halfFromFloat(static_cast<float>(nodes.place(diameter)));
      }
    }
  }
}

// The tables get or lose the nodes' layers: frames in flight keep what they use.
void retireTables(VolumeState& state, Retired& room) {
  for (uint32_t form = 0; form < SCATTERING_FORMS; ++form) {
    room.images[form] = std::move(state.tables[form].image);
    room.buffers[form] = std::move(state.tables[form].staging);
    state.tables[form] = {};
  }
}

void forgetPending(WlkContext_T& c, uint64_t volume) {
  std::erase_if(c.pending, [&](const PendingUpload& pending) {
    return pending.volumeId == volume && pending.field == DIAMETERS;
  });
}

}  // namespace

WlkResult wlkUploadVolumeDiameters(WlkContext context, WlkVolume volume,
                                   const WlkVolumeUpload* diameters) {
  return guarded([&] {
    WlkContext_T& c = checkContext(context);
    VolumeState& state = c.volume(volume);
    const WlkVolumeUpload u = copyStruct(diameters, WLK_STRUCT_VOLUME_UPLOAD);
    checkNoChain(diameters);
    checkDiameters(state, u);
    const FieldState& field = state.fields[u.field];
    const std::shared_ptr<const DiameterNodes> nodes = nodesOf(field.medium, *field.nodes);
    vk::Device& device = c.requireDevice("wlkUploadVolumeDiameters");
    PendingUpload pending = makePending(device, volume.id, DIAMETERS, state.size, sizeof(uint16_t));
    placeVoxels(*nodes, u, static_cast<uint16_t*>(pending.staging.data()));
    vk::Image image;
    if (!state.diameters) {
      vk::ImageInfo info;
      info.type = VK_IMAGE_TYPE_3D;
      info.format = VK_FORMAT_R16_SFLOAT;
      info.extent = {state.size[0], state.size[1], state.size[2]};
      info.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
      image = vk::Image(device, info);
    }
    const bool other = image || state.diameterField != u.field;
    Retired& room = c.retired.emplace_back(&c.memory);
    c.pending.reserve(c.pending.size() + 1);
    // Nothing throws from here on.
    room.frame = c.frameIndex;
    if (image) {
      state.diameters = std::move(image);
    }
    if (other) {
      retireTables(state, room);
      state.diameterField = u.field;
      state.diameterNodes = nodes;
      c.forgetBindings();
      c.invalidate();
    }
    forgetPending(c, volume.id);
    c.pending.push_back(std::move(pending));
    return WLK_SUCCESS;
  });
}

WlkResult wlkClearVolumeDiameters(WlkContext context, WlkVolume volume) {
  return guarded([&] {
    WlkContext_T& c = checkContext(context);
    VolumeState& state = c.volume(volume);
    if (!state.diameters) {
      return WLK_SUCCESS;
    }
    Retired& room = c.retired.emplace_back(&c.memory);
    room.frame = c.frameIndex;
    room.images[SCATTERING_FORMS] = std::move(state.diameters);
    state.diameterNodes.reset();
    retireTables(state, room);
    forgetPending(c, volume.id);
    c.forgetBindings();
    c.invalidate();
    return WLK_SUCCESS;
  });
}

WlkResult wlkEvalWaterExtinction(WlkContext context, WlkMedium medium, uint32_t count,
                                 const float* waterContent, const float* diameter_um,
                                 float* extinction) {
  return guarded([&] {
    WlkContext_T& c = checkContext(context);
    const MediumState& state = c.medium(medium);
    const DiameterNodes& nodes = *nodesOf(state.medium, *state.nodes);
    if (count > 0) {
      checkPointer(waterContent, "waterContent");
      checkPointer(extinction, "extinction");
    }
    for (uint32_t i = 0; i < count; ++i) {
      checkRange(0, "waterContent", waterContent[i], 0.0f, 1e3f);
    }
    for (uint32_t i = 0; i < count; ++i) {
      const double diameter = diameter_um == nullptr ? 0.0 : static_cast<double>(diameter_um[i]);
      extinction[i] = static_cast<float>(static_cast<double>(waterContent[i]) *
                                         nodes.extinctionPerMass(diameter));
    }
    return WLK_SUCCESS;
  });
}
