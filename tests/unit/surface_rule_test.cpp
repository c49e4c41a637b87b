// SPDX-License-Identifier: MIT
// The rule that shades surface clouds (shaders/model/surface) against Monte Carlo pictures of
// homogeneous bodies (surface_truth.csv, made by tests/bench/surface_truth.cpp), and its limits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "model/model.hpp"
#include "tables/canonical_phase.hpp"
#include "unit/surface_picture.hpp"

namespace {

using namespace welkin;
namespace f32 = welkin::model::f32;
namespace f64 = welkin::model::f64;

double canonical(double y) {
  static const CanonicalPhase cloud = canonicalPhase();
  const auto next = std::upper_bound(cloud.y.begin(), cloud.y.end() - 1, y);
  const auto i = std::max<std::ptrdiff_t>(next - cloud.y.begin(), 1);
  const auto k = static_cast<size_t>(i);
  const double part = (y - cloud.y[k - 1]) / (cloud.y[k] - cloud.y[k - 1]);
  return cloud.value[k - 1] + part * (cloud.value[k] - cloud.value[k - 1]);
}

TEST(SurfaceRule, BodiesAgreeWithMonteCarlo) {
  const auto truth = test::readSurfaceTruth(WELKIN_UNIT_FOLDER "/surface_truth.csv");
  const auto errors = test::surfaceErrors(truth, {canonical, 1});
  // Bars of front-lit and other views; bodies that the rule was not chosen by may be off by more.
  constexpr double TOTAL = 0.15;
  constexpr double FRONT_RMS = 0.20;
  constexpr double OTHER_RMS = 0.25;
  constexpr double ELSEWHERE = 1.6;
  size_t spheres = 0;
  for (const test::SurfaceError& error : errors) {
    std::printf("%-12s %3d  total %.2f  rms %.3f\n", error.body.c_str(), error.angle, error.total,
                error.rms);
    const double bar = error.angle >= 120 ? FRONT_RMS : OTHER_RMS;
    const bool sphere = error.body.rfind("sphere", 0) == 0;
    const double factor = sphere ? 1 : ELSEWHERE;
    spheres += sphere ? 1 : 0;
    EXPECT_NEAR(error.total, 1, factor * TOTAL) << error.body << ' ' << error.angle;
    EXPECT_LE(error.rms, factor * bar + 0.001) << error.body << ' ' << error.angle;
  }
  EXPECT_EQ(spheres, 15U);
}

// All of a footprint is cloud and its faces are parallel: the rule is the canonical table's.
TEST(SurfaceRule, SlabIsTheSlabWhateverTheSet) {
  const f64::vec3 normal = glm::normalize(f64::vec3(0.3, -0.2, 0.9));
  const f64::vec3 light = glm::normalize(f64::vec3(-0.4, 0.1, 0.8));
  const f64::vec3 eye = glm::normalize(f64::vec3(0.5, 0.6, 0.7));
  const f64::TangentSlab truth = f64::tangentSlab(9, 9 * 0.3, normal, light, eye);
  for (int set = 0; set < f64::SURFACE_SETS; ++set) {
    const f64::SurfaceSlab found =
        f64::surfaceSlab(set, {1, 9, normal, -normal}, 0.3, 9, light, eye);
    EXPECT_NEAR(found.slab.thickness, truth.thickness, 1e-9);
    EXPECT_NEAR(found.slab.depth, truth.depth, 1e-9);
    EXPECT_NEAR(found.slab.muLight, truth.muLight, 1e-9);
    EXPECT_NEAR(found.slab.muView, truth.muView, 1e-9);
    EXPECT_NEAR(found.slab.phi, truth.phi, 1e-9);
    EXPECT_NEAR(found.inside, 1, 2e-6);
  }
}

TEST(SurfaceRule, NarrowerCloudsKeepLessAndNothingIsLeftOfNone) {
  for (int set = 0; set < f32::SURFACE_SETS; ++set) {
    float last = 0;
    for (int i = 0; i <= 100; ++i) {
      const float part = f32::footprintSurvival(set, static_cast<float>(i) / 100, 0.5f);
      EXPECT_GE(part, last);
      EXPECT_LE(part, 1.0f);
      last = part;
    }
    EXPECT_EQ(f32::footprintSurvival(set, 0, 1), 0.0f);
    EXPECT_GT(last, 0.99f);
  }
}

// Hills and valleys keep less the higher they are and the more of their surroundings is cloud; what
// lies level keeps all.
TEST(SurfaceRule, HillsKeepLess) {
  for (int set = 0; set < f64::SURFACE_SETS; ++set) {
    EXPECT_EQ(f64::hillKept(set, 1, 0), 1);
    EXPECT_EQ(f64::hillKept(set, 1, -7), f64::hillKept(set, 1, 7));
    EXPECT_EQ(f64::hillKept(set, 0, 7), 1);
    double last = 1;
    for (int i = 1; i <= 20; ++i) {
      const double kept = f64::hillKept(set, 1, 0.5 * i);
      EXPECT_LT(kept, last);
      EXPECT_LT(kept, f64::hillKept(set, 0.8, 0.5 * i));
      last = kept;
    }
    EXPECT_GE(last, 0);
  }
}

TEST(SurfaceRule, IsFiniteForAnyMap) {
  const f32::vec3 none(0, 0, 0);
  const f32::vec3 up(0, 0, 1);
  for (const float coverage : {0.0f, 1e-30f, 1e-5f, 0.4f, 1.0f}) {
    for (const float through : {0.0f, 1e-20f, 3.0f, 1e30f}) {
      for (const f32::vec3 lit : {none, up, -up, f32::vec3(1, 0, 0)}) {
        for (const f32::vec3 shaded : {none, up, -up}) {
          for (int set = 0; set < f32::SURFACE_SETS; ++set) {
            const float rise = set % 2 == 0 ? through : -through;
            const f32::SurfaceSlab found = f32::surfaceSlab(
                set, {coverage, through * coverage, lit, shaded, rise}, 0.5f, through, up, up);
            EXPECT_TRUE(std::isfinite(found.slab.thickness));
            EXPECT_TRUE(std::isfinite(f32::footprintSpread(set, found.slab)));
            const f32::SourcePlace place = f32::sourcePlace(set, found.slab);
            EXPECT_TRUE(std::isfinite(place.outside));
            const f32::vec3 last(f32::SOURCE_DEPTHS - 1, f32::SOURCE_THICKNESSES - 1,
                                 f32::SOURCE_LIGHTS - 1);
            for (int k = 0; k < 3; ++k) {
              EXPECT_GE(place.node[k], 0.0f);
              EXPECT_LE(place.node[k], last[k] * 1.00001f);
            }
            EXPECT_GE(found.inside, 0.0f);
            EXPECT_LE(found.inside, 1.0f);
          }
        }
      }
    }
  }
}

}  // namespace
