// SPDX-License-Identifier: MIT
// Noise of the detail of cloud surfaces: equal parts of space have equal ranges of values, it
// repeats without a seam, and coarser levels are means.
#include "tables/detail_noise.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

namespace welkin {
namespace {

const std::vector<uint8_t>& noise() {
  static const std::vector<uint8_t> made = detailNoise();
  return made;
}

uint8_t texel(uint32_t x, uint32_t y, uint32_t z) {
  constexpr uint32_t EDGE = DETAIL_TEXELS;
  return noise()[(size_t{z % EDGE} * EDGE + y % EDGE) * EDGE + x % EDGE];
}

TEST(DetailNoise, IsTheSameEachTime) {
  EXPECT_EQ(noise().size(), detailLevelBegin(DETAIL_LEVELS));
  EXPECT_EQ(detailNoise(), noise());
}

TEST(DetailNoise, ValuesAreRanks) {
  std::array<size_t, 256> count{};
  const size_t all = detailLevelBegin(1);
  for (size_t i = 0; i < all; ++i) {
    ++count[noise()[i]];
  }
  size_t below = 0;
  for (size_t v = 0; v < 256; ++v) {
    below += count[v];
    // Rounding to 8 bits; bins of ranks hold up to a thousandth.
    EXPECT_NEAR(static_cast<double>(below) / static_cast<double>(all),
                (static_cast<double>(v) + 0.5) / 255, 0.5 / 255 + 1e-3);
  }
}

TEST(DetailNoise, RepeatsWithoutASeam) {
  // Largest and mean step between neighbours along an axis, in the middle and from the last texel
  // to the first.
  for (int axis = 0; axis < 3; ++axis) {
    const auto step = [&](uint32_t at) {
      double sum = 0;
      for (uint32_t i = 0; i < DETAIL_TEXELS; ++i) {
        for (uint32_t j = 0; j < DETAIL_TEXELS; ++j) {
          const std::array<uint32_t, 3> a = axis == 0   ? std::array{at, i, j}
                                            : axis == 1 ? std::array{i, at, j}
                                                        : std::array{i, j, at};
          std::array<uint32_t, 3> b = a;
          ++b[static_cast<size_t>(axis)];
          sum += std::abs(texel(a[0], a[1], a[2]) - texel(b[0], b[1], b[2]));
        }
      }
      return sum / (DETAIL_TEXELS * DETAIL_TEXELS);
    };
    const double seam = step(DETAIL_TEXELS - 1);
    double most = 0;
    for (const uint32_t at : {13U, 40U, 63U, 90U, 101U}) {
      most = std::max(most, step(at));
    }
    EXPECT_LT(seam, 1.3 * most) << axis;
    EXPECT_GT(seam, 0) << axis;
  }
}

TEST(DetailNoise, LevelsAreMeans) {
  uint32_t edge = DETAIL_TEXELS;
  for (uint32_t level = 1; level < DETAIL_LEVELS; ++level) {
    const uint8_t* fine = &noise()[detailLevelBegin(level - 1)];
    const uint8_t* coarse = &noise()[detailLevelBegin(level)];
    const uint32_t half = edge / 2;
    for (uint32_t i = 0; i < half * half * half; ++i) {
      const uint32_t x = i % half;
      const uint32_t y = i / half % half;
      const uint32_t z = i / half / half;
      double sum = 0;
      for (uint32_t c = 0; c < 8; ++c) {
        sum += fine[((2 * z + c / 4) * edge + 2 * y + c / 2 % 2) * edge + 2 * x + c % 2];
      }
      ASSERT_NEAR(coarse[i], sum / 8, 1.01) << level << ' ' << i;  // both are rounded
    }
    edge = half;
  }
}

TEST(DetailNoise, FacesHaveTheirFourCorners) {
  const std::vector<uint32_t> faces = detailFaces(noise());
  ASSERT_EQ(faces.size(), noise().size());
  for (uint32_t level = 0; level < DETAIL_LEVELS; ++level) {
    const uint32_t edge = DETAIL_TEXELS >> level;
    const size_t begin = detailLevelBegin(level);
    for (uint32_t i = 0; i < edge * edge * edge; ++i) {
      const uint32_t x = i % edge;
      const uint32_t row = i - x;
      const uint32_t right = row + (x + 1) % edge;
      const uint32_t y = row / edge % edge;
      const auto below = [&](uint32_t k) {
        return y + 1 < edge ? k + edge : k - (edge - 1) * edge;
      };
      uint32_t corner = 0;
      const uint32_t z = i / (edge * edge);
      const uint32_t face = faces[begin + (y * edge + x) * edge + z];
      for (const uint32_t k : {i, right, below(i), below(right)}) {
        ASSERT_EQ(face >> (8 * corner) & 255U, noise()[begin + k]) << level << ' ' << i;
        ++corner;
      }
    }
  }
}

TEST(DetailNoise, LevelsHaveRoomOfTheirOwn) {
  std::vector<bool> taken(size_t{DETAIL_IMAGE[0]} * DETAIL_IMAGE[1] * DETAIL_IMAGE[2]);
  for (uint32_t level = 0; level < DETAIL_LEVELS; ++level) {
    const auto begin = detailBegin(level);
    const uint32_t edge = DETAIL_TEXELS >> level;
    for (size_t k = 0; k < 3; ++k) {
      ASSERT_LE(begin[k] + edge, DETAIL_IMAGE[k]) << level;
    }
    for (uint32_t i = 0; i < edge * edge * edge; ++i) {
      const size_t row =
          size_t{begin[2] + i / edge / edge} * DETAIL_IMAGE[1] + begin[1] + i / edge % edge;
      const size_t at = row * DETAIL_IMAGE[0] + begin[0] + i % edge;
      ASSERT_FALSE(taken[at]) << level << ' ' << i;
      taken[at] = true;
    }
  }
}

TEST(DetailNoise, IsLinearBetweenTexels) {
  const double edge = DETAIL_TEXELS;
  EXPECT_NEAR(detailNoiseAt(noise(), {3.5 / edge, 5.5 / edge, 7.5 / edge}), texel(3, 5, 7) / 255.0,
              1e-12);
  EXPECT_NEAR(detailNoiseAt(noise(), {0, 5.5 / edge, 7.5 / edge - 4}),
              (texel(127, 5, 7) + texel(0, 5, 7)) / 510.0, 1e-12);
}

}  // namespace
}  // namespace welkin
