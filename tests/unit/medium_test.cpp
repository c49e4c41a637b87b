// SPDX-License-Identifier: MIT
// src/particles/medium: what volumes take off for light that goes straight on.
#include "particles/medium.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace welkin;

constexpr double ROUNDING = 1e-14;

Medium rain(double diameter_um, const std::array<double, RGB>& albedo) {
  ParticleParams params;
  params.diameter_um = diameter_um;
  params.spread = 0.25;
  return makeMedium(ParticleType::Rain, params, albedo);
}

// Colours go straight on to different parts (0.36 to 0.41 at 100 um); what does not absorb must not
// begin to.
TEST(Medium, WhiteParticlesStayWhite) {
  for (const double d : {100.0, 300.0, 2000.0}) {
    for (const double albedo : rain(d, {1, 1, 1}).scaledAlbedo()) {
      EXPECT_NEAR(albedo, 1, ROUNDING) << d;
    }
  }
}

// extinction' - scattering' is the absorption, whatever goes straight on.
TEST(Medium, AbsorptionOfGreyParticlesIsKept) {
  for (const double grey : {0.0, 0.3, 0.9, 1.0}) {
    const Medium medium = rain(500, {grey, grey, grey});
    const double extinction = medium.extinctionFactor();
    for (const double albedo : medium.scaledAlbedo()) {
      EXPECT_NEAR(extinction * (1 - albedo), 1 - grey, ROUNDING) << grey;
    }
    EXPECT_LE(extinction, 1);
    EXPECT_GE(extinction, 0.5);
  }
}

TEST(Medium, ParticlesWithoutADeltaPartKeepExtinctionAndAlbedo) {
  ParticleParams params;
  params.diameter_um = 10;
  params.spread = 0.25;
  const Medium medium = makeMedium(ParticleType::Fog, params, {0.9, 0.8, 0.7});
  EXPECT_EQ(medium.extinctionFactor(), 1);
  EXPECT_EQ(medium.scaledAlbedo(), (std::array<double, RGB>{0.9, 0.8, 0.7}));
}

}  // namespace
