// SPDX-License-Identifier: MIT
// The two-ended segment of shaders/model/sky/segment.glsl against quadrature of [R04] Eq. 14.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <random>
#include <string>

#include "model/model.hpp"
#include "reference/quadrature.hpp"
#include "support/tolerance.hpp"

namespace {

namespace f32 = welkin::model::f32;
namespace f64 = welkin::model::f64;
namespace ref = welkin::reference;
using welkin::test::relativeError;

// Light depths count up to the cut at 46; the far one is that at the eye times e^-x, x = gamma p K
// up to 8 (low sun), a product of 3 with 2 roundings. 12 more roundings in the rest. 4.8e-5
// and 8.9e-14; measured 1.0e-5 and 3e-15; docs promise 5e-5 and 1e-12.
constexpr double ROUNDINGS = 46 * (8 * 2 + 1) + 12;
constexpr double DOUBLE_BOUND = ROUNDINGS * welkin::test::EPS_DOUBLE;
constexpr double FLOAT_BOUND = ROUNDINGS * welkin::test::EPS_FLOAT;
// Light below e^-46 may be cut to 0, per unit depth of the segment (numeric.glsl, EXP_CUT).
constexpr double CUT = 1.1e-20;

struct Input {
  float extinction;
  float inverseScaleHeight;
  float viewSlope;
  float lightSlope;
  float distance;
};

class Inputs {
 public:
  Input next(int set) {
    Input in{};
    const float height = std::exp(-uniform(0.0f, 2.5f));  // e^-h/H at the eye
    in.inverseScaleHeight = uniform(0.0f, 1.0f) < 0.5f ? 1.0f / 8000.0f : 1.0f / 1200.0f;
    in.extinction = power(-5.5f, -4.4f) * height;
    in.viewSlope = uniform(0.01f, 1.0f);
    in.lightSlope = uniform(0.02f, 1.0f);
    in.distance = power(2.0f, 5.0f);
    switch (set) {
      case 0:  // p -> 0, both signs, and exactly 0
        in.viewSlope = sign() * power(-12.0f, -3.0f) * (uniform(0.0f, 1.0f) < 0.1f ? 0.0f : 1.0f);
        break;
      case 1:  // p -> l: equal, one ulp apart, close
        in.viewSlope = in.lightSlope;
        if (uniform(0.0f, 1.0f) < 0.3f) {
          in.viewSlope = std::nextafter(in.lightSlope, sign());
        } else if (uniform(0.0f, 1.0f) < 0.8f) {
          in.viewSlope = in.lightSlope * (1.0f + sign() * power(-7.0f, -2.0f));
        }
        break;
      case 2:  // downwards, to the ground and far below
        in.viewSlope = -in.viewSlope;
        in.distance = power(2.0f, 7.0f);
        break;
      case 3:  // low sun
        in.lightSlope = power(-5.0f, -1.7f);
        break;
      case 4:  // long and infinite
        in.distance =
            uniform(0.0f, 1.0f) < 0.5f ? power(5.0f, 8.0f) : std::numeric_limits<float>::infinity();
        break;
      case 5:  // thin air, eye to 100 km
        in.extinction = power(-11.4f, -6.0f);
        break;
      case 6:  // short
        in.distance = power(-3.0f, 0.0f);
        break;
      case 7:  // dense haze and fog
        in.extinction = power(-3.5f, 0.5f);
        in.inverseScaleHeight = power(-3.5f, -1.0f);
        in.viewSlope *= sign();
        in.distance = power(-1.0f, 5.0f);
        break;
      default:  // generic
        in.extinction = power(-5.5f, -3.15f) * height;
        break;
    }
    return in;
  }

 private:
  float uniform(float lo, float hi) {
    return std::uniform_real_distribution<float>(lo, hi)(generator_);
  }
  float power(float lo, float hi) { return std::pow(10.0f, uniform(lo, hi)); }
  float sign() { return uniform(0.0f, 1.0f) < 0.5f ? -1.0f : 1.0f; }

