// SPDX-License-Identifier: MIT
// Fronts of time and error and straight lines through costs against what is known.
#include "bench/volume_points.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace bench {
namespace {

constexpr double ROUNDING = 1e-12;  // some logarithms and sums of doubles, each 1e-16 off

VolumeRow point(const char* method, double time_ms, double error) {
  VolumeRow row{};
  row.method = method;
  row.time_ms = time_ms;
  row.error = error;
  return row;
}

double time(const std::vector<VolumeRow>& rows, const char* method, double error) {
  return timeAtError(rows, method, error, &VolumeRow::time_ms);
}

// time = 8 / error^(1/2) but for a point that others beat.
std::vector<VolumeRow> powerLaw() {
  return {point("welkin", 8, 1), point("welkin", 16, 0.25), point("welkin", 20, 0.5),
          point("welkin", 80, 0.01)};
}

TEST(VolumePoints, AreJoinedByPowers) {
  const std::vector<VolumeRow> rows = powerLaw();
  for (const double error : {1.0, 0.7, 0.5, 0.25, 0.1, 0.01}) {
    const double wanted = 8 / std::sqrt(error);
    EXPECT_NEAR(time(rows, "welkin", error), wanted, ROUNDING * wanted) << error;
  }
}

TEST(VolumePoints, HaveNoTimeForLessErrorAndTheCheapestForMore) {
  const std::vector<VolumeRow> rows = powerLaw();
  EXPECT_LT(time(rows, "welkin", 0.0099), 0);
  EXPECT_EQ(time(rows, "welkin", 1.01), 8);
  EXPECT_EQ(time(rows, "welkin", 300), 8);
  EXPECT_LT(time(rows, "slicer", 0.5), 0) << "of a method that is not there";
}

TEST(VolumePoints, AreComparedWhereBothMethodsReach) {
  std::vector<VolumeRow> rows = powerLaw();
  EXPECT_TRUE(commonErrors(rows).empty());
  rows.push_back(point("slicer", 5, 4));
  rows.push_back(point("slicer", 50, 0.04));
  const std::vector<double> errors = commonErrors(rows);
  ASSERT_EQ(errors.size(), 4u);
  EXPECT_EQ(errors[0], 1);
  EXPECT_EQ(errors[1], DIVIDING_ERROR);
  EXPECT_NEAR(errors[2], 0.2, ROUNDING);
  EXPECT_EQ(errors[3], 0.04);
  rows.push_back(point("welkin", 1, 0.39));  // beats all that are coarser
  EXPECT_LT(commonErrors(rows).front(), DIVIDING_ERROR);
  EXPECT_EQ(commonErrors(rows).size(), 3u);
  // A middle of 0.9.
  rows = {point("welkin", 1, 4), point("welkin", 9, 0.2), point("slicer", 1, 4),
          point("slicer", 9, 0.2)};
  ASSERT_EQ(commonErrors(rows).size(), 4u);
  EXPECT_EQ(commonErrors(rows)[2], DIVIDING_ERROR);
  rows = powerLaw();
  rows.push_back(point("slicer", 5, 0.004));
  rows.push_back(point("slicer", 2, 0.008));
  EXPECT_TRUE(commonErrors(rows).empty()) << "one's worst is better than the other's best";
}

TEST(VolumePoints, LieOnTheirLine) {
  const Fit exact = fitLine({1, 2, 4}, {5, 8, 14});
  EXPECT_NEAR(exact.offset, 2, ROUNDING);
  EXPECT_NEAR(exact.slope, 3, ROUNDING);
  EXPECT_NEAR(exact.explained, 1, ROUNDING);
  EXPECT_NEAR(fitLine({1, 2, 4}, {3, 12, 48}).exponent, 2, ROUNDING);
  // By hand: slope 1/2, mean 2, a quarter of the variance.
  const Fit rough = fitLine({1, 2, 3}, {1, 3, 2});
  EXPECT_NEAR(rough.offset, 1, ROUNDING);
  EXPECT_NEAR(rough.slope, 0.5, ROUNDING);
  EXPECT_NEAR(rough.explained, 0.25, ROUNDING);
}

}  // namespace
}  // namespace bench
