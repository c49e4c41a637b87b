// SPDX-License-Identifier: MIT
// shaders/model/surface/chord.glsl against quadrature of [B08] Eq. 1 and 2 as corrected.
#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>

#include "model/model.hpp"
#include "reference/quadrature.hpp"
#include "support/tolerance.hpp"

namespace {

namespace f32 = welkin::model::f32;
namespace f64 = welkin::model::f64;
namespace ref = welkin::reference;
using welkin::test::relativeError;

constexpr double DEPTHS[] = {0, 1e-6, 0.01, 0.3, 1, 2.5, 8, 20};

// Integral of e^-(x + l(x)) over the stretch, l linear.
double truth(double nearDepth, double farDepth, double tau) {
  const ref::GaussRule rule = ref::gaussLegendre(64);
  double sum = 0;
  for (size_t i = 0; i < rule.node.size(); ++i) {
    const auto u = static_cast<double>(rule.node[i]);
    sum += static_cast<double>(rule.weight[i]) *
           std::exp(-u * tau - nearDepth * (1 - u) - farDepth * u);
  }
  return tau * sum;
}

TEST(SurfaceChord, SingleScatteringIsTheIntegralTowardsAndAwayFromTheLight) {
  // Condition: depths up to 40 meet an exponential; 16 more roundings.
  constexpr double BOUND = (40 * 2 + 16) * welkin::test::EPS_FLOAT;
  for (const double a : DEPTHS) {
    for (const double b : DEPTHS) {
      for (const double tau : DEPTHS) {
        const double exact = truth(a, b, tau);
        const f64::ChordLight wide = f64::chordStretch(f64::emptyChord(), a, b, tau);
        EXPECT_LE(relativeError(wide.inscatter, exact), 1e-12) << a << ' ' << b << ' ' << tau;
        EXPECT_DOUBLE_EQ(wide.transmittance, std::exp(-tau));
        const f32::ChordLight single =
            f32::chordStretch(f32::emptyChord(), static_cast<float>(a), static_cast<float>(b),
                              static_cast<float>(tau));
        EXPECT_LE(relativeError(single.inscatter, exact), BOUND) << a << ' ' << b << ' ' << tau;
      }
    }
  }
  // Straight towards the light the depths add up to a constant: 0/0 in the quotient as printed.
  EXPECT_NEAR(f64::chordStretch(f64::emptyChord(), 2, 0, 2).inscatter, 2 * std::exp(-2.0), 1e-15);
}

TEST(SurfaceChord, StretchesOfOneLineAreTheWhole) {
  const f64::ChordLight whole = f64::chordStretch(f64::emptyChord(), 1.0, 3.0, 4.0);
  f64::ChordLight parts = f64::emptyChord();
  double begin = 0;
  for (int i = 1; i <= 7; ++i) {
    const double end = f64::chordDepth(i / 7.0, 4.0);
    parts = f64::chordStretch(parts, 1 + begin / 2, 1 + end / 2, end - begin);
    EXPECT_NEAR(parts.transmittance, 1 - i / 7.0 * (1 - std::exp(-4.0)), 1e-6);
    begin = end;
  }
  EXPECT_NEAR(parts.inscatter, whole.inscatter, 1e-14);
  EXPECT_NEAR(parts.transmittance, std::exp(-4.0), 1e-15);
}

TEST(SurfaceChord, IsFiniteAndKeepsEnergyAtAnyDepth) {
  for (const float tau : {0.0f, 1e-30f, 1.0f, 1e4f, 1e30f, INFINITY}) {
    for (const float a : {0.0f, 1e-20f, 1.0f, 1e30f, INFINITY}) {
      for (const float b : {0.0f, 1.0f, 1e5f, INFINITY}) {
        const f32::ChordLight light = f32::chordStretch(f32::emptyChord(), a, b, tau);
        EXPECT_GE(light.inscatter, 0.0f);
        EXPECT_LE(light.inscatter, 1.0f + 4e-7f);
        EXPECT_GE(light.transmittance, 0.0f);
        EXPECT_LE(light.transmittance, 1.0f);
      }
    }
    float last = 0;
    for (int i = 0; i <= 64; ++i) {
      const float depth = f32::chordDepth(static_cast<float>(i) / 64, tau);
      EXPECT_GE(depth, last);
      EXPECT_LE(depth, tau);
      last = depth;
    }
    EXPECT_EQ(last, tau);
  }
  // The series and the logarithm meet.
  for (const double x : {1e-8, 1e-3, 0.0299999, 0.0300001, 0.5, 0.999}) {
    EXPECT_LE(relativeError(f64::chordLogarithm(x), -std::log1p(-x)), 2e-7) << x;
  }
}

}  // namespace
