// SPDX-License-Identifier: MIT
// shaders/model/surface/tangent_slab.glsl against angles and depths of slabs that are turned
// anyhow.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "model/model.hpp"
#include "reference/vector.hpp"

namespace {

namespace f32 = welkin::model::f32;
namespace f64 = welkin::model::f64;
namespace ref = welkin::reference;

constexpr double PI = std::numbers::pi;

f64::vec3 vec(const ref::Point& p) {
  return {p[0], p[1], p[2]};
}

TEST(TangentSlab, CoordinatesAreThoseOfTheSlabHoweverItIsTurned) {
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int i = 0; i < 2000; ++i) {
    const double muLight = 0.02 + 0.98 * uniform(generator);
    const double muView = 2 * uniform(generator) - 1;
    const double phi = PI * uniform(generator);
    const double thickness = std::exp(8 * uniform(generator) - 4);
    const double depth = thickness * uniform(generator);
    // A frame with z down into the slab, x along the light's travel.
    const ref::Point down = ref::normalized(
        {uniform(generator) - 0.5, uniform(generator) - 0.5, uniform(generator) - 0.6});
    const ref::Point x = ref::deflected(down, 1, 6 * uniform(generator));
    const ref::Point y = ref::cross(down, x);
    const double sineLight = std::sqrt(1 - muLight * muLight);
    const double sineView = std::sqrt(1 - muView * muView);
    ref::Point toLight{};
    ref::Point toEye{};
    ref::Point normal{};
    for (size_t k = 0; k < 3; ++k) {
      normal[k] = -down[k];
      toLight[k] = -(muLight * down[k] + sineLight * x[k]);
      toEye[k] = muView * down[k] + sineView * (std::cos(phi) * x[k] + std::sin(phi) * y[k]);
    }
    const f64::TangentSlab slab = f64::tangentSlab(thickness / muLight, depth / muLight,
                                                   vec(normal), vec(toLight), vec(toEye));
    EXPECT_NEAR(slab.thickness, thickness, 1e-12 * thickness);
    EXPECT_NEAR(slab.depth, depth, 1e-12 * thickness);
    EXPECT_NEAR(slab.muLight, muLight, 1e-12);
    EXPECT_NEAR(slab.muView, muView, 1e-12);
    // The product of the sines is what the azimuth is read from.
    EXPECT_NEAR(slab.phi, phi, 1e-14 / std::max(sineLight * sineView, 1e-12));
  }
}

TEST(TangentSlab, StaysInItsRangesForAnyMap) {
  const f32::vec3 up(0, 0, 1);
  const f32::vec3 aside(1, 0, 0);
  for (const float through : {-1.0f, 0.0f, 1e-30f, 5.0f, 1e30f}) {
    for (const float depth : {-2.0f, 0.0f, 3.0f, 1e30f}) {
      for (const f32::vec3 normal : {up, -up, aside, f32::vec3(0.6f, 0, 0.8f)}) {
        for (const f32::vec3 eye : {up, -up, aside, -aside}) {
          const f32::TangentSlab slab = f32::tangentSlab(through, depth, normal, up, eye);
          EXPECT_GE(slab.thickness, 0.0f);
          EXPECT_GE(slab.depth, 0.0f);
          EXPECT_LE(slab.depth, slab.thickness);
          EXPECT_GE(slab.muLight, f32::CANONICAL_COSINE);
          EXPECT_LE(slab.muLight, 1.0f);
          EXPECT_LE(std::abs(slab.muView), 1.0f);
          EXPECT_GE(slab.phi, 0.0f);
          EXPECT_LE(slab.phi, 3.1415928f);
        }
      }
    }
  }
}

}  // namespace
