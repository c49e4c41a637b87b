// SPDX-License-Identifier: MIT
// Raw, LES and generated volumes.
#include "common/volume.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "common/slab.hpp"
#include "expect_input_error.hpp"
#include "temp_folder.hpp"

namespace {

using host::Vec3;
using host_test::expectInputError;

// 3 x 2 x 2 cells of 20 m x 25 m, levels 0.5 and 0.54 km; one-based rows follow.
const std::string LES_HEADER = "# test\n3 2 2\n0.020 0.025 0.500 0.540\n";

host::Grid les(const std::string& text, int indexBase = -1) {
  const host_test::TempFolder folder;
  host::LesInfo info;
  info.indexBase = indexBase;
  return host::loadLes(folder.write("les.txt", text), info);
}

host::Grid raw(const std::string& bytes, host::RawFormat format) {
  const host_test::TempFolder folder;
  host::RawInfo info;
  info.size = {2, 1, 1};
  info.format = format;
  return host::loadRaw(folder.write("a.raw", bytes), info);
}

void expectPoint(Vec3 actual, Vec3 expected) {
  // Kilometres printed in decimal, one product and one sum: a few ulp of 1000 m.
  const double tolerance = 8.0 * 1000.0 * 0x1p-52;
  EXPECT_NEAR(actual.x, expected.x, tolerance);
  EXPECT_NEAR(actual.y, expected.y, tolerance);
  EXPECT_NEAR(actual.z, expected.z, tolerance);
}

TEST(HostLes, TurnsLiquidWaterIntoExtinction) {
  const host::Grid grid = les(LES_HEADER + "1 1 1 0.5 10\n3 2 2 0.2 15.0\n");
  ASSERT_EQ(grid.values.size(), 12u);
  // 3/2 LWC / (rho r): 0.5 g/m^3 of 10 um is 0.075 per metre.
  EXPECT_FLOAT_EQ(grid.values[0], 0.075f);
  EXPECT_FLOAT_EQ(grid.values[11], 0.02f);
  EXPECT_EQ(std::count(grid.values.begin(), grid.values.end(), 0.0f), 10);
}

TEST(HostLes, HasTheMedianDiameterOfTheEffectiveRadius) {
  const host_test::TempFolder folder;
  host::LesInfo info;
  info.diameters = true;
  const host::Grid grid =
      host::loadLes(folder.write("les.txt", LES_HEADER + "1 1 1 0.5 10\n3 2 2 0.2 15.0\n"), info);
  // Log-normal: effective radius = median radius * exp(2.5 spread^2).
  const double factor = 2 / std::exp(2.5 * 0.25 * 0.25);
  EXPECT_FLOAT_EQ(grid.values[0], static_cast<float>(10 * factor));
  EXPECT_FLOAT_EQ(grid.values[11], static_cast<float>(15 * factor));
}

TEST(HostLes, PutsLevelsAtCellCentresWithTheDataSZUp) {
  const host::Grid grid = les(LES_HEADER + "1 1 1 0.5 10\n");
  // Centre of cell (0, 0, 1): half a cell east, half a cell north (-z), on level 0.54 km.
  const Vec3 unit{0.5 / 3.0, 0.5 / 2.0, 1.5 / 2.0};
  expectPoint(host::transformPoint(grid.worldFromVolume, unit), {10.0, 540.0, -12.5});
}

TEST(HostLes, FindsTheIndexBase) {
  EXPECT_GT(les(LES_HEADER + "0 1 1 1 10\n").values[0 + 3 * (1 + 2 * 1)], 0.0f);
  EXPECT_GT(les(LES_HEADER + "3 1 1 1 10\n").values[2], 0.0f);
  // Either fits: zero-based, unless the scene says otherwise.
  EXPECT_GT(les(LES_HEADER + "1 1 1 1 10\n").values[1 + 3 * (1 + 2 * 1)], 0.0f);
  EXPECT_GT(les(LES_HEADER + "1 1 1 1 10\n", 1).values[0], 0.0f);
  expectInputError("expected indices", [] { les(LES_HEADER + "0 1 1 1 10\n3 0 0 1 10\n"); });
}

TEST(HostLes, RefusesBrokenTextNamingTheLine) {
  expectInputError("line 1", [] { les(""); });
  expectInputError("line 2", [] { les("# c\n3 2\n"); });
  expectInputError("size: expected", [] { les("# c\n0 2 2\n0.02 0.02 0 1\n"); });
  expectInputError("size: expected", [] { les("# c\n900000 900000 900000\n"); });
  expectInputError("line 3", [] { les("# c\n3 2 2\n0.02 0.02 0.5\n"); });
  expectInputError("line 3: expected evenly", [] { les("# c\n1 1 3\n.02 .02 0 .04 .10\n"); });
  expectInputError("line 3: expected evenly", [] { les("# c\n1 1 2\n.02 .02 .04 0\n"); });
  expectInputError("line 4: expected 'ix", [] { les(LES_HEADER + "1 1 1 0.5\n"); });
  expectInputError("line 4: expected finite", [] { les(LES_HEADER + "1 1 1 nan 10\n"); });
  expectInputError("line 4: expected finite", [] { les(LES_HEADER + "1 1 1 inf 10\n"); });
  expectInputError("line 5: expected indices", [] { les(LES_HEADER + "1 1 1 1 9\n4 1 1 1 9\n"); });
  expectInputError("line 4: expected indices", [] { les(LES_HEADER + "1.5 1 1 1 9\n"); });
  expectInputError("line 4: expected lwc", [] { les(LES_HEADER + "1 1 1 1 0\n"); });
  expectInputError("line 4: expected lwc", [] { les(LES_HEADER + "1 1 1 -1 9\n"); });
}

TEST(HostRaw, DecodesEveryFormat) {
  const std::array<float, 2> floats = {0.25f, 7.5f};
  std::string bytes(sizeof floats, '\0');
  std::memcpy(bytes.data(), floats.data(), sizeof floats);
  EXPECT_EQ(raw(bytes, host::RawFormat::R32Float).values, (std::vector<float>{0.25f, 7.5f}));
  // Halves: 0x3c00 is 1, 0x0001 the smallest, 2^-24.
  EXPECT_EQ(raw(std::string("\x00\x3c\x01\x00", 4), host::RawFormat::R16Float).values,
            (std::vector<float>{1.0f, 0x1p-24f}));
  EXPECT_EQ(raw("\xff\x33", host::RawFormat::R8Unorm).values, (std::vector<float>{1.0f, 0.2f}));
}

TEST(HostRaw, RefusesWrongLengthAndNaN) {
  expectInputError("expected 8 bytes", [] { raw("1234567", host::RawFormat::R32Float); });
  expectInputError("expected 2 bytes", [] { raw("123", host::RawFormat::R8Unorm); });
  // 0x7e00 is a NaN, 0x7c00 infinity.
  expectInputError("voxel 1: expected a finite",
                   [] { raw(std::string("\x00\x3c\x00\x7e", 4), host::RawFormat::R16Float); });
  expectInputError("voxel 0: expected a finite",
                   [] { raw(std::string("\x00\x7c\x00\x3c", 4), host::RawFormat::R16Float); });
  expectInputError("no such file", [] { host::loadRaw("/nowhere/a.raw", {{1, 1, 1}}); });
}

TEST(HostVolume, CountsVoxelsWithoutOverflow) {
  EXPECT_EQ(host::checkedVoxelCount("f", {512, 512, 512}), host::MAX_VOXELS);
  expectInputError("f: size", [] { host::checkedVoxelCount("f", {512, 512, 513}); });
  expectInputError("f: size", [] { host::checkedVoxelCount("f", {0, 1, 1}); });
  expectInputError("f: size", [] {
    host::checkedVoxelCount("f", {uint64_t{1} << 32, uint64_t{1} << 32, 2});
  });
}

TEST(HostSlab, IsFullWithinItsEdgesAndEmptyOnSoftFaces) {
  host::SlabInfo info;
  info.size = {8, 4, 2};
  info.extent = {80.0, 40.0, 20.0};
  const host::Grid block = host::makeSlab(info);
  EXPECT_EQ(block.values, std::vector<float>(64, 1.0f));
  info.edge = {20.0, 0.0, 0.0};
  const host::Grid soft = host::makeSlab(info);
  // Voxel centres at 5, 15, 25 m: smoothstep of 1/4 and 3/4 is 5/32 and 27/32.
  const std::vector<float> row = {0.15625f, 0.84375f, 1, 1, 1, 1, 0.84375f, 0.15625f};
  for (size_t i = 0; i < soft.values.size(); ++i) {
    EXPECT_EQ(soft.values[i], row[i % 8]) << i;
  }
  expectPoint(host::transformPoint(soft.worldFromVolume, {1.0, 1.0, 1.0}), {80.0, 40.0, 20.0});
}

TEST(HostSlab, LosesDensityToNoiseAndRepeatsItself) {
  host::SlabInfo info;
  info.noise = 0.8;
  info.noiseSize = 300.0;
  const host::Grid grid = host::makeSlab(info);
  const auto [low, high] = std::minmax_element(grid.values.begin(), grid.values.end());
  EXPECT_GE(*low, 0.2f - 1e-6f);
  EXPECT_LE(*high, 1.0f);
  EXPECT_GT(*high - *low, 0.3f);
  EXPECT_EQ(host::makeSlab(info).values, grid.values);
  info.seed = 2;
  EXPECT_NE(host::makeSlab(info).values, grid.values);
}

class Cumulus : public testing::TestWithParam<uint32_t> {};

TEST_P(Cumulus, FillsItsBoxWithDensitiesAndLeavesTheFacesEmpty) {
  host::CumulusInfo info;
  info.size = {48, 36, 40};
  info.seed = GetParam();
  const host::Grid grid = host::makeCumulus(info);
  size_t filled = 0;
  for (size_t i = 0; i < grid.values.size(); ++i) {
    const float value = grid.values[i];
    ASSERT_TRUE(value >= 0.0f && value <= 1.0f);
    filled += value > 0.1f ? 1 : 0;
    const size_t x = i % 48;
    const size_t y = i / 48 % 36;
    const size_t z = i / (48 * 36);
    if (x == 0 || x == 47 || y == 0 || y == 35 || z == 0 || z == 39) {
      ASSERT_EQ(value, 0.0f);
    }
  }
  // A cloud, neither a wisp nor a block.
  EXPECT_GT(static_cast<double>(filled), 0.04 * static_cast<double>(grid.values.size()));
  EXPECT_LT(static_cast<double>(filled), 0.5 * static_cast<double>(grid.values.size()));
}

TEST_P(Cumulus, HasAFlatBaseAndAnUnevenTop) {
  host::CumulusInfo info;
  info.size = {48, 36, 48};
  info.seed = GetParam();
  const host::Grid grid = host::makeCumulus(info);
  std::vector<double> bases;
  std::vector<double> tops;
  for (size_t z = 16; z < 32; ++z) {
    for (size_t x = 16; x < 32; ++x) {
      int low = -1;
      int high = -1;
      for (int y = 0; y < 36; ++y) {
        if (grid.values[x + 48 * (static_cast<size_t>(y) + 36 * z)] > 0.1f) {
          low = low < 0 ? y : low;
          high = y;
        }
      }
      if (low >= 0) {
        bases.push_back(low);
        tops.push_back(high);
      }
    }
  }
  const auto spread = [](std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() * 9 / 10] - values[values.size() / 10];
  };
  ASSERT_GT(bases.size(), 200u);
  // In voxels: the base wavers by less than two, the cauliflower by several.
  EXPECT_LE(spread(bases), 1.0);
  EXPECT_GE(spread(tops), 3.0);
}

INSTANTIATE_TEST_SUITE_P(Seeds, Cumulus, testing::Values(1u, 2u, 3u, 77u));

TEST(HostCumulus, RepeatsItselfAndFollowsItsSeed) {
  host::CumulusInfo info;
  info.size = {32, 24, 32};
  const host::Grid first = host::makeCumulus(info);
  EXPECT_EQ(host::makeCumulus(info).values, first.values);
  info.seed = 2;
  EXPECT_NE(host::makeCumulus(info).values, first.values);
}

}  // namespace
