// SPDX-License-Identifier: MIT
// The tables in the library against the program that made them: a sample of columns computed anew.
#include "particles/table_builder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numbers>

namespace {

using namespace welkin;

constexpr size_t LIMIT_BYTES = 16384;

const PhaseTable& shipped(TableKind kind) {
  switch (kind) {
    case TableKind::Haze:
      return HAZE_TABLE;
    case TableKind::Droplet:
      return DROPLET_TABLE;
    case TableKind::Rain:
      return RAIN_TABLE;
    case TableKind::IceColumn:
      return ICE_COLUMN_TABLE;
    case TableKind::IcePlate:
      return ICE_PLATE_TABLE;
    case TableKind::Snow:
      break;
  }
  return SNOW_TABLE;
}

size_t bytesOf(const PhaseTable& table) {
  return table.knot.size_bytes() + table.axis.size_bytes() + table.code.size_bytes() +
         table.asymmetry.size_bytes() + table.efficiency.size_bytes() + table.delta.size_bytes() +
         sizeof(table.logMin) + sizeof(table.logStep);
}

TEST(TableBuilder, ShippedTablesAreSmallAndLaidOutAsTheirDrafts) {
  for (const TableKind kind : TABLE_KINDS) {
    const PhaseTable& table = shipped(kind);
    const TableDraft draft = emptyDraft(kind);
    EXPECT_LE(bytesOf(table), LIMIT_BYTES) << table.name;
    EXPECT_EQ(table.name, draft.name);
    EXPECT_EQ(table.features, draft.features) << table.name;
    const size_t cells = draft.axis.size() * kTableChannels;
    ASSERT_EQ(table.knot.size(), draft.knot.size()) << table.name;
    ASSERT_EQ(table.axis.size(), draft.axis.size()) << table.name;
    ASSERT_EQ(table.code.size(), cells * draft.knot.size()) << table.name;
    for (const auto numbers : {table.asymmetry, table.efficiency, table.delta}) {
      ASSERT_EQ(numbers.size(), cells) << table.name;
    }
    for (size_t i = 0; i < draft.knot.size(); ++i) {
      EXPECT_EQ(table.knot[i], static_cast<float>(draft.knot[i])) << table.name << " " << i;
      EXPECT_TRUE(i == 0 || table.knot[i] > table.knot[i - 1]) << table.name << " " << i;
    }
    for (size_t i = 0; i < draft.axis.size(); ++i) {
      EXPECT_EQ(table.axis[i], static_cast<float>(draft.axis[i])) << table.name << " " << i;
    }
    EXPECT_EQ(table.knot.front(), 0) << table.name;
    EXPECT_NEAR(static_cast<double>(table.knot.back()), std::numbers::pi, 1e-6) << table.name;
    EXPECT_GT(table.logStep, 0) << table.name;
    const auto [low, high] = std::minmax_element(table.code.begin(), table.code.end());
    EXPECT_EQ(*low, 0) << table.name;  // the 16 bits are used up
    EXPECT_EQ(*high, 65535) << table.name;
    std::printf("%s: %zu bytes, step of ln P %.1e\n", table.name, bytesOf(table),
                static_cast<double>(table.logStep));
  }
}

TEST(TableBuilder, StoresWithinHalfACode) {
  TableDraft draft = emptyDraft(TableKind::Haze);
  for (size_t i = 0; i < draft.logPhase.size(); ++i) {
    draft.logPhase[i] = 12 * std::sin(0.37 * static_cast<double>(i));
  }
  const StoredTable stored = store(draft);
  EXPECT_EQ(stored.bytes(), bytesOf(stored.view()));
  for (size_t i = 0; i < draft.logPhase.size(); ++i) {
    const double value =
        static_cast<double>(stored.logMin) + static_cast<double>(stored.logStep) * stored.code[i];
    // Half a step of 24 / 65535, and the float of the least ln P and of the step, times 65535.
    EXPECT_NEAR(value, draft.logPhase[i], 12.0 / 65535 * 1.001 + 3 * 24 * 0x1p-24) << i;
  }
}

struct Column {
  TableKind kind;
  size_t column;
  size_t channel;
};

std::string nameOf(const testing::TestParamInfo<Column>& info) {
  const Column& one = info.param;
  return std::string(shipped(one.kind).name) + "_" + std::to_string(one.column) + "_" +
         std::to_string(one.channel);
}

// Bit for bit on the machine that made them. Columns of ice take 2 to 6 s each: two will do.
class ShippedColumn : public testing::TestWithParam<Column> {};

TEST_P(ShippedColumn, IsWhatTheBuilderComputes) {
  const auto& [kind, column, channel] = GetParam();
  const PhaseTable& table = shipped(kind);
  TableDraft draft = emptyDraft(kind);
  computeColumns(kind, draft, column, column + 1, channel, 1);
  const size_t cell = column * kTableChannels + channel;
  const size_t knots = draft.knot.size();
  size_t different = 0;
  for (size_t i = 0; i < knots; ++i) {
    const double code =
        std::round((draft.logPhase[cell * knots + i] - static_cast<double>(table.logMin)) /
                   static_cast<double>(table.logStep));
    const int found = table.code[cell * knots + i];
    different += static_cast<int>(code) == found ? 0 : 1;
    // The sum over sizes has another order when columns are computed alone; a value may then fall
    // on the other side of a half.
    EXPECT_LE(std::abs(code - found), 1) << "knot " << i;
  }
  std::printf("%s column %zu channel %zu: %zu of %zu codes differ\n", table.name, column, channel,
              different, knots);
  EXPECT_NEAR(static_cast<double>(table.asymmetry[cell]), draft.asymmetry[cell], 1e-6);
  EXPECT_NEAR(static_cast<double>(table.efficiency[cell]), draft.efficiency[cell], 1e-6);
  EXPECT_NEAR(static_cast<double>(table.delta[cell]), draft.delta[cell], 1e-6);
}

INSTANTIATE_TEST_SUITE_P(
    Tables, ShippedColumn,
    testing::Values(Column{TableKind::Haze, 0, 0}, Column{TableKind::Haze, 17, 1},
                    Column{TableKind::Droplet, 2, 2}, Column{TableKind::Rain, 0, 1},
                    Column{TableKind::IcePlate, 0, 1}, Column{TableKind::Snow, 2, 0}),
    nameOf);

}  // namespace
