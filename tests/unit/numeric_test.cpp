// SPDX-License-Identifier: MIT
// Elementary functions of shaders/model/numeric.glsl against the long double C library.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "model/model.hpp"
#include "support/tolerance.hpp"

namespace {

namespace f32 = welkin::model::f32;
namespace f64 = welkin::model::f64;
using welkin::test::EPS_DOUBLE;
using welkin::test::EPS_FLOAT;
using welkin::test::ErrorSample;
using welkin::test::relativeError;

// phi1Small: 3 roundings of a sum near 1, one division, the fit's 3e-16; at the switch 1 - e^-x
// loses a factor 0.6 / 0.39 of the rounding of exp. x < 0 grows the quotient's share to 1.3.
constexpr double PHI_ROUNDINGS = 5;

long double phiTruth(long double x) {
  return x == 0.0L ? 1.0L : -std::expm1(-x) / x;
}

// Both signs, from subnormal to 60, with the switch at 0.5 and its neighbours.
std::vector<double> arguments() {
  std::vector<double> result = {0.0, 0.5, std::nextafter(0.5, 0.0), std::nextafter(0.5, 1.0)};
  std::mt19937 generator(11);
  std::uniform_real_distribution<double> exponent(-40.0, std::log10(60.0));
  std::uniform_real_distribution<double> middle(0.0, 2.0);
  for (int i = 0; i < 20000; ++i) {
    result.push_back(std::pow(10.0, exponent(generator)));
    result.push_back(middle(generator));
  }
  const std::size_t count = result.size();
  for (std::size_t i = 0; i < count; ++i) {
    result.push_back(-result[i]);
  }
  return result;
}

TEST(Numeric, PhiAndOneMinusExpAreAccurateForEveryArgument) {
  double worst32 = 0.0;
  double worst64 = 0.0;
  for (const double x : arguments()) {
    const auto y = static_cast<float>(x);
    // Far below zero the result is e^-x, whose argument's own rounding counts |x| times.
    const double growth = 1.0 + std::fmax(-x, 0.0);
    const double one64 =
        relativeError(f64::oneMinusExp(x), -std::expm1(-static_cast<long double>(x)));
    const double one32 =
        relativeError(f32::oneMinusExp(y), -std::expm1(-static_cast<long double>(y)));
    worst64 = std::fmax(worst64, relativeError(f64::phi1(x), phiTruth(x)) / growth);
    worst32 = std::fmax(worst32, relativeError(f32::phi1(y), phiTruth(y)) / growth);
    worst64 = std::fmax(worst64, one64 / growth);
    worst32 = std::fmax(worst32, one32 / growth);
  }
  EXPECT_LE(worst64, PHI_ROUNDINGS * EPS_DOUBLE);
  EXPECT_LE(worst32, PHI_ROUNDINGS * EPS_FLOAT);
}

TEST(Numeric, PhiAndOneMinusExpTakeInfinity) {
  EXPECT_EQ(f32::phi1(std::numeric_limits<float>::infinity()), 0.0f);
  EXPECT_EQ(f64::phi1(std::numeric_limits<double>::infinity()), 0.0);
  EXPECT_EQ(f32::oneMinusExp(std::numeric_limits<float>::infinity()), 1.0f);
  EXPECT_EQ(f64::oneMinusExp(std::numeric_limits<double>::infinity()), 1.0);
  EXPECT_TRUE(std::isfinite(f32::phi1(-80.0f)));
  EXPECT_TRUE(std::isfinite(f32::oneMinusExp(-80.0f)));
}

TEST(Numeric, SafeExpCutsTailsAndNeverOverflows) {
  constexpr float inf = std::numeric_limits<float>::infinity();
  EXPECT_EQ(f32::safeExp(-inf), 0.0f);
  EXPECT_EQ(f32::safeExp(-46.5f), 0.0f);
  EXPECT_GT(f32::safeExp(-46.0f), 1e-20f);
  EXPECT_EQ(f32::safeExp(0.0f), 1.0f);
  EXPECT_TRUE(std::isfinite(f32::safeExp(inf)));
  EXPECT_LE(relativeError(f64::safeExp(-3.25), std::exp(-3.25L)), 2 * EPS_DOUBLE);
}

// e^(x^2) erfc(x); beyond 50 by its asymptotic series, whose next term is 1e-16 there.
long double erfcxTruth(long double x) {
  if (x < 50.0L) {
    return std::exp(x * x) * std::erfc(x);
  }
  const long double q = 1.0L / (2.0L * x * x);
  const long double series = 1.0L - q * (1.0L - 3.0L * q * (1.0L - 5.0L * q * (1.0L - 7.0L * q)));
  return series / (x * std::sqrt(std::acos(-1.0L)));
}

TEST(Numeric, ErfcxFitsWithinFourInTenMillion) {
  constexpr double FIT = 4e-8;  // of the polynomial, as numeric.glsl states
  // t: 2 roundings, s: 2, which the polynomial's slope (at most twice its value) multiplies; the
  // sum of 10 terms of one sign or small: 2; product: 1.
  constexpr double ROUNDINGS = 2 * 2 + 2 + 1;
  double worst32 = 0.0;
  double worst64 = 0.0;
  for (double x = 1e-6; x < 1e6; x *= 1.003) {
    const auto y = static_cast<float>(x);
    worst64 = std::fmax(worst64, relativeError(f64::erfcxPositive(x), erfcxTruth(x)));
    worst32 = std::fmax(worst32, relativeError(f32::erfcxPositive(y), erfcxTruth(y)));
  }
  EXPECT_NEAR(f64::erfcxPositive(0.0), 1.0, FIT);
  EXPECT_LE(worst64, FIT);
  EXPECT_LE(worst32, FIT + ROUNDINGS * EPS_FLOAT);
}

TEST(Numeric, ErfcxFallsMonotonically) {
  double before = f64::erfcxPositive(0.0);
  for (double x = 1e-3; x < 1e5; x *= 1.01) {
    const double value = f64::erfcxPositive(x);
    ASSERT_LT(value, before) << x;
    before = value;
  }
}

TEST(ErrorSample, QuantilesAreOrderStatistics) {
  ErrorSample sample;
  for (int i = 100; i >= 1; --i) {
    sample.add(i);
  }
  EXPECT_EQ(sample.median(), 50.0);
  EXPECT_EQ(sample.p95(), 95.0);
  EXPECT_EQ(sample.max(), 100.0);
  sample.add(std::nan(""));
  EXPECT_EQ(sample.max(), std::numeric_limits<double>::infinity());
}

TEST(Numeric, MeanOfAnExponentialIsAccurateForEveryDistance) {
  // Roundings of the far exponential (2, once more of its cast) and of the difference, which beyond
  // the switch at 1/2 is no less than 0.39 of the larger end; the quotient; 3 steps of the
  // polynomial.
  constexpr double ROUNDINGS = 3 / 0.39 + 4;
  constexpr double SERIES = 3e-9;
  double worst32 = 0.0;
  double worst64 = 0.0;
  for (const double d : arguments()) {
    const auto y = static_cast<float>(d);
    const double far = std::exp(-d);
    const auto farOfFloat = static_cast<float>(std::exp(-static_cast<double>(y)));
    worst64 = std::fmax(worst64, relativeError(f64::meanExp(1.0, far, d), phiTruth(d)));
    worst32 = std::fmax(worst32, relativeError(f32::meanExp(1.0f, farOfFloat, y), phiTruth(y)));
  }
  EXPECT_LE(worst32, SERIES + ROUNDINGS * EPS_FLOAT);
  EXPECT_LE(worst64, SERIES + ROUNDINGS * EPS_DOUBLE);
}

}  // namespace
