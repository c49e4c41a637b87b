// SPDX-License-Identifier: MIT
// The data of volumes: voxels, bricks, and what they take.
#include <algorithm>
#include <utility>

#include "api/brick_data.hpp"
#include "api/context.hpp"
#include "api/leap_maps.hpp"

namespace {

using namespace welkin;

vk::Image makeFieldImage(vk::Device& device, VkFormat format, const Edges& texels) {
  vk::ImageInfo info;
  info.type = VK_IMAGE_TYPE_3D;
  info.format = format;
  info.extent = {texels[0], texels[1], texels[2]};
  info.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  return vk::Image(device, info);
}

void forgetPending(WlkContext_T& c, uint64_t volume, uint32_t field) {
  std::erase_if(c.pending, [&](const PendingUpload& pending) {
    return pending.volumeId == volume && pending.field == field;
  });
}

// Gives the field another image; the last goes to `room` with the frames that use it.
void replaceImage(WlkContext_T& c, uint64_t volume, uint32_t index, FieldState& field,
                  vk::Image&& image, const Edges& atlas, Retired& room) {
  forgetPending(c, volume, index);
  const bool bricks = field.bricks();
  room.frame = c.frameIndex;
  if (field.image) {
    room.images[0] = std::move(field.image);
    c.forgetBindings();
  }
  field.image = std::move(image);
  field.atlas = atlas;
  field.slots = 0;
  if (field.bricks() != bricks) {
    c.invalidate();
  }
}

// The channel of a field in the pages: the slots of the bricks `reached`.
void writePages(const VolumeState& state, uint32_t field, std::span<const uint32_t> reached,
                const Edges& shape, std::pmr::vector<float>& texels) {
  const size_t channels = state.pageChannels();
  texels.resize(brickGrid(state.size).total() * channels);
  for (size_t i = field; i < texels.size(); i += channels) {
    texels[i] = 0.0f;
  }
  for (size_t slot = 0; slot < reached.size(); ++slot) {
    texels[reached[slot] * channels + field] = pageOf(shape, slot);
  }
}

PendingUpload stagePages(vk::Device& device, uint64_t volume, const VolumeState& state,
                         const std::pmr::vector<float>& texels) {
  PendingUpload pending = makePending(device, volume, PAGES, brickGrid(state.size).count,
                                      sizeof(float) * state.pageChannels());
  std::memcpy(pending.staging.data(), texels.data(), texels.size() * sizeof(float));
  return pending;
}

// Voxels take the place of bricks: all of them.
void checkReplaces(const VolumeState& state, const WlkVolumeUpload& u) {
  if (!std::equal(state.size.begin(), state.size.end(), u.extent)) {
    fail(WLK_ERROR_INVALID_ARGUMENT, u.sType, "extent",
         "field %u is kept as bricks: voxels replace them all, %u x %u x %u", u.field,
         state.size[0], state.size[1], state.size[2]);
  }
}

// Whether voxels of `format` go into the image that the field has. Floats that replace all of a
// field of half floats get an image of their own: values that came first, in a narrower format,
// must not cost what comes later its digits.
bool fits(const VolumeState& state, const FieldState& field, const WlkVolumeUpload& u,
          VkFormat format) {
  const bool whole = std::equal(state.size.begin(), state.size.end(), u.extent);
  return field.image && field.atlas[0] == 0 &&
         !(whole && format == VK_FORMAT_R32_SFLOAT && field.image.info().format != format);
}

// Once no field has bricks.
void dropPages(WlkContext_T& c, uint64_t volume, VolumeState& state, Retired& room) {
  const bool used = std::any_of(state.fields.begin(), state.fields.end(),
                                [](const FieldState& field) { return field.atlas[0] > 0; });
  if (state.pages && !used) {
    forgetPending(c, volume, PAGES);
    room.images[1] = std::move(state.pages);
    state.pageTexels.clear();
    c.forgetBindings();
  }
}

void tellReplaced(const WlkContext_T& c, const VoxelSums& sums, uint32_t field) {
  if (sums.replaced > 0) {
    c.emit(WLK_LOG_WARNING, WLK_LOG_ID_VALUES_REPLACED,
           "field %u: %llu voxels were negative, not finite or over 65504", field,
           static_cast<unsigned long long>(sums.replaced));
  }
}

void takeSums(const VolumeState& state, const VoxelSums& sums, double part, FieldState& field) {
  const bool whole = part == 1;
  if (whole) {
    field.filled = {};
  }
  for (size_t i = 0; i < 3; ++i) {
    field.filled.first[i] = std::min(field.filled.first[i], sums.filled.first[i]);
    field.filled.end[i] = std::max(field.filled.end[i], sums.filled.end[i]);
  }
  field.largest = whole ? sums.largest : std::max(field.largest, sums.largest);
  const double all = double(state.size[0]) * state.size[1] * state.size[2];
  field.mean = (1 - part) * field.mean + sums.sum / all;
  field.meanSquare = (1 - part) * field.meanSquare + sums.squares / all;
}

uint64_t imageBytes(const vk::Image& image) {
  if (!image) {
    return 0;
  }
  const vk::ImageInfo& info = image.info();
  const uint64_t texel = info.format == VK_FORMAT_R8_UNORM              ? 1
                         : info.format == VK_FORMAT_R8G8_UNORM          ? 2
                         : info.format == VK_FORMAT_R16_SFLOAT          ? 2
                         : info.format == VK_FORMAT_R32G32B32A32_SFLOAT ? 16
                                                                        : 4;
  return texel * info.extent.width * info.extent.height * info.extent.depth;
}

}  // namespace

