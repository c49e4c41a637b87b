// SPDX-License-Identifier: MIT
// Checks of bricks, and their way into the slots of an atlas.
#pragma once

#include "api/volume_data.hpp"

namespace welkin {

void checkBricks(const VolumeState& volume, const WlkVolumeBricks& bricks);

// What an upload of bricks holds, before any of it is copied.
struct BrickContents {
  explicit BrickContents(std::pmr::memory_resource* memory)
      : faces(memory), source(memory), reached(memory) {}
  VoxelSums sums;
  BrickFaces faces;
  std::pmr::vector<uint32_t> source;   // by brick: 1 + its place in the upload, or 0
  std::pmr::vector<uint32_t> reached;  // those with a slot, rising
};
// Fails where a brick lies outside or comes twice.
BrickContents readBricks(const Edges& size, const WlkVolumeBricks& bricks,
                         std::pmr::memory_resource* memory);

// Writes the atlas: half floats, the slots of `reached` in turn.
void fillSlots(const Edges& size, const WlkVolumeBricks& bricks, const BrickContents& contents,
               const Edges& shape, uint16_t* atlas);

}  // namespace welkin
