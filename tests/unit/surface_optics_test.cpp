// SPDX-License-Identifier: MIT
// Media as cloud surfaces count them: the peak and the rest are the phase function, energy and
// similarity hold.
#include "surface/surface_optics.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tables/canonical_table.hpp"

namespace welkin {
namespace {

double canonicalAsymmetry() {
  static const double asymmetry = decodeCanonical(shippedCanonical()).asymmetry;
  return asymmetry;
}

Medium droplets(double diameter_um, double albedo) {
  ParticleParams params;
  params.diameter_um = diameter_um;
  params.spread = 0.25;
  return makeMedium(ParticleType::Cloud, params, {albedo, albedo, albedo});
}

TEST(SurfaceOptics, PeakAndRestAreTheWhole) {
  const Medium medium = droplets(12, 1);
  const SurfaceOptics optics = surfaceOptics(medium, canonicalAsymmetry());
  const PhaseCurve& curve = medium.particle->curve;
  const double kept = optics.smooth / optics.whole;  // 1 - f of a medium that absorbs nothing
  EXPECT_GT(kept, 0.45);
  EXPECT_LT(kept, 0.75);
  double energy = 0;
  for (size_t i = 0; i < kCurveNodes; ++i) {
    for (size_t c = 0; c < RGB; ++c) {
      const double smooth = static_cast<double>(optics.curve[i][c]);
      const double peak = static_cast<double>(optics.curve[kCurveNodes + i][c]);
      EXPECT_NEAR(kept * smooth + peak, curve.value[c][i], 2e-7 * curve.value[c][i]);
      if (curve.y[i] > 1 - std::cos(5.01 * 3.14159265358979 / 180)) {
        EXPECT_EQ(peak, 0);
      }
      if (i > 0) {
        const double before = static_cast<double>(optics.curve[i - 1][c]);
        energy += 3.14159265358979 * (smooth + before) * (curve.y[i] - curve.y[i - 1]) / RGB;
      }
    }
  }
  EXPECT_NEAR(energy, 1, 1e-5);  // 2048 roundings to floats, and the cut's kink between two nodes
}

// The paper's cloud is nearly the canonical one: both count its depth alike.
TEST(SurfaceOptics, CloudIsNearlyCanonical) {
  const SurfaceOptics optics = surfaceOptics(droplets(12, 1), canonicalAsymmetry());
  EXPECT_NEAR(optics.canonical / optics.smooth, 1, 0.1);
  for (const auto& set : optics.orders) {
    EXPECT_EQ(set[0], 1);
  }
}

// (1 - g) depth of Henyey-Greenstein; absorption is not scaled.
TEST(SurfaceOptics, KeepsWhatDiffusionDependsOn) {
  ParticleParams params;
  params.asymmetry = 0.6;
  const Medium medium = makeMedium(ParticleType::HenyeyGreenstein, params, {0.9, 0.9, 0.9});
  const SurfaceOptics optics = surfaceOptics(medium, canonicalAsymmetry());
  const double scattering = 0.9 * (1 - 0.6) / (1 - canonicalAsymmetry());
  EXPECT_NEAR(optics.canonical, scattering + 0.1, 1e-6);
  EXPECT_NEAR(optics.orders[1][2], std::pow(scattering / (scattering + 0.1), 3), 1e-6);
  EXPECT_LE(optics.albedo[0], 0.9);
  for (size_t set = 1; set < CANONICAL_SETS; ++set) {
    EXPECT_LT(optics.orders[set][0], optics.orders[set - 1][0]);
  }
}

}  // namespace
}  // namespace welkin
