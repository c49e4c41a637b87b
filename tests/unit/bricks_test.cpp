// SPDX-License-Identifier: MIT
// Which bricks a sample may find anything in, and the shapes of atlases.
#include "frame/bricks.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace {

using namespace welkin;

// Trilinear interpolation looks at the voxel below a position and the one after it: those are in
// [8 b, 8 b + 8] for positions whose lower voxel is in brick b.
TEST(Bricks, ThatAreReachedAreThoseWithAVoxelUnderAFilter) {
  constexpr Edges SIZE{37, 8, 25};
  const BrickGrid grid = brickGrid(SIZE);
  ASSERT_EQ(grid.count, (Edges{5, 1, 4}));
  std::mt19937 random(5);
  for (int round = 0; round < 50; ++round) {
    std::set<Edges> voxels;
    for (int i = 0; i < 3; ++i) {
      voxels.insert({static_cast<uint32_t>(random() % SIZE[0]),
                     static_cast<uint32_t>(random() % SIZE[1]),
                     static_cast<uint32_t>(random() % SIZE[2])});
    }
    BrickFaces faces(grid.total());
    std::set<uint32_t> occupied;
    for (const Edges& v : voxels) {
      const size_t index = grid.at({v[0] / 8, v[1] / 8, v[2] / 8});
      faces[index] |= facesOf(v);
      occupied.insert(static_cast<uint32_t>(index));
    }
    EXPECT_EQ(countOccupied(faces), occupied.size());
    std::vector<uint32_t> expected;
    for (uint32_t index = 0; index < grid.total(); ++index) {
      const Edges b = grid.brickOf(index);
      const bool holds = std::any_of(voxels.begin(), voxels.end(), [&](const Edges& v) {
        return v[0] >= 8 * b[0] && v[0] <= 8 * b[0] + 8 && v[1] >= 8 * b[1] &&
               v[1] <= 8 * b[1] + 8 && v[2] >= 8 * b[2] && v[2] <= 8 * b[2] + 8;
      });
      if (holds) {
        expected.push_back(index);
      }
    }
    const std::vector<uint32_t> list(occupied.begin(), occupied.end());
    const auto reached = reachedBricks(grid, faces, list, std::pmr::get_default_resource());
    EXPECT_TRUE(std::equal(reached.begin(), reached.end(), expected.begin(), expected.end()))
        << "round " << round;
  }
}

TEST(Bricks, FillTheirAtlasAndPagesAreExact) {
  for (const uint64_t slots : {1u, 2u, 7u, 27u, 1000u, 26214u, 40000u, 500000u}) {
    const Edges shape = atlasShape(slots, 227);
    const uint64_t room = uint64_t{shape[0]} * shape[1] * shape[2];
    EXPECT_GE(room, slots);
    EXPECT_LE(static_cast<double>(room), 1.02 * static_cast<double>(slots)) << slots;
    for (const uint64_t slot : {uint64_t{0}, slots / 2, slots - 1}) {
      const auto page = static_cast<uint64_t>(pageOf(shape, slot)) - 1;
      EXPECT_EQ(slotCorner(shape, slot),
                (Edges{static_cast<uint32_t>(page & 255), static_cast<uint32_t>(page >> 8 & 255),
                       static_cast<uint32_t>(page >> 16)}));
    }
  }
  EXPECT_EQ(atlasShape(1001, 10), (Edges{0, 0, 0}));
  EXPECT_EQ(atlasShape(1000, 10), (Edges{10, 10, 10}));
}

// Whether a filter reads one of the voxels when its lower one is among the `edge` from `first` on.
bool reaches(const std::vector<Edges>& voxels, const Edges& first, uint32_t edge) {
  return std::any_of(voxels.begin(), voxels.end(), [&](const Edges& v) {
    for (size_t axis = 0; axis < 3; ++axis) {
      if (v[axis] < first[axis] || v[axis] > first[axis] + edge) {
        return false;
      }
    }
    return true;
  });
}

TEST(Bricks, KnowHowFarTheyAreFromTheNearestThatIsReachedAndWhichEighthsAre) {
  const BrickGrid grid = brickGrid({100, 37, 70});
  std::mt19937 random(7);
  for (int round = 0; round < 30; ++round) {
    std::vector<BrickFaces> fields(2, BrickFaces(grid.total()));
    std::vector<Edges> voxels;
    for (int i = 0; i < 3 * (round % 3); ++i) {
      voxels.push_back({static_cast<uint32_t>(random() % 100), static_cast<uint32_t>(random() % 37),
                        static_cast<uint32_t>(random() % 70)});
      // At multiples of 4 what lies before is reached as well.
      for (uint32_t& place : voxels.back()) {
        place -= static_cast<uint32_t>(random() % 2) * (place % 4);
      }
      const Edges& v = voxels.back();
      const size_t index = grid.at({v[0] / 8, v[1] / 8, v[2] / 8});
      fields[static_cast<size_t>(i % 2)][index] |= facesOf(v);
    }
    std::vector<Edges> reached;
    for (uint32_t i = 0; i < grid.total(); ++i) {
      const Edges b = grid.brickOf(i);
      if (reaches(voxels, {8 * b[0], 8 * b[1], 8 * b[2]}, 8)) {
        reached.push_back(b);
      }
    }
    std::vector<BrickLeap> leaps(grid.total());
    findLeaps(grid, fields, leaps);
    for (size_t i = 0; i < leaps.size(); ++i) {
      const Edges b = grid.brickOf(i);
      int expected = 255;
      for (const Edges& r : reached) {
        int apart = 0;
        for (size_t axis = 0; axis < 3; ++axis) {
          apart = std::max(apart, std::abs(static_cast<int>(b[axis]) - static_cast<int>(r[axis])));
        }
        expected = std::min(expected, apart);
      }
      ASSERT_EQ(leaps[i].distance, expected) << "round " << round << " brick " << i;
      for (uint32_t eighth = 0; eighth < 8; ++eighth) {
        const Edges first{8 * b[0] + 4 * (eighth & 1), 8 * b[1] + 4 * (eighth >> 1 & 1),
                          8 * b[2] + 4 * (eighth >> 2)};
        ASSERT_EQ((leaps[i].eighths >> eighth & 1) != 0, reaches(voxels, first, 4))
            << "round " << round << " brick " << i << " eighth " << eighth;
      }
    }
  }
}

}  // namespace
