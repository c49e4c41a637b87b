// SPDX-License-Identifier: MIT
// wlkGetColorMatrix: what the header says of it.
#include <gtest/gtest.h>
#include <welkin/welkin.h>

#include <array>

namespace {

std::array<double, 3> times(const std::array<double, 9>& columns, const std::array<double, 3>& v) {
  std::array<double, 3> result{};
  for (size_t row = 0; row < 3; ++row) {
    for (size_t column = 0; column < 3; ++column) {
      result[row] += columns[3 * column + row] * v[column];
    }
  }
  return result;
}

TEST(ColorMatrix, LeavesTheWavelengthsAndMakesSunlightLinearSrgb) {
  std::array<double, 9> matrix{};
  ASSERT_EQ(wlkGetColorMatrix(WLK_COLOR_WAVELENGTHS, matrix.data()), WLK_SUCCESS);
  EXPECT_EQ(matrix, (std::array<double, 9>{1, 0, 0, 0, 1, 0, 0, 0, 1}));
  ASSERT_EQ(wlkGetColorMatrix(WLK_COLOR_LINEAR_SRGB, matrix.data()), WLK_SUCCESS);
  // Irradiance 1, 1, 1 by welkin/view.h: luminance 1, colour (1.098, 0.977, 0.940).
  const std::array<double, 3> sun = times(matrix, {1, 1, 1});
  constexpr double DIGITS = 5e-4;
  EXPECT_NEAR(sun[0], 1.098, DIGITS);
  EXPECT_NEAR(sun[1], 0.977, DIGITS);
  EXPECT_NEAR(sun[2], 0.940, DIGITS);
  EXPECT_NEAR(0.2126 * sun[0] + 0.7152 * sun[1] + 0.0722 * sun[2], 1, 1e-3);
  // Column-major: light of 550 nm alone is the second column, yellow-green.
  const std::array<double, 3> green = times(matrix, {0, 1, 0});
  EXPECT_EQ(green, (std::array<double, 3>{matrix[3], matrix[4], matrix[5]}));
  EXPECT_GT(green[1], green[0]);
  EXPECT_GT(green[0], green[2]);
}

TEST(ColorMatrix, RefusesWhatIsNoColorSpace) {
  std::array<double, 9> matrix{};
  EXPECT_EQ(wlkGetColorMatrix(2, matrix.data()), WLK_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(matrix, (std::array<double, 9>{}));
  EXPECT_EQ(wlkGetColorMatrix(WLK_COLOR_LINEAR_SRGB, nullptr), WLK_ERROR_INVALID_ARGUMENT);
}

}  // namespace