WlkResult wlkUploadVolume(WlkContext context, WlkVolume volume, const WlkVolumeUpload* upload) {
  return guarded([&] {
    WlkContext_T& c = checkContext(context);
    VolumeState& state = c.volume(volume);
    const WlkVolumeUpload u = copyStruct(upload, WLK_STRUCT_VOLUME_UPLOAD);
    checkNoChain(upload);
    checkUpload(state, u);
    FieldState& field = state.fields[u.field];
    vk::Device& device = c.requireDevice("wlkUploadVolume");
    if (field.atlas[0] > 0) {
      checkReplaces(state, u);
    }
    vk::Image image;
    VkFormat format =
        u.format == WLK_FORMAT_R32_FLOAT ? VK_FORMAT_R32_SFLOAT : VK_FORMAT_R16_SFLOAT;
    if (fits(state, field, u, format)) {
      format = field.image.info().format;
    } else {
      image = makeFieldImage(device, format, state.size);
    }
    const bool toFloat = format == VK_FORMAT_R32_SFLOAT;
    PendingUpload pending = makePending(device, volume.id, u.field,
                                        {u.extent[0], u.extent[1], u.extent[2]}, toFloat ? 4 : 2);
    pending.region.imageOffset = {static_cast<int32_t>(u.offset[0]),
                                  static_cast<int32_t>(u.offset[1]),
                                  static_cast<int32_t>(u.offset[2])};
    BrickFaces faces(state.faces[u.field], &c.memory);
    faces.resize(brickGrid(state.size).total());
    const VoxelSums sums = convertVoxels(u, toFloat, pending.staging.data(), state.size, faces);
    Retired& room = c.retired.emplace_back(&c.memory);
    renewLeaps(c, volume.id, state);
    c.pending.push_back({});
    // Nothing throws from here on.
    if (image) {
      replaceImage(c, volume.id, u.field, field, std::move(image), {}, room);
      dropPages(c, volume.id, state, room);
    }
    c.pending.back() = std::move(pending);
    state.faces[u.field].swap(faces);
    ++state.uploads;
    const double all = double(state.size[0]) * state.size[1] * state.size[2];
    tellReplaced(c, sums, u.field);
    takeSums(state, sums, double(u.extent[0]) * u.extent[1] * u.extent[2] / all, field);
    return WLK_SUCCESS;
  });
}

