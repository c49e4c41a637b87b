// SPDX-License-Identifier: MIT
// Bricks of 8 x 8 x 8 voxels: which of them hold anything, and where an atlas keeps them. Pure
// data.
//
// Brick b is what a sample meets whose lower corner voxel lies in it: voxels 8 b to 8 b + 8 along
// each axis, the last of them the next brick's first. A slot of the atlas holds these 9^3, so that
// a sample needs one filtered fetch and no other brick.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <vector>

namespace welkin {

constexpr uint32_t BRICK_EDGE = 8;
constexpr uint32_t SLOT_EDGE = BRICK_EDGE + 1;
constexpr size_t BRICK_VOXELS = size_t{BRICK_EDGE} * BRICK_EDGE * BRICK_EDGE;
// Slots along an axis of an atlas: a page holds the three numbers in the 24 bits that a float has.
constexpr uint32_t MOST_SLOTS = 255;

using Edges = std::array<uint32_t, 3>;

struct BrickGrid {
  Edges count{};

  size_t total() const { return size_t{count[0]} * count[1] * count[2]; }
  size_t at(const Edges& brick) const {
    return (size_t{brick[2]} * count[1] + brick[1]) * count[0] + brick[0];
  }
  Edges brickOf(size_t index) const {
    return {static_cast<uint32_t>(index % count[0]),
            static_cast<uint32_t>(index / count[0] % count[1]),
            static_cast<uint32_t>(index / count[0] / count[1])};
  }
};

BrickGrid brickGrid(const Edges& size);

// Per brick 64 bits that tell where values above 0 lie among its own voxels. Along an axis there
// are four places: the first voxel, which the brick before reaches as well, those up to the middle,
// the middle one, which both halves reach, those behind. Bit x + 4 y + 16 z: of these places.
using BrickFaces = std::pmr::vector<uint64_t>;

// The bit of a voxel by its place in the volume.
uint64_t facesOf(const Edges& voxel);

// Index of the brick that lies one back along the axes of m; `brick` is not at that border.
size_t brickBefore(const BrickGrid& grid, size_t index, uint32_t axes);
bool hasBrickBefore(const Edges& brick, uint32_t axes);

// Bricks with a voxel above 0 of their own.
uint64_t countOccupied(std::span<const uint64_t> faces);

// Indices, rising, of the bricks in which a sample may be above 0: the occupied ones, and those
// before them that touch an occupied voxel. Takes time with the occupied bricks given.
std::pmr::vector<uint32_t> reachedBricks(const BrickGrid& grid, std::span<const uint64_t> faces,
                                         std::span<const uint32_t> occupied,
                                         std::pmr::memory_resource* memory);

// How far a ray in a brick may go: the distance, in bricks along the axis where it is longest and
// at most 255, to the nearest one in which a sample of any field may be above 0; and if that is the
// brick itself, a bit for each of its eighths (1: the second half along x, 2: y, 4: z) in which one
// may be. Texels of a volume's map.
struct BrickLeap {
  uint8_t distance;
  uint8_t eighths;
};

// Fields without faces hold nothing.
void findLeaps(const BrickGrid& grid, std::span<const BrickFaces> fields,
               std::span<BrickLeap> leaps);

// Slots along the axes of an atlas with room for `slots` of them and at most `most` along each:
// as little room as there is. All 0 if none fits.
Edges atlasShape(uint64_t slots, uint32_t most);

// What a page holds of a brick in a slot; 0 stands for a brick without one.
float pageOf(const Edges& shape, uint64_t slot);
Edges slotCorner(const Edges& shape, uint64_t slot);

}  // namespace welkin
