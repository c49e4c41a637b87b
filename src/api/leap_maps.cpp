// SPDX-License-Identifier: MIT
#include "api/leap_maps.hpp"

#include <algorithm>
#include <cstring>

namespace welkin {
namespace {

// Parts of a volume's bricks in which a sample may be above 0: under the first its rays leap, over
// the second no longer. A leap is one more fetch per stretch; far apart, so that contents that
// change do not have every wlkPrepare make other pipelines.
constexpr double LEAPS_BELOW = 0.4;
constexpr double LEAPS_NO_MORE = 0.8;

// 1 where Welkin cannot know.
double occupancy(const VolumeState& volume, const BrickGrid& grid) {
  std::pmr::vector<BrickLeap> leaps(volume.faces[0].get_allocator().resource());
  leaps.resize(grid.total());
  findLeaps(grid, volume.faces, leaps);
  const auto reached = std::count_if(leaps.begin(), leaps.end(),
                                     [](const BrickLeap& leap) { return leap.distance == 0; });
  return static_cast<double>(reached) / static_cast<double>(grid.total());
}

bool shouldLeap(const VolumeState& volume, const BrickGrid& grid) {
  for (uint32_t i = 0; i < volume.fieldCount; ++i) {
    if (volume.fields[i].external) {
      return static_cast<bool>(volume.leaps);
    }
  }
  if (!volume.anyDensity()) {
    return static_cast<bool>(volume.leaps);  // nothing there yet
  }
  return occupancy(volume, grid) < (volume.leaps ? LEAPS_NO_MORE : LEAPS_BELOW);
}

}  // namespace

PendingUpload makePending(vk::Device& device, uint64_t volume, uint32_t field, const Edges& texels,
                          uint64_t texelBytes) {
  PendingUpload pending;
  pending.volumeId = volume;
  pending.field = field;
  pending.staging = vk::Buffer(device, texelBytes * texels[0] * texels[1] * texels[2],
                               VK_BUFFER_USAGE_TRANSFER_SRC_BIT, true);
  pending.region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  pending.region.imageExtent = {texels[0], texels[1], texels[2]};
  return pending;
}

void renewLeaps(WlkContext_T& c, uint64_t volume, const VolumeState& state) {
  const bool waits = std::any_of(c.pending.begin(), c.pending.end(), [&](const auto& pending) {
    return pending.volumeId == volume && pending.field == LEAPS;
  });
  if (state.leaps && !waits) {
    c.pending.push_back(
        makePending(*c.device, volume, LEAPS, brickGrid(state.size).count, sizeof(BrickLeap)));
  }
}

void fillLeaps(VolumeState& volume, const vk::Buffer& staging) {
  findLeaps(brickGrid(volume.size), volume.faces, volume.leapTexels);
  std::memcpy(staging.data(), volume.leapTexels.data(),
              volume.leapTexels.size() * sizeof(BrickLeap));
}

void prepareLeaps(WlkContext_T& c) {
  for (uint32_t i = 0; i < c.volumes.slotCount(); ++i) {
    VolumeState* volume = c.volumes.at(i);
    if (volume == nullptr || volume->leapsAt == volume->uploads) {
      continue;
    }
    const BrickGrid grid = brickGrid(volume->size);
    const bool leap = shouldLeap(*volume, grid);
    const uint64_t id = c.volumes.idOf(i);
    if (leap && !volume->leaps) {
      vk::ImageInfo info;
      info.type = VK_IMAGE_TYPE_3D;
      info.format = VK_FORMAT_R8G8_UNORM;
      info.extent = {grid.count[0], grid.count[1], grid.count[2]};
      info.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
      vk::Image image(*c.device, info);
      volume->leapTexels.resize(grid.total());
      c.pending.push_back(makePending(*c.device, id, LEAPS, grid.count, sizeof(BrickLeap)));
      volume->leaps = std::move(image);
      c.invalidate();
    } else if (!leap && volume->leaps) {
      Retired& entry = c.retired.emplace_back(&c.memory);
      entry.frame = c.frameIndex;
      entry.images[0] = std::move(volume->leaps);
      std::erase_if(c.pending, [&](const PendingUpload& pending) {
        return pending.volumeId == id && pending.field == LEAPS;
      });
      c.forgetBindings();
      c.invalidate();
    }
    volume->leapsAt = volume->uploads;
  }
}

}  // namespace welkin
