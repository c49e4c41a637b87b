// SPDX-License-Identifier: MIT
#include "particles/diameter_nodes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>

namespace welkin {
namespace {

Medium mediumOf(ParticleType type, double diameter_um, bool analytic = false) {
  const ParticleKind& kind = particleKind(type);
  ParticleParams params;
  params.diameter_um = diameter_um;
  params.spread = kind.spread.initial;
  params.analytic = analytic;
  return makeMedium(type, params, {1, 1, 1});
}

TEST(DiameterNodes, PlacesAreEvenInTheLogarithm) {
  const DiameterNodes nodes = makeDiameterNodes(mediumOf(ParticleType::Cloud, 20));
  constexpr double LAST = DIAMETER_NODES - 1;
  EXPECT_DOUBLE_EQ(nodes.place(5), 0);
  EXPECT_DOUBLE_EQ(nodes.place(50), LAST);
  EXPECT_NEAR(nodes.place(std::sqrt(5.0 * 50)), LAST / 2, 1e-12);
  EXPECT_DOUBLE_EQ(nodes.place(1), 0);
  EXPECT_DOUBLE_EQ(nodes.place(1e30), LAST);
  const double own = nodes.place(20);
  for (const double none : {0.0, -3.0, double(NAN), double(INFINITY)}) {
    EXPECT_DOUBLE_EQ(nodes.place(none), own) << none;
  }
}

TEST(DiameterNodes, BetweenThemTheMeanIsNear) {
  struct Case {
    ParticleType type;
    bool analytic;
    double bound;
  };
  for (const Case& test :
       {Case{ParticleType::Cloud, false, 0.01}, Case{ParticleType::Cloud, true, 0.01},
        Case{ParticleType::Rain, false, 0.01}, Case{ParticleType::Haze, false, 0.02},
        Case{ParticleType::Fog, false, 0.03}}) {
    const Medium medium =
        mediumOf(test.type, particleKind(test.type).diameter_um.initial, test.analytic);
    const DiameterNodes nodes = makeDiameterNodes(medium);
    double worst = 0;
    double sum = 0;
    int count = 0;
    for (size_t i = 0; i + 1 < DIAMETER_NODES; ++i) {
      const double ratio = std::pow(nodes.high_um / nodes.low_um, 1 / (DIAMETER_NODES - 1.0));
      const double diameter = nodes.low_um * std::pow(ratio, static_cast<double>(i) + 0.5);
      const Particle truth = *mediumOf(test.type, diameter, test.analytic).particle;
      for (size_t c = 0; c < RGB; ++c) {
        for (int k = 0; k <= 360; ++k) {
          const double angle = k * std::numbers::pi / 360;
          const double mean = std::sqrt(evalParticle(nodes.particles[i], c, angle) *
                                        evalParticle(nodes.particles[i + 1], c, angle));
          const double error = std::abs(mean / evalParticle(truth, c, angle) - 1);
          worst = std::max(worst, error);
          sum += error * error;
          ++count;
        }
      }
    }
    std::printf("%s%s: rms %.3f %%, worst %.2f %%\n", particleKind(test.type).name,
                test.analytic ? ", closed form" : "", 100 * std::sqrt(sum / count), 100 * worst);
    EXPECT_LT(std::sqrt(sum / count), test.bound) << particleKind(test.type).name;
  }
}

TEST(DiameterNodes, ExtinctionIsThatOfTheMassOfWater) {
  const DiameterNodes nodes = makeDiameterNodes(mediumOf(ParticleType::Fog, 10));
  for (const double diameter : {0.5, 3.0, 8.0, 21.0, 45.0}) {
    const Particle p = *mediumOf(ParticleType::Fog, diameter).particle;
    const auto& q = p.optics.efficiency;
    const double radius = p.optics.effectiveRadius_um * 1e-6;
    const double truth = 0.75 * (q[0] + q[1] + q[2]) / 3 / (999.7 * radius);
    EXPECT_NEAR(nodes.extinctionPerMass(diameter) / truth, 1, 0.02) << diameter;
  }
}

TEST(DiameterNodes, AreOfDropletsWithTheTablesSpread) {
  EXPECT_TRUE(variesInDiameter(mediumOf(ParticleType::Haze, 1)));
  EXPECT_FALSE(variesInDiameter(mediumOf(ParticleType::Air, 0)));
  EXPECT_FALSE(variesInDiameter(mediumOf(ParticleType::IcePlate, 0)));
  ParticleParams narrow;
  narrow.diameter_um = 10;
  narrow.spread = 0.1;
  EXPECT_FALSE(variesInDiameter(makeMedium(ParticleType::Cloud, narrow, {1, 1, 1})));
}

}  // namespace
}  // namespace welkin
