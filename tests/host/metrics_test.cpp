// SPDX-License-Identifier: MIT
// Known answers of the image metrics.
#include "common/metrics.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace {

// Values pass through float: half an ulp each way of 1, relative to differences of 1/8.
constexpr double FLOAT_ROUNDING = 8.0 * 2.0 * 0x1p-24;

host::Image filled(uint32_t width, uint32_t height, float value) {
  return {width, height, std::vector<float>(size_t{width} * height * 4, value)};
}

TEST(HostMetrics, AreZeroForEqualPictures) {
  const host::Image image = filled(8, 5, 0.7f);
  const host::ImageMetrics m = host::compareImages(image, image);
  EXPECT_EQ(m.relMse, 0.0);
  EXPECT_EQ(m.rmseOverMean, 0.0);
  EXPECT_EQ(m.bias, 0.0);
  EXPECT_EQ(m.maxRelativeError, 0.0);
  EXPECT_EQ(m.nonFinite, 0u);
  EXPECT_EQ(m.samples, 8u * 5u * 3u);
}

TEST(HostMetrics, KnowTheAnswerForAConstantFactor) {
  const host::ImageMetrics m = host::compareImages(filled(8, 8, 0.875f), filled(8, 8, 1.0f));
  EXPECT_NEAR(m.bias, -0.125, FLOAT_ROUNDING);
  EXPECT_NEAR(m.rmseOverMean, 0.125, FLOAT_ROUNDING);
  EXPECT_NEAR(m.relMse, 0.125 * 0.125, FLOAT_ROUNDING);
  EXPECT_NEAR(m.p999RelativeError, 0.125, FLOAT_ROUNDING);
  EXPECT_NEAR(m.maxRelativeError, 0.125, FLOAT_ROUNDING);
}

TEST(HostMetrics, DoNotChangeWhenBothPicturesAreScaled) {
  host::Image a = filled(16, 16, 1.0f);
  host::Image b = filled(16, 16, 1.0f);
  for (size_t i = 0; i < a.rgba.size(); ++i) {
    a.rgba[i] = 1.0f + 0.01f * static_cast<float>(i % 7);
    b.rgba[i] = 0.001f * static_cast<float>(i % 13);
  }
  const host::ImageMetrics before = host::compareImages(a, b);
  for (size_t i = 0; i < a.rgba.size(); ++i) {
    a.rgba[i] *= 1024.0f;  // a power of two: exact
    b.rgba[i] *= 1024.0f;
  }
  const host::ImageMetrics after = host::compareImages(a, b);
  EXPECT_DOUBLE_EQ(before.relMse, after.relMse);
  EXPECT_DOUBLE_EQ(before.rmseOverMean, after.rmseOverMean);
  EXPECT_DOUBLE_EQ(before.maxRelativeError, after.maxRelativeError);
}

TEST(HostMetrics, SeparateTheLargestErrorFromThePercentile) {
  // 2 of 3000 samples are off: the 2997th in order is still exact.
  host::Image a = filled(100, 10, 2.0f);
  const host::Image b = filled(100, 10, 2.0f);
  a.rgba[0] = 3.0f;
  a.rgba[401] = 2.5f;
  const host::ImageMetrics m = host::compareImages(a, b);
  EXPECT_EQ(m.maxRelativeError, 0.5);
  EXPECT_EQ(m.p999RelativeError, 0.0);
  a.rgba[802] = 2.5f;
  a.rgba[806] = 2.25f;
  // 4 of 3000 are off: the 2997th is the smallest of them.
  EXPECT_EQ(host::compareImages(a, b).p999RelativeError, 0.125);
}

TEST(HostMetrics, CountSamplesThatAreNotFiniteAndLeaveThemOut) {
  host::Image a = filled(4, 4, 1.0f);
  host::Image b = filled(4, 4, 1.0f);
  a.rgba[0] = NAN;
  b.rgba[0] = INFINITY;
  b.rgba[5] = -INFINITY;
  a.rgba[7] = NAN;  // alpha does not count
  const host::ImageMetrics m = host::compareImages(a, b);
  EXPECT_EQ(m.nonFinite, 2u);
  EXPECT_EQ(m.samples, 46u);
  EXPECT_EQ(m.maxRelativeError, 0.0);
}

TEST(HostMetrics, StayFiniteForABlackReference) {
  const host::ImageMetrics m = host::compareImages(filled(4, 4, 1.0f), filled(4, 4, 0.0f));
  EXPECT_TRUE(std::isfinite(m.relMse));
  EXPECT_TRUE(std::isfinite(m.rmseOverMean));
  EXPECT_GT(m.maxRelativeError, 1e30);
}

TEST(HostMetrics, KeepASmallBiasOnALargeMean) {
  // 1 ulp of 1024 in every second sample: a plain float sum would lose it.
  host::Image a = filled(512, 512, 1024.0f);
  const host::Image b = filled(512, 512, 1024.0f);
  for (size_t i = 0; i < a.rgba.size(); i += 2) {
    a.rgba[i] = std::nextafter(1024.0f, 2000.0f);
  }
  // Samples 0 and 2 of each pixel's three are off.
  const double expected = 2.0 / 3.0 * 0x1p-13 / 1024.0;
  EXPECT_NEAR(host::compareImages(a, b).bias, expected, 1e-12 * expected);
}

}  // namespace
