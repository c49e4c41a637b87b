// SPDX-License-Identifier: MIT
// The ladder between the quality levels.
#include "frame/ladder.hpp"

#include <gtest/gtest.h>

namespace {

using namespace welkin;

WlkQuality controlled(uint32_t lowest, uint32_t level) {
  WlkQuality quality{};
  quality.level = level;
  quality.lowestLevel = lowest;
  quality.control = WLK_CONTROL_TIME;
  quality.timeBudget_ms = 1;
  return quality;
}

TEST(Ladder, HasEveryLevel) {
  for (uint32_t level = WLK_QUALITY_LOW; level <= WLK_QUALITY_ULTRA; ++level) {
    WlkQuality plain{};
    plain.level = level;
    const SliceQuality is = rungQuality(controlled(WLK_QUALITY_LOW, level), rungOfLevel(level));
    const SliceQuality expected = resolveQuality(plain);
    EXPECT_EQ(is.sliceCount, expected.sliceCount);
    EXPECT_EQ(is.batchSize, expected.batchSize);
    EXPECT_EQ(is.lightSize, expected.lightSize);
    EXPECT_EQ(is.transportCells, expected.transportCells);
    EXPECT_EQ(is.lightRoom, expected.lightRoom);
    EXPECT_EQ(is.cellRoom, expected.cellRoom);
  }
}

TEST(Ladder, GrowsInSmallStepsOfWholeBatches) {
  const WlkQuality quality = controlled(WLK_QUALITY_LOW, WLK_QUALITY_ULTRA);
  for (uint32_t rung = 0; rung < RUNGS; ++rung) {
    const SliceQuality q = rungQuality(quality, rung);
    EXPECT_EQ(q.sliceCount % q.batchSize, 0u) << "the light's pass marches whole batches";
    EXPECT_LE(q.batchSize, 64u);
    if (rung > 0) {
      const SliceQuality below = rungQuality(quality, rung - 1);
      EXPECT_GT(q.sliceCount, below.sliceCount);
      EXPECT_LE(q.sliceCount, 1.3 * below.sliceCount);
      EXPECT_GT(q.lightSize, below.lightSize);
      EXPECT_LE(q.lightSize, 1.2 * below.lightSize);
      EXPECT_GE(q.transportCells, below.transportCells);
      EXPECT_GT(usualRatio(rung), 1.0);
    }
  }
}

TEST(Ladder, BuffersHaveRoomForEveryRungAndNoMoreThanTheLevel) {
  for (uint32_t level = WLK_QUALITY_LOW; level <= WLK_QUALITY_ULTRA; ++level) {
    const WlkQuality quality = controlled(WLK_QUALITY_LOW, level);
    const SliceQuality room = roomFor(quality);
    WlkQuality plain{};
    plain.level = level;
    const SliceQuality expected = resolveQuality(plain);
    EXPECT_EQ(room.lightSize, expected.lightSize);
    EXPECT_EQ(room.batchSize, expected.batchSize);
    EXPECT_EQ(room.transportCells, expected.transportCells);
    const RungRange range = rungRange(quality);
    for (uint32_t rung = range.lowest; rung <= range.highest; ++rung) {
      const SliceQuality q = rungQuality(quality, rung);
      EXPECT_LE(q.lightSize, room.lightSize);
      EXPECT_LE(q.batchSize, room.batchSize);
      EXPECT_LE(q.transportCells, room.transportCells);
      EXPECT_EQ(q.lightRoom, room.lightSize);
      EXPECT_EQ(q.cellRoom, room.transportCells);
      EXPECT_LE(q.sliceCount / q.batchSize, room.sliceCount / room.batchSize);
      EXPECT_EQ(q.form(), room.form());
    }
  }
}

TEST(Ladder, CellsThatWereAskedForStay) {
  WlkQuality quality = controlled(WLK_QUALITY_LOW, WLK_QUALITY_ULTRA);
  quality.volumeCells = 40;
  for (uint32_t rung = 0; rung < RUNGS; ++rung) {
    EXPECT_EQ(rungQuality(quality, rung).transportCells, 40u);
    EXPECT_EQ(rungQuality(quality, rung).cellRoom, 40u);
  }
  EXPECT_EQ(roomFor(quality).transportCells, 40u);
}

}  // namespace