WlkResult wlkUploadVolumeBricks(WlkContext context, WlkVolume volume,
                                const WlkVolumeBricks* bricks) {
  return guarded([&] {
    WlkContext_T& c = checkContext(context);
    VolumeState& state = c.volume(volume);
    const WlkVolumeBricks b = copyStruct(bricks, WLK_STRUCT_VOLUME_BRICKS);
    checkNoChain(bricks);
    checkBricks(state, b);
    FieldState& field = state.fields[b.field];
    vk::Device& device = c.requireDevice("wlkUploadVolumeBricks");
    BrickContents contents = readBricks(state.size, b, &c.memory);
    const Edges shape = atlasShape(std::max<uint64_t>(contents.reached.size(), 1),
                                   device.properties().limits.maxImageDimension3D / SLOT_EDGE);
    if (shape[0] == 0) {
      fail(WLK_ERROR_LIMIT_EXCEEDED, b.sType, "count",
           "%zu bricks with values above 0 exceed the device's 3D images", contents.reached.size());
    }
    const Edges texels{SLOT_EDGE * shape[0], SLOT_EDGE * shape[1], SLOT_EDGE * shape[2]};
    vk::Image image;
    if (field.atlas != shape) {
      image = makeFieldImage(device, VK_FORMAT_R16_SFLOAT, texels);
    }
    PendingUpload pending = makePending(device, volume.id, b.field, texels, sizeof(uint16_t));
    fillSlots(state.size, b, contents, shape, static_cast<uint16_t*>(pending.staging.data()));
    vk::Image pages;
    if (!state.pages) {
      pages = makeFieldImage(
          device, state.fieldCount == 1 ? VK_FORMAT_R32_SFLOAT : VK_FORMAT_R32G32B32A32_SFLOAT,
          brickGrid(state.size).count);
    }
    std::pmr::vector<float> pageTexels(state.pageTexels, &c.memory);
    writePages(state, b.field, contents.reached, shape, pageTexels);
    PendingUpload pendingPages = stagePages(device, volume.id, state, pageTexels);
    Retired& room = c.retired.emplace_back(&c.memory);
    renewLeaps(c, volume.id, state);
    c.pending.reserve(c.pending.size() + 2);
    // Nothing throws from here on.
    if (image) {
      replaceImage(c, volume.id, b.field, field, std::move(image), shape, room);
    }
    if (pages) {
      state.pages = std::move(pages);
    }
    forgetPending(c, volume.id, b.field);
    forgetPending(c, volume.id, PAGES);
    c.pending.push_back(std::move(pending));
    c.pending.push_back(std::move(pendingPages));
    if (state.fieldCount > 1) {
      state.pageTexels.swap(pageTexels);
    }
    field.slots = contents.reached.size();
    state.faces[b.field].swap(contents.faces);
    ++state.uploads;
    tellReplaced(c, contents.sums, b.field);
    takeSums(state, contents.sums, 1, field);
    return WLK_SUCCESS;
  });
}

WlkResult wlkGetVolumeState(WlkContext context, WlkVolume volume, WlkVolumeState* state) {
  return guarded([&] {
    const WlkContext_T& c = checkContext(context);
    const VolumeState& v = checkContext(context).volume(volume);
    WlkVolumeState value = startOutput(state, WLK_STRUCT_VOLUME_STATE);
    const BrickGrid grid = brickGrid(v.size);
    std::copy(grid.count.begin(), grid.count.end(), value.bricks);
    value.occupiedBricks = 0;
    for (size_t i = 0; i < grid.total(); ++i) {
      value.occupiedBricks +=
          std::any_of(v.faces.begin(), v.faces.end(),
                      [&](const BrickFaces& faces) { return !faces.empty() && faces[i] != 0; });
    }
    value.storedBricks = 0;
    value.leaps = (v.fieldKind() & VolumeState::LEAPING) != 0 ? 1 : 0;
    value.deviceMemory = imageBytes(v.pages) + imageBytes(v.leaps) + imageBytes(v.diameters);
    value.hostMemory =
        v.pageTexels.capacity() * sizeof(float) + v.leapTexels.capacity() * sizeof(BrickLeap);
    for (uint32_t i = 0; i < v.fieldCount; ++i) {
      value.storedBricks += v.fields[i].slots;
      value.deviceMemory += imageBytes(v.fields[i].image);
      value.hostMemory += v.faces[i].capacity() * sizeof(uint64_t);
    }
    value.pendingMemory = 0;
    for (const PendingUpload& pending : c.pending) {
      value.pendingMemory += pending.volumeId == volume.id ? pending.staging.size() : 0;
    }
    finishOutput(value, state);
    return WLK_SUCCESS;
  });
}
