// SPDX-License-Identifier: MIT
// src/particles/refractive_index against published tables.
#include "particles/refractive_index.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace {

using namespace welkin;

struct Row {
  double wavelength_um, index;
};

constexpr double HALF_DIGIT_5 = 0.5e-5;

// Harvey et al. 1998 over the index of air at 15 C.
TEST(WaterIndex, RelativeToAirAtTenDegreesIsTheTableInEveryPrintedDigit) {
  for (const Row& row :
       {Row{0.40, 1.34393}, Row{0.44, 1.34065}, Row{0.50, 1.33715}, Row{0.55, 1.33503},
        Row{0.589, 1.33370}, Row{0.65, 1.33201}, Row{0.68, 1.33129}, Row{0.70, 1.33085}}) {
    EXPECT_NEAR(waterIndex(row.wavelength_um, 10), row.index, HALF_DIGIT_5) << row.wavelength_um;
  }
}

// CRC Handbook of Chemistry and Physics, "Index of Refraction of Water", relative to vacuum: an
// evaluation of the same measurements.
TEST(WaterIndex, RelativeToVacuumIsTheHandbooksTable) {
  for (const Row& row : {Row{0.2265, 1.39336}, Row{0.36105, 1.34795}, Row{0.40441, 1.34315},
                         Row{0.589, 1.33336}, Row{0.6328, 1.33211}, Row{1.01398, 1.32524}}) {
    // Half a digit, and the source's own uncertainty of 1.5e-5 outside of the visible.
    const bool visible = row.wavelength_um > 0.4 && row.wavelength_um < 0.7;
    EXPECT_NEAR(waterIndexInVacuum(row.wavelength_um, 20), row.index,
                HALF_DIGIT_5 + (visible ? 0 : 1.5e-5))
        << row.wavelength_um;
  }
  for (const Row& row : {Row{0.40441, 1.34205}, Row{0.589, 1.33230}, Row{0.6328, 1.33105}}) {
    EXPECT_NEAR(waterIndexInVacuum(row.wavelength_um, 30), row.index, HALF_DIGIT_5)
        << row.wavelength_um;
  }
}

// CIPM 2001 density of water, kg/m^3: its maximum is 999.9750 at 3.98 C; 998.207 at 20, 992.216 at
// 40 (Wagner and Pruss 2002).
TEST(WaterDensity, MatchesTheStandardAndIsClamped) {
  EXPECT_NEAR(waterDensity(3.983), 999.97495, 1e-5);
  EXPECT_NEAR(waterDensity(20), 998.207, 1e-3);
  EXPECT_NEAR(waterDensity(40), 992.216, 3e-3);
  EXPECT_EQ(waterDensity(-30), waterDensity(0));
  EXPECT_EQ(waterDensity(90), waterDensity(40));
}

// Descartes: cos i = sqrt((n^2 - 1) / 3); the primary bow lies at 180 + 2 i - 4 r.
TEST(WaterIndex, PutsTheBowsColoursInOrder) {
  const auto bow = [](double n) {
    const double incidence = std::acos(std::sqrt((n * n - 1) / 3));
    const double refraction = std::asin(std::sin(incidence) / n);
    return 180 + (2 * incidence - 4 * refraction) * 180 / std::numbers::pi;
  };
  // 0.145 degrees per 0.001 of n, and half of a printed digit.
  constexpr double TOLERANCE = 145 * HALF_DIGIT_5 + 0.5e-3;
  EXPECT_NEAR(bow(waterIndex(0.44, 10)), 139.022, TOLERANCE);
  EXPECT_NEAR(bow(waterIndex(0.55, 10)), 138.216, TOLERANCE);
  EXPECT_NEAR(bow(waterIndex(0.68, 10)), 137.673, TOLERANCE);
}

TEST(IceIndex, IsTheTableOfWarrenAndBrandt) {
  for (const Row& row : {Row{0.40, 1.3194}, Row{0.44, 1.3163}, Row{0.50, 1.3130}, Row{0.55, 1.3110},
                         Row{0.60, 1.3094}, Row{0.65, 1.3080}, Row{0.68, 1.3073}, Row{0.70, 1.3069},
                         Row{0.75, 1.3059}}) {
    // Only rounding: (wavelength - 0.38) / 0.01 may miss an integer by a few ulp.
    EXPECT_NEAR(iceIndex(row.wavelength_um), row.index, 1e-12) << row.wavelength_um;
  }
  EXPECT_EQ(iceIndex(0.1), iceIndex(0.38));
  EXPECT_EQ(iceIndex(2.0), iceIndex(0.76));
}

TEST(IceIndex, FallsWithTheWavelength) {
  for (double wavelength = 0.38; wavelength < 0.759; wavelength += 0.001) {
    EXPECT_GT(iceIndex(wavelength), iceIndex(wavelength + 0.001)) << wavelength;
  }
}

}  // namespace
