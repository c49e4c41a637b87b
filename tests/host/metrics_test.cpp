// SPDX-License-Identifier: MIT
// Known answers of the image metrics.
#include "common/metrics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

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

TEST(HostMetrics, KnowTheAnswersForARampOfErrors) {
  // Sample k of 3000 is off by k / 1024 of the reference, except that the signs alternate.
  host::Image a = filled(100, 10, 1.0f);
  const host::Image b = filled(100, 10, 1.0f);
  int k = 0;
  double square = 0.0;
  for (size_t i = 0; i < a.rgba.size(); ++i) {
    if (i % 4 != 3) {
      ++k;
      a.rgba[i] += static_cast<float>(k % 2 == 0 ? -k : k) * 0x1p-10f;  // exact
      square += k * 0x1p-10 * k * 0x1p-10;
    }
  }
  const host::ImageMetrics m = host::compareImages(a, b);
  EXPECT_EQ(m.medianRelativeError, 1500 * 0x1p-10);
  EXPECT_EQ(m.p90RelativeError, 2700 * 0x1p-10);
  EXPECT_EQ(m.p95RelativeError, 2850 * 0x1p-10);
  EXPECT_EQ(m.p999RelativeError, 2997 * 0x1p-10);
  EXPECT_EQ(m.maxRelativeError, 3000 * 0x1p-10);
  EXPECT_DOUBLE_EQ(m.relMse, square / 3000.0);
  EXPECT_DOUBLE_EQ(m.bias, -1500.0 * 0x1p-10 / 3000.0);
  // 1 - k / 1024 is below 0 for the even k from 1026 to 3000.
  EXPECT_EQ(m.negative, 988u);
}

TEST(HostMetrics, CountNegativeSamplesOfThePictureOnly) {
  host::Image a = filled(4, 4, 1.0f);
  host::Image b = filled(4, 4, 1.0f);
  a.rgba[0] = -1e-30f;
  a.rgba[1] = -0.0f;
  a.rgba[2] = -INFINITY;  // not finite, so not here
  a.rgba[3] = -1.0f;      // alpha
  b.rgba[4] = -1.0f;
  const host::ImageMetrics m = host::compareImages(a, b);
  EXPECT_EQ(m.negative, 1u);
  EXPECT_EQ(m.nonFinite, 1u);
}

TEST(HostMetrics, TakeTheNoiseOfTheReferenceOff) {
  // Off by 1/4 everywhere, reference 2, variance 1/64 in half of the samples and 3/64 in the rest.
  const host::Image a = filled(8, 8, 2.25f);
  const host::Image b = filled(8, 8, 2.0f);
  host::Image variance = filled(8, 8, 0x1p-6f);
  for (size_t i = 0; i < variance.rgba.size() / 2; ++i) {
    variance.rgba[i] = 3.0f * 0x1p-6f;
  }
  const host::ImageMetrics m = host::compareImages(a, b, &variance);
  EXPECT_DOUBLE_EQ(m.relMse, 1.0 / 64.0);
  EXPECT_DOUBLE_EQ(m.relMseDenoised, 1.0 / 64.0 - 1.0 / 128.0);
  EXPECT_DOUBLE_EQ(m.rmseOverMean, 0.125);
  EXPECT_DOUBLE_EQ(m.rmseOverMeanDenoised, std::sqrt(1.0 / 16.0 - 1.0 / 32.0) / 2.0);
  EXPECT_DOUBLE_EQ(m.standardError, std::sqrt(1.0 / 128.0));
  // A difference smaller than the noise: cut at 0.
  const host::ImageMetrics cut = host::compareImages(filled(8, 8, 2.0625f), b, &variance);
  EXPECT_EQ(cut.relMseDenoised, 0.0);
  EXPECT_EQ(cut.rmseOverMeanDenoised, 0.0);
  EXPECT_GT(cut.relMse, 0.0);
  EXPECT_EQ(host::compareImages(a, b).standardError, 0.0);
}

TEST(HostMetrics, ReturnTheErrorAgainstTheTruthFromANoisyReference) {
  // Truth 1, picture 5 % off, reference of deviation 10 %: the noise hides an error that the
  // subtraction gets back.
  constexpr double ERROR = 0.05;
  constexpr double DEVIATION = 0.1;
  const host::Image a = filled(256, 256, static_cast<float>(1.0 + ERROR));
  host::Image b = filled(256, 256, 0.0f);
  const host::Image variance = filled(256, 256, static_cast<float>(DEVIATION * DEVIATION));
  std::mt19937 random(11);
  std::normal_distribution<double> noise(1.0, DEVIATION);
  for (float& value : b.rgba) {
    value = static_cast<float>(noise(random));
  }
  const host::ImageMetrics m = host::compareImages(a, b, &variance);
  EXPECT_GT(m.rmseOverMean, 2.0 * ERROR);
  // (a - b)^2 has the variance 2 s^4 + 4 s^2 e^2; five standard errors of its mean.
  const double spread =
      std::sqrt((2.0 * std::pow(DEVIATION, 4) + 4.0 * DEVIATION * DEVIATION * ERROR * ERROR) /
                static_cast<double>(m.samples));
  const double mean = m.referenceMean;
  EXPECT_NEAR(std::pow(m.rmseOverMeanDenoised * mean, 2), ERROR * ERROR, 5.0 * spread);
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
