// SPDX-License-Identifier: MIT
// The source image of surface clouds against the canonical table that it is made from.
#include "tables/surface_source.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

namespace {

using namespace welkin;

const CanonicalTable& table() {
  static const CanonicalTable decoded = decodeCanonical(shippedCanonical());
  return decoded;
}

const SurfaceSource& source() {
  static const SurfaceSource made = surfaceSource(table());
  return made;
}

// T over a stretch of the ray inside the slab: what J along it adds up to.
TEST(SurfaceSource, AddsUpToTheTableAlongARay) {
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<double> errors;
  while (errors.size() < 3000) {
    const double thickness = std::exp(std::log(0.2) + uniform(generator) * std::log(300.0));
    const double muLight = 0.1 + 0.9 * uniform(generator);
    const double phi = 3.14159 * uniform(generator);
    const double mu = (0.15 + 0.85 * uniform(generator)) * (uniform(generator) < 0.5 ? -1 : 1);
    const size_t set = generator() % CANONICAL_SETS;
    const double stretch = std::min(1.0, 0.5 * thickness / std::abs(mu));
    const double room = thickness - stretch * std::abs(mu);
    const double first = uniform(generator) * room + (mu < 0 ? stretch * -mu : 0);
    const auto at = [&](double depth) {
      return table().transport(set, {thickness, depth, mu, phi, muLight}).radiance;
    };
    const double begin = at(first);
    const double truth = at(first + mu * stretch) - begin * std::exp(-stretch);
    double sum = 0;
    constexpr int STEPS = 16;
    for (int i = 0; i < STEPS; ++i) {
      const double s = stretch * (i + 0.5) / STEPS;
      sum += stretch / STEPS * std::exp(s - stretch) *
             surfaceSourceAt(source(), set, {thickness, first + mu * s, muLight, mu, phi});
    }
    // Where it matters: above 2 % of a white sheet's radiance per depth, over the sets.
    if (truth > 1e-3 * muLight * stretch) {
      errors.push_back(std::abs(sum / truth - 1));
    }
  }
  std::sort(errors.begin(), errors.end());
  const double median = errors[errors.size() / 2];
  const double p90 = errors[errors.size() * 9 / 10];
  std::printf("median %.3f, p90 %.3f\n", median, p90);
  // Linear filters in five axes leave 0.02 to 0.06 rms each, 0.1 together; a third of margin.
  EXPECT_LE(median, 0.08);
  EXPECT_LE(p90, 0.18);
}

TEST(SurfaceSource, IsFiniteAndPositiveForAnySlab) {
  for (const float value : source().values) {
    ASSERT_TRUE(std::isfinite(value));
  }
  for (const double thickness : {1e-30, 1e-3, 0.1, 7.0, 500.0, 1e30}) {
    for (const double part : {0.0, 0.3, 1.0}) {
      for (const double muView : {-1.0, -1e-9, 0.0, 0.4, 1.0}) {
        for (const double muLight : {1e-3, 0.5, 1.0}) {
          for (size_t set = 0; set < CANONICAL_SETS; ++set) {
            const double j =
                surfaceSourceAt(source(), set, {thickness, thickness * part, muLight, muView, 2});
            EXPECT_TRUE(std::isfinite(j));
            EXPECT_GE(j, 0);
            EXPECT_LE(j, 10);
          }
        }
      }
    }
  }
}

}  // namespace
