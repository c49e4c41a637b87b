// SPDX-License-Identifier: MIT
#include "picture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace engine {

Tolerance operator*(const Tolerance& tolerance, double factor) {
  Tolerance result = tolerance;
  for (double& r : result.relative) {
    r *= factor;
  }
  result.absolute *= factor;
  return result;
}

Tolerance operator+(const Tolerance& a, const Tolerance& b) {
  Tolerance result = a;
  for (size_t i = 0; i < 3; ++i) {
    result.relative[i] += b.relative[i];
  }
  result.absolute += b.absolute;
  return result;
}

Tolerance roundingOf(VkFormat format) {
  switch (format) {
    case VK_FORMAT_R16G16B16A16_SFLOAT:  // 10 stored bits, least exponent -14
      return {{0x1p-11, 0x1p-11, 0x1p-11}, 0x1p-25};
    case VK_FORMAT_B10G11R11_UFLOAT_PACK32:  // 6, 6 and 5 stored bits
      return {{0x1p-7, 0x1p-7, 0x1p-6}, 0x1p-20};
    default:
      return {{0, 0, 0}, 0};
  }
}

void expectClose(std::span<const float> actual, std::span<const float> expected,
                 const Tolerance& tolerance, const char* what) {
  ASSERT_EQ(actual.size(), expected.size()) << what;
  double worst = 0;
  size_t at = 0;
  for (size_t i = 0; i < actual.size(); ++i) {
    if (i % 4 == 3) {
      continue;
    }
    const double e = static_cast<double>(expected[i]);
    const double error = std::abs(static_cast<double>(actual[i]) - e);
    const double allowed = tolerance.relative[i % 4] * std::abs(e) + tolerance.absolute;
    // The comparison is false for NaN: not a number is as wrong as it gets.
    const double ratio = error <= 1e30 ? error / allowed : 1e30;
    if (ratio > worst) {
      worst = ratio;
      at = i;
    }
  }
  EXPECT_LE(worst, 1.0) << what << ": pixel " << at / 4 << ", colour " << at % 4 << " is "
                        << actual[at] << ", expected " << expected[at];
}

void expectSameAlpha(std::span<const float> actual, std::span<const float> expected) {
  ASSERT_EQ(actual.size(), expected.size());
  for (size_t i = 3; i < actual.size(); i += 4) {
    ASSERT_EQ(actual[i], expected[i]) << "alpha of pixel " << i / 4;
  }
}

void expectStructure(std::span<const float> picture) {
  const auto [low, high] = std::minmax_element(picture.begin(), picture.end());
  EXPECT_GT(*high, *low + 0.1f);
}

}  // namespace engine