  std::mt19937 generator_{15};
};

// Error of `value`, counting only what is above the documented cut.
double errorOf(long double value, long double truth, long double depth) {
  if (!std::isfinite(value) || value < 0.0L) {
    return std::numeric_limits<double>::infinity();
  }
  const long double missing = std::fabs(value - truth);
  return missing <= static_cast<long double>(CUT) * depth ? 0.0 : relativeError(value, truth);
}

TEST(FlatSegment, MatchesQuadratureOfEq14ForAdversarialInputs) {
  constexpr int SETS = 9;
  constexpr int PER_SET = 11500;
  Inputs inputs;
  for (int set = 0; set < SETS; ++set) {
    double worst32 = 0.0;
    double worst64 = 0.0;
    double worstDepth32 = 0.0;
    double worstDepth64 = 0.0;
    for (int i = 0; i < PER_SET; ++i) {
      const Input in = inputs.next(set);
      const ref::FlatRay ray = {in.extinction, in.inverseScaleHeight, in.viewSlope, in.lightSlope,
                                in.distance};
      const long double truth = ref::flatInscatter(ray);
      const long double depth = ref::flatOpticalDepth(ray);
      const f32::Segment a = f32::flatExponentialSegment(in.extinction, in.inverseScaleHeight,
                                                         in.viewSlope, in.lightSlope, in.distance);
      const f64::Segment b = f64::flatExponentialSegment(
          double{in.extinction}, double{in.inverseScaleHeight}, double{in.viewSlope},
          double{in.lightSlope}, double{in.distance});
      const double e32 = errorOf(a.inscatter, truth, depth);
      const double e64 = errorOf(b.inscatter, truth, depth);
      ASSERT_LE(e32, FLOAT_BOUND) << set << ": beta " << in.extinction << " gamma "
                                  << in.inverseScaleHeight << " p " << in.viewSlope << " l "
                                  << in.lightSlope << " K " << in.distance << " is " << a.inscatter
                                  << " not " << static_cast<double>(truth);
      ASSERT_LE(e64, DOUBLE_BOUND)
          << set << ": beta " << in.extinction << " gamma " << in.inverseScaleHeight << " p "
          << in.viewSlope << " l " << in.lightSlope << " K " << in.distance;
      worst32 = std::fmax(worst32, e32);
      worst64 = std::fmax(worst64, e64);
      if (depth < 1e3L) {  // beyond, depths are capped: e^-1000 is no light
        worstDepth32 = std::fmax(worstDepth32, relativeError(a.opticalDepth, depth));
        worstDepth64 = std::fmax(worstDepth64, relativeError(b.opticalDepth, depth));
      }
    }
    const std::string name = "set" + std::to_string(set);
    RecordProperty(name + "_float", std::to_string(worst32));
    RecordProperty(name + "_double", std::to_string(worst64));
    std::printf("  set %d: inscatter float %.1e double %.1e, depth float %.1e double %.1e\n", set,
                worst32, worst64, worstDepth32, worstDepth64);
    // Exponent gamma p K up to 20 with 2 roundings, 6 more in the product and phi1.
    constexpr double DEPTH_ROUNDINGS = 20 * 2 + 6;
    EXPECT_LE(worstDepth32, DEPTH_ROUNDINGS * welkin::test::EPS_FLOAT);
    EXPECT_LE(worstDepth64, DEPTH_ROUNDINGS * welkin::test::EPS_DOUBLE);
  }
}

TEST(FlatSegment, ReferenceReproducesTheClosedFormWhereItIsRegular) {
  // [R04] Eq. 15 with its missing factor, for p, l well apart: an independent check of Eq. 14.
  const long double beta = 3.31e-5L, gamma = 1.25e-4L, p = 0.8L, l = 0.3L, distance = 30000.0L;
  const long double c = beta / gamma * (1.0L / l - 1.0L / p);
  const long double closed = std::exp(-beta / (gamma * p)) * l / (p - l) *
                             (std::exp(-c * std::exp(-gamma * p * distance)) - std::exp(-c));
  const long double truth = ref::flatInscatter({beta, gamma, p, l, distance});
  EXPECT_LE(relativeError(closed, truth), 1e-16);
}

TEST(FlatSegment, GivesNoLightFromBelowTheHorizonAndNoneWithoutMatter) {
  EXPECT_EQ(f32::flatExponentialSegment(1e-4f, 1e-4f, 0.5f, 0.0f, 1e4f).inscatter, 0.0f);
  EXPECT_EQ(f32::flatExponentialSegment(1e-4f, 1e-4f, 0.5f, -0.2f, 1e4f).inscatter, 0.0f);
  EXPECT_EQ(f32::flatExponentialSegment(0.0f, 1e-4f, -1.0f, 0.5f, 1e9f).inscatter, 0.0f);
  EXPECT_EQ(f32::flatExponentialSegment(1e-4f, 1e-4f, 0.5f, 0.5f, 0.0f).inscatter, 0.0f);
}

TEST(FlatSegment, IsFiniteAndBoundedAtTheExtremes) {
  constexpr float inf = std::numeric_limits<float>::infinity();
  for (const float extinction : {0.0f, 1e-12f, 1e-3f, 10.0f}) {
    for (const float gamma : {1e-5f, 1e-3f, 1.0f}) {
      for (const float p : {-1.0f, -1e-6f, -1e-30f, 0.0f, -0.0f, 1e-30f, 1e-6f, 1.0f}) {
        for (const float l : {-1.0f, 0.0f, 1e-30f, 1e-5f, 1.0f}) {
          for (const float distance : {0.0f, 1e-3f, 1e4f, 1e9f, inf}) {
            const f32::Segment s = f32::flatExponentialSegment(extinction, gamma, p, l, distance);
            ASSERT_TRUE(s.opticalDepth >= 0.0f && std::isfinite(s.opticalDepth));
            ASSERT_TRUE(s.inscatter >= 0.0f && s.inscatter <= 1.0f + FLOAT_BOUND)
                << extinction << " " << gamma << " " << p << " " << l << " " << distance;
          }
        }
      }
    }
  }
}

TEST(SegmentInscatter, IsSymmetricInItsEnds) {
  // Seen from the other end a and b change places: b' = a, a' = b.
  for (const double a : {0.0, 0.1, 3.0, 30.0}) {
    for (const double b : {0.2, 3.1, 29.0}) {
      const double depth = std::fmin(a, b) * 0.5;
      EXPECT_NEAR(f64::segmentInscatter(a, b - depth, depth),
                  f64::segmentInscatter(b, a - depth, depth),
                  8 * welkin::test::EPS_DOUBLE * (1.0 + a + b) * depth);
    }
  }
}

}  // namespace
