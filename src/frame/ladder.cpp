// SPDX-License-Identifier: MIT
#include "frame/ladder.hpp"

#include <algorithm>
#include <array>

namespace welkin {
namespace {

struct Rung {
  uint32_t slices, batch, light, cells;
};

// Between two levels slabs and light texels grow together, each in equal ratios: one without the
// other is no point of the front. Batches of equal size, since the light's pass marches whole ones.
// Cells change at levels only: another grid is computed anew.
constexpr std::array<Rung, RUNGS> LADDER{{{32, 32, 96, 16},
                                          {40, 40, 114, 16},
                                          {50, 50, 136, 16},
                                          {64, 64, 160, 24},
                                          {76, 38, 180, 24},
                                          {90, 45, 202, 24},
                                          {108, 54, 228, 24},
                                          {128, 64, 256, 32},
                                          {153, 51, 294, 32},
                                          {180, 60, 338, 32},
                                          {216, 54, 388, 32},
                                          {256, 64, 448, 64}}};

}  // namespace

uint32_t rungOfLevel(uint32_t level) {
  constexpr std::array<uint32_t, 4> RUNG_OF_LEVEL{0, 3, 7, 11};
  return RUNG_OF_LEVEL[level];
}

double usualRatio(uint32_t rung) {
  return rung <= 3 ? 1.25 : rung <= 7 ? 1.33 : 1.5;
}

RungRange rungRange(const WlkQuality& quality) {
  return {rungOfLevel(quality.lowestLevel), rungOfLevel(quality.level)};
}

SliceQuality rungQuality(const WlkQuality& quality, uint32_t rung) {
  WlkQuality q = quality;
  const Rung& r = LADDER[rung];
  q.sliceCount = r.slices;
  q.batchSize = r.batch;
  q.lightBufferSize = r.light;
  if (q.volumeCells == 0) {
    q.volumeCells = r.cells;
  }
  SliceQuality result = resolveQuality(q);
  const Rung& largest = LADDER[rungRange(quality).highest];
  result.lightRoom = largest.light;
  result.sliceRoom = largest.slices;
  result.stored = !result.halfAngle && fitsLightStore(largest.slices, largest.light);
  result.cellRoom = quality.volumeCells == 0 ? largest.cells : result.transportCells;
  result.ambientRoom = result.ambientCells > 0 ? ambientCellsOf(result.cellRoom) : 0;
  return result;
}

SliceQuality roomFor(const WlkQuality& quality) {
  if (!governed(quality)) {
    return resolveQuality(quality);
  }
  const RungRange range = rungRange(quality);
  SliceQuality room = rungQuality(quality, range.highest);
  uint32_t batches = 1;
  for (uint32_t i = range.lowest; i <= range.highest; ++i) {
    const Rung& r = LADDER[i];
    batches = std::max(batches, (r.slices + r.batch - 1) / r.batch);
    room.batchSize = std::max(room.batchSize, r.batch);
  }
  room.sliceCount = batches * room.batchSize;
  room.transportCells = room.cellRoom;
  room.ambientCells = room.ambientRoom;
  return room;
}

}  // namespace welkin
