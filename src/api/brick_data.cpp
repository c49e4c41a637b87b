// SPDX-License-Identifier: MIT
#include "api/brick_data.hpp"

#include <algorithm>

namespace welkin {
namespace {

const unsigned char* brickData(const WlkVolumeBricks& b, uint64_t brick) {
  const uint64_t tight = BRICK_VOXELS * bytesPerVoxel(b.format);
  return static_cast<const unsigned char*>(b.data) +
         brick * (b.brickPitch == 0 ? tight : b.brickPitch);
}

// Values as they will be kept: what rounds to 0 takes no brick.
float keptVoxel(const unsigned char* p, uint32_t format) {
  const float value = readVoxel(p, format);
  return halfFromFloat(value) == 0 ? 0.0f : value;
}

// Adds the voxels of a brick that lie inside the volume; returns its faces.
uint64_t readBrick(const Edges& size, const Edges& brick, const unsigned char* data,
                   uint32_t format, VoxelSums& sums) {
  const uint64_t voxel = bytesPerVoxel(format);
  Edges end{};
  for (size_t i = 0; i < 3; ++i) {
    end[i] = std::min(BRICK_EDGE, size[i] - BRICK_EDGE * brick[i]);
  }
  uint64_t faces = 0;
  for (uint32_t z = 0; z < end[2]; ++z) {
    for (uint32_t y = 0; y < end[1]; ++y) {
      const unsigned char* row = data + size_t{z * BRICK_EDGE + y} * BRICK_EDGE * voxel;
      for (uint32_t x = 0; x < end[0]; ++x) {
        const float value = keptVoxel(row + x * voxel, format);
        const float raw = rawVoxel(row + x * voxel, format);
        sums.replaced += readVoxel(row + x * voxel, format) != raw ? 1U : 0U;
        if (value > 0.0f) {
          addVoxel(
              sums, value,
              {BRICK_EDGE * brick[0] + x, BRICK_EDGE * brick[1] + y, BRICK_EDGE * brick[2] + z});
          faces |= facesOf({x, y, z});
        }
      }
    }
  }
  return faces;
}

}  // namespace

void checkBricks(const VolumeState& volume, const WlkVolumeBricks& b) {
  checkRange(b.sType, "field", b.field, 0, volume.fieldCount - 1);
  checkFormat(b.sType, b.format);
  const BrickGrid grid = brickGrid(volume.size);
  if (b.count > grid.total()) {
    fail(WLK_ERROR_INVALID_ARGUMENT, b.sType, "count",
         "WlkVolumeBricks::count is %u, the volume has %u x %u x %u bricks", b.count, grid.count[0],
         grid.count[1], grid.count[2]);
  }
  const uint64_t tight = BRICK_VOXELS * bytesPerVoxel(b.format);
  if (b.brickPitch != 0 && b.brickPitch < tight) {
    fail(WLK_ERROR_INVALID_ARGUMENT, b.sType, "brickPitch",
         "WlkVolumeBricks::brickPitch is %llu, a brick has %llu bytes",
         static_cast<unsigned long long>(b.brickPitch), static_cast<unsigned long long>(tight));
  }
  if (b.count == 0) {
    return;
  }
  checkPointer(b.coordinates, "coordinates");
  checkPointer(b.data, "data");
  const uint64_t pitch = b.brickPitch == 0 ? tight : b.brickPitch;
  uint64_t needed = 0;
  if (__builtin_mul_overflow(pitch, uint64_t{b.count} - 1, &needed) ||
      __builtin_add_overflow(needed, tight, &needed)) {
    fail(WLK_ERROR_INVALID_ARGUMENT, b.sType, "brickPitch",
         "WlkVolumeBricks::brickPitch overflows");
  }
  if (b.dataSize < needed) {
    fail(WLK_ERROR_INVALID_ARGUMENT, b.sType, "dataSize",
         "WlkVolumeBricks::dataSize is %llu, the bricks need %llu",
         static_cast<unsigned long long>(b.dataSize), static_cast<unsigned long long>(needed));
  }
}

BrickContents readBricks(const Edges& size, const WlkVolumeBricks& b,
                         std::pmr::memory_resource* memory) {
  const BrickGrid grid = brickGrid(size);
  BrickContents contents(memory);
  contents.faces.resize(grid.total());
  contents.source.resize(grid.total());
  std::pmr::vector<uint32_t> occupied(memory);
  for (uint32_t i = 0; i < b.count; ++i) {
    Edges brick;
    std::memcpy(brick.data(), b.coordinates + size_t{3} * i, sizeof brick);
    for (size_t axis = 0; axis < 3; ++axis) {
      if (brick[axis] >= grid.count[axis]) {
        fail(WLK_ERROR_INVALID_ARGUMENT, b.sType, "coordinates",
             "brick %u is (%u, %u, %u), the volume has %u x %u x %u bricks", i, brick[0], brick[1],
             brick[2], grid.count[0], grid.count[1], grid.count[2]);
      }
    }
    const size_t index = grid.at(brick);
    if (contents.source[index] != 0) {
      fail(WLK_ERROR_INVALID_ARGUMENT, b.sType, "coordinates",
           "bricks %u and %u are both (%u, %u, %u)", contents.source[index] - 1, i, brick[0],
           brick[1], brick[2]);
    }
    contents.source[index] = i + 1;
    contents.faces[index] = readBrick(size, brick, brickData(b, i), b.format, contents.sums);
    if (contents.faces[index] != 0) {
      occupied.push_back(static_cast<uint32_t>(index));
    }
  }
  contents.reached = reachedBricks(grid, contents.faces, occupied, memory);
  return contents;
}

void fillSlots(const Edges& size, const WlkVolumeBricks& b, const BrickContents& contents,
               const Edges& shape, uint16_t* atlas) {
  const BrickGrid grid = brickGrid(size);
  const uint64_t voxel = bytesPerVoxel(b.format);
  const uint64_t width = uint64_t{SLOT_EDGE} * shape[0];
  const uint64_t plane = width * SLOT_EDGE * shape[1];
  std::fill_n(atlas, plane * SLOT_EDGE * shape[2], uint16_t{0});
  for (size_t slot = 0; slot < contents.reached.size(); ++slot) {
    const size_t index = contents.reached[slot];
    const Edges brick = grid.brickOf(index);
    const Edges corner = slotCorner(shape, slot);
    // Voxels of the slot past the volume's last repeat it: filtering never gives them weight.
    std::array<Edges, SLOT_EDGE> at{};
    for (size_t axis = 0; axis < 3; ++axis) {
      for (uint32_t i = 0; i < SLOT_EDGE; ++i) {
        at[i][axis] = std::min(BRICK_EDGE * brick[axis] + i, size[axis] - 1);
      }
    }
    for (uint32_t z = 0; z < SLOT_EDGE; ++z) {
      for (uint32_t y = 0; y < SLOT_EDGE; ++y) {
        uint16_t* out = atlas + (SLOT_EDGE * corner[2] + z) * plane +
                        (SLOT_EDGE * corner[1] + y) * width + uint64_t{SLOT_EDGE} * corner[0];
        for (uint32_t x = 0; x < SLOT_EDGE; ++x) {
          const Edges v{at[x][0], at[y][1], at[z][2]};
          const uint32_t from =
              contents.source[grid.at({v[0] / BRICK_EDGE, v[1] / BRICK_EDGE, v[2] / BRICK_EDGE})];
          if (from != 0) {
            const size_t place =
                (size_t{v[2] % BRICK_EDGE} * BRICK_EDGE + v[1] % BRICK_EDGE) * BRICK_EDGE +
                v[0] % BRICK_EDGE;
            out[x] = halfFromFloat(readVoxel(brickData(b, from - 1) + place * voxel, b.format));
          }
        }
      }
    }
  }
}

}  // namespace welkin
