// SPDX-License-Identifier: MIT
// FLIP (0 to 1, no unit) against a second implementation, closed forms, and its invariances.
#include "common/flip.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "flip_direct.hpp"

namespace {

using host_test::uniformFlip;

// FLIP fixes its own fractions for XYZ, whose white is 3e-5 from that of the chromaticities. Lab
// errors near black pass through the 0.7th power: 9e-5 of the result was measured.
constexpr double WHITE_POINT = 1e-4;
// Floats through 21 + 21 taps: up to 1e-6 of a feature, whose root is part of the exponent; x^y
// changes by |x ln x| <= 1 / e times that.
const double FEATURE_ROUNDING = std::sqrt(1e-6) / std::exp(1.0);

host::Image filled(uint32_t width, uint32_t height, const std::array<float, 3>& rgb) {
  host::Image image{width, height, {}};
  for (size_t i = 0; i < image.pixelCount(); ++i) {
    image.rgba.insert(image.rgba.end(), {rgb[0], rgb[1], rgb[2], 1.0f});
  }
  return image;
}

// Smooth waves and noise, in [0, 1].
host::Image busy(uint32_t width, uint32_t height, uint32_t seed) {
  host::Image image = filled(width, height, {});
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uniform(0.0f, 0.3f);
  for (size_t i = 0; i < image.pixelCount(); ++i) {
    const size_t row = i / width;
    const auto x = static_cast<float>(i % width);
    const auto y = static_cast<float>(row);
    for (size_t c = 0; c < 3; ++c) {
      const auto phase = static_cast<float>(seed + c);
      image.rgba[4 * i + c] =
          0.35f + 0.3f * std::sin(0.4f * x + phase) * std::cos(0.3f * y) + uniform(random);
    }
  }
  return image;
}

// Each channel 0 or 1: filters of different widths leave the cube of displayable colors.
host::Image saturated(uint32_t width, uint32_t height, uint32_t seed) {
  host::Image image = filled(width, height, {});
  std::mt19937 random(seed);
  for (float& value : image.rgba) {
    value = random() % 2 == 0 ? 0.0f : 1.0f;
  }
  return image;
}

void expectTheFormulas(const host::Image& a, const host::Image& b, double pixelsPerDegree) {
  const std::vector<float> map = host::ldrFlip(a, b, pixelsPerDegree);
  const std::vector<double> expected = host_test::directFlip(a, b, pixelsPerDegree);
  double largest = 0.0;
  for (size_t i = 0; i < map.size(); ++i) {
    largest = std::max(largest, expected[i]);
    EXPECT_NEAR(double{map[i]}, expected[i], WHITE_POINT + FEATURE_ROUNDING)
        << "pixel " << i << ", " << pixelsPerDegree << " pixels per degree";
  }
  EXPECT_GT(largest, 0.3);  // the pictures must differ for this to mean anything
}

TEST(HostFlip, AgreesWithTheFormulasOfThePaper) {
  for (const double pixelsPerDegree : {20.0, host::DEFAULT_PIXELS_PER_DEGREE}) {
    host::Image b = busy(24, 17, 2);
    b.rgba[size_t{4} * (8 * 24 + 11)] = 1.0f;  // a point
    expectTheFormulas(busy(24, 17, 1), b, pixelsPerDegree);
    expectTheFormulas(saturated(24, 17, 1), saturated(24, 17, 2), pixelsPerDegree);
  }
}

TEST(HostFlip, IsZeroForEqualPictures) {
  const host::Image image = busy(33, 9, 4);
  for (const float value : host::ldrFlip(image, image, 67.0)) {
    EXPECT_EQ(value, 0.0f);
  }
  const host::FlipResult result = host::hdrFlip(image, image);
  EXPECT_EQ(result.mean, 0.0);
  EXPECT_EQ(result.p95, 0.0);
  EXPECT_EQ(result.nonFinite, 0u);
}

TEST(HostFlip, KnowsBlackAgainstWhite) {
  // Lightness 100 apart, colour alike; green and blue are 203.3 apart in the Hunt-adjusted space:
  // 0.95 + 0.05 ((100 / 203.3)^0.7 - 0.4) / 0.6.
  const double expected = uniformFlip({0, 0, 0}, {1, 1, 1});
  EXPECT_NEAR(expected, 0.9674, 1e-4);
  const std::vector<float> map =
      host::ldrFlip(filled(16, 8, {}), filled(16, 8, {1.0f, 1.0f, 1.0f}), 67.0);
  for (const float value : map) {
    EXPECT_NEAR(double{value}, expected, WHITE_POINT);
  }
}

TEST(HostFlip, KnowsUniformColorDifferences) {
  const std::array<std::array<std::array<float, 3>, 2>, 5> pairs = {{
      {{{0.0f, 1.0f, 0.0f}, {0.0f, 0.0f, 1.0f}}},  // the largest: 1
      {{{0.5f, 0.5f, 0.5f}, {0.5f, 0.5f, 0.5625f}}},
      {{{0.25f, 0.5f, 0.75f}, {0.75f, 0.5f, 0.25f}}},
      {{{0.004f, 0.002f, 0.001f}, {0.002f, 0.004f, 0.001f}}},  // below the cube root's range
      {{{0.9f, 0.9f, 0.9f}, {0.91f, 0.9f, 0.9f}}},
  }};
  EXPECT_DOUBLE_EQ(uniformFlip({0, 1, 0}, {0, 0, 1}), 1.0);
  for (const auto& [a, b] : pairs) {
    const double expected = uniformFlip({double{a[0]}, double{a[1]}, double{a[2]}},
                                        {double{b[0]}, double{b[1]}, double{b[2]}});
    const float value = host::ldrFlip(filled(5, 5, a), filled(5, 5, b), 67.0)[12];
    EXPECT_NEAR(double{value}, expected, WHITE_POINT) << a[0] << ' ' << b[0];
  }
}

TEST(HostFlip, IsSymmetricAndIndifferentToTransposition) {
  const host::Image a = busy(20, 13, 5);
  const host::Image b = busy(20, 13, 6);
  const std::vector<float> map = host::ldrFlip(a, b, 67.0);
  EXPECT_EQ(map, host::ldrFlip(b, a, 67.0));
  const auto transposed = [](const host::Image& image) {
    host::Image t = filled(image.height, image.width, {});
    for (size_t i = 0; i < image.rgba.size(); ++i) {
      const size_t pixel = i / 4;
      t.rgba[4 * (pixel % image.width * image.height + pixel / image.width) + i % 4] =
          image.rgba[i];
    }
    return t;
  };
  const std::vector<float> other = host::ldrFlip(transposed(a), transposed(b), 67.0);
  for (size_t i = 0; i < map.size(); ++i) {
    EXPECT_NEAR(double{map[i]}, double{other[i % 20 * size_t{13} + i / 20]}, FEATURE_ROUNDING);
  }
}

TEST(HostFlip, SeesACheckerboardLessFromFartherAway) {
  host::Image board = filled(64, 64, {});
  for (size_t i = 0; i < board.pixelCount(); ++i) {
    const float value = (i % 64 + i / 64) % 2 == 0 ? 0.4f : 0.6f;
    std::fill_n(board.rgba.begin() + static_cast<ptrdiff_t>(4 * i), 3, value);
  }
  const host::Image grey = filled(64, 64, {0.5f, 0.5f, 0.5f});
  const size_t middle = 32 * 64 + 32;
  const float close = host::ldrFlip(board, grey, 10.0)[middle];
  const float far = host::ldrFlip(board, grey, 100.0)[middle];
  EXPECT_GT(close, 0.1f);
  EXPECT_LT(far, 0.01f);
}

// The curve as published, K. Narkowicz 2015, at 0.6 times the argument.
double acesOf(double x) {
  x *= 0.6;
  return x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
}

TEST(HostFlip, BringsTheBrightEndAndTheMedianToTheSameDisplayValue) {
  host::Image image = filled(100, 100, {0.5f, 0.5f, 0.5f});
  for (size_t i = 0; i < 5100; ++i) {
    const float value = i < 4900 ? 7.0f : 1.0f;
    std::fill_n(image.rgba.begin() + static_cast<ptrdiff_t>(4 * i), 3, value);
  }
  const host::FlipExposures exposures = host::defaultFlipExposures(image);
  EXPECT_NEAR(acesOf(7.0 * std::exp2(exposures.start)), 0.85, 1e-12);
  EXPECT_NEAR(acesOf(1.0 * std::exp2(exposures.stop)), 0.85, 1e-12);
  EXPECT_EQ(exposures.count, 3u);  // log2(7) = 2.8
  // 10 of 10000 pixels are a sun, and as many again are black: nothing changes.
  for (size_t i = 0; i < 10; ++i) {
    std::fill_n(image.rgba.begin() + static_cast<ptrdiff_t>(4 * i), 3, 1e6f);
  }
  EXPECT_EQ(host::defaultFlipExposures(image).start, exposures.start);
  EXPECT_EQ(host::defaultFlipExposures(image).stop, exposures.stop);
  image.rgba.resize(image.rgba.size() * 2, 0.0f);
  image.height *= 2;
  EXPECT_EQ(host::defaultFlipExposures(image).stop, exposures.stop);
}

TEST(HostFlip, TakesTheLargestErrorOverTheExposures) {
  // A shadow that only a long exposure shows, and a highlight that it clips.
  host::Image a = filled(64, 8, {0.01f, 0.01f, 0.01f});
  host::Image b = a;
  for (size_t i = 0; i < a.pixelCount(); ++i) {
    const float difference = i % 64 < 32 ? 0.004f : 4.0f;
    a.rgba[4 * i] = i % 64 < 32 ? 0.01f : 10.0f;
    b.rgba[4 * i] = a.rgba[4 * i] + difference;
  }
  host::FlipOptions options;
  options.exposures = host::FlipExposures{-4.0, 6.0, 3};
  const host::FlipResult all = host::hdrFlip(a, b, options);
  std::array<std::vector<float>, 3> single;
  std::array<int, 3> wins{};
  for (size_t k = 0; k < 3; ++k) {
    const double stops = -4.0 + 5.0 * static_cast<double>(k);
    options.exposures = host::FlipExposures{stops, stops, 1};
    single[k] = host::hdrFlip(a, b, options).map;
    // One exposure is the LDR error of the tone-mapped pictures.
    const auto shown = [&](host::Image image) {
      for (float& value : image.rgba) {
        value = static_cast<float>(std::min(acesOf(double{value} * std::exp2(stops)), 1.0));
      }
      return image;
    };
    const std::vector<float> ldr = host::ldrFlip(shown(a), shown(b), options.pixelsPerDegree);
    for (size_t i = 0; i < ldr.size(); ++i) {
      EXPECT_NEAR(double{single[k][i]}, double{ldr[i]}, FEATURE_ROUNDING);
    }
  }
  for (size_t i = 0; i < all.map.size(); ++i) {
    const std::array<float, 3> values = {single[0][i], single[1][i], single[2][i]};
    const auto best = std::max_element(values.begin(), values.end());
    EXPECT_EQ(all.map[i], *best);
    ++wins[static_cast<size_t>(best - values.begin())];
  }
  EXPECT_GT(wins[0], 0);
  EXPECT_GT(wins[2], 0);
}

TEST(HostFlip, DoesNotChangeWhenBothPicturesAreScaled) {
  host::Image a = busy(30, 20, 7);
  host::Image b = busy(30, 20, 8);
  const host::FlipResult before = host::hdrFlip(a, b);
  for (size_t i = 0; i < a.rgba.size(); ++i) {
    a.rgba[i] *= 1024.0f;  // exact
    b.rgba[i] *= 1024.0f;
  }
  const host::FlipResult after = host::hdrFlip(a, b);
  EXPECT_NEAR(after.exposures.start, before.exposures.start - 10.0, 1e-12);
  EXPECT_EQ(after.exposures.count, before.exposures.count);
  // The exposure's logarithm rounds otherwise: some of the tone-mapped floats change by an ulp.
  EXPECT_NEAR(after.mean, before.mean, FEATURE_ROUNDING);
  EXPECT_NEAR(after.p95, before.p95, FEATURE_ROUNDING);
  EXPECT_GT(after.mean, 0.01);
}

TEST(HostFlip, CountsPixelsThatAreNotFiniteAsOneAndKeepsThemFromTheirNeighbors) {
  host::Image a = filled(20, 10, {0.5f, 0.4f, 0.3f});
  host::Image b = a;
  a.rgba[size_t{4} * 45] = NAN;
  b.rgba[size_t{4} * 46 + 2] = INFINITY;
  a.rgba[size_t{4} * 47 + 3] = NAN;  // alpha does not count
  const host::FlipResult result = host::hdrFlip(a, b);
  EXPECT_EQ(result.nonFinite, 2u);
  for (size_t i = 0; i < result.map.size(); ++i) {
    EXPECT_EQ(result.map[i], i == 45 || i == 46 ? 1.0f : 0.0f) << i;
  }
  EXPECT_NEAR(result.mean, 2.0 / 200.0, 200 * 0x1p-53);
  EXPECT_EQ(result.p95, 0.0);
}

TEST(HostFlip, StaysFiniteForBlackNegativeAndHugePictures) {
  const host::Image black = filled(6, 6, {});
  EXPECT_EQ(host::hdrFlip(black, black).mean, 0.0);
  EXPECT_EQ(host::hdrFlip(filled(6, 6, {-1.0f, -2.0f, -3.0f}), black).mean, 0.0);
  const double mean = host::hdrFlip(filled(6, 6, {3e38f, 3e38f, 3e38f}), black).mean;
  EXPECT_NEAR(mean, uniformFlip({0, 0, 0}, {1, 1, 1}), WHITE_POINT);
}

}  // namespace
