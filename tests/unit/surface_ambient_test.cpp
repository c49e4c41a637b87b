// SPDX-License-Identifier: MIT
// Diffuse light on slabs of cloud: limits that hold for any phase function, and the slab solver's
// answer for light from one side.
#include "tables/surface_ambient.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

namespace welkin {
namespace {

const CanonicalTable& canonical() {
  static const CanonicalTable table = decodeCanonical(shippedCanonical());
  return table;
}

const SurfaceAmbient& table() {
  static const SurfaceAmbient made =
      surfaceAmbient(surfaceSource(canonical()), canonical().asymmetry);
  return made;
}

// Equal light from both sides is light from everywhere.
TEST(SurfaceAmbient, BothSidesMakeTheWhole) {
  for (const double t : {0.01, 0.5, 4.0, 50.0, 900.0}) {
    for (const double share : {0.0, 0.1, 0.5, 0.9, 1.0}) {
      for (const double mu : {-1.0, -0.3, 0.2, 1.0}) {
        const double one = surfaceAmbientAt(table(), t, share * t, mu);
        const double other = surfaceAmbientAt(table(), t, (1 - share) * t, -mu);
        EXPECT_NEAR(one + other, 1, 1e-5) << t << ' ' << share << ' ' << mu;
        EXPECT_GE(one, 0);
      }
    }
  }
}

// Thick slabs: next to the face the light of its side, deep inside half way down half of each, as
// diffusion has it: 1 - (d + q) / (t + 2 q), q = 0.71 / (1 - g).
TEST(SurfaceAmbient, DiffusesThroughThickSlabs) {
  const double q = 0.7104 / (1 - canonical().asymmetry);
  constexpr double T = 200;
  // Linear filters between nodes that lie up to a fifth of the slab apart.
  constexpr double FILTER = 0.03;
  for (const double d : {20.0, 60.0, 100.0, 140.0, 180.0}) {
    double mean = 0;
    for (int i = 0; i < 40; ++i) {
      mean += surfaceAmbientAt(table(), T, d, (2 * i + 1) / 40.0 - 1) / 40;
    }
    EXPECT_NEAR(mean, 1 - (d + q) / (T + 2 * q), FILTER) << d;
  }
}

// A thin slab scatters forwards: looking up against the light from above is bright, away from it
// dark.
TEST(SurfaceAmbient, ThinSlabsScatterForwards) {
  EXPECT_GT(surfaceAmbientAt(table(), 0.01, 0.005, 1), 0.9);
  EXPECT_LT(surfaceAmbientAt(table(), 0.01, 0.005, -1), 0.1);
}

}  // namespace
}  // namespace welkin
