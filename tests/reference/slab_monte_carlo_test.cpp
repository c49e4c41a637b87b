// SPDX-License-Identifier: MIT
#include "reference/slab_monte_carlo.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace welkin::reference {
namespace {

constexpr double PI = std::numbers::pi;
constexpr double ERRORS = 3;  // combined standard errors; seeds are fixed

double cosDegrees(double angle) {
  return std::cos(angle * PI / 180);
}

// Three codes by other authors agree on these within their own errors: a delta-tracking program of
// 60 lines, Blender Cycles 3.4 and I3RC. Albedo 1, sun at zenith angle 50, view at 30, azimuths 90
// degrees apart, reflected.
struct Published {
  double tau, g;
  uint32_t lastOrder;
  double value, error;
  uint64_t samples;
};

class SlabPublished : public testing::TestWithParam<Published> {};

TEST_P(SlabPublished, AgreesWithOtherCodes) {
  const Published& p = GetParam();
  const SlabEstimate estimate =
      slabRadianceMonteCarlo(p.tau, 1, PhaseFunction::henyeyGreenstein(p.g), cosDegrees(50),
                             cosDegrees(30), PI / 2, p.samples, 1, 1, p.lastOrder);
  EXPECT_NEAR(estimate.value, p.value, ERRORS * std::hypot(p.error, estimate.standardError));
  // The test means something.
  EXPECT_LT(estimate.standardError, 0.01 * p.value);
}

INSTANTIATE_TEST_SUITE_P(MonteCarloReference, SlabPublished,
                         testing::Values(Published{4, 0.85, 1, 0.002158, 1e-6, 400000},
                                         Published{4, 0.85, 2, 0.004661, 8e-6, 600000},
                                         Published{4, 0.85, ALL_ORDERS, 0.05104, 9e-5, 300000},
                                         Published{1, 0.5, ALL_ORDERS, 0.04263, 3e-5, 500000},
                                         Published{4, -0.3, ALL_ORDERS, 0.15305, 7e-5, 300000},
                                         Published{16, 0.85, ALL_ORDERS, 0.12476, 22e-5, 100000}));

TEST(SlabMonteCarlo, SingleScatteringIsItsClosedForm) {
  // omega P(c) / (mu + mu0) mu0 (1 - e^-tau(1/mu + 1/mu0)) reflected; transmitted likewise.
  const double tau = 1.5;
  const double mu0 = 0.6;
  const double albedo = 0.8;
  const PhaseFunction phase = PhaseFunction::henyeyGreenstein(0.7);
  for (const double mu : {0.9, 0.3, -0.3, -0.9}) {
    for (const double phi : {0.0, 2.0}) {
      const double cosine = -mu0 * mu + std::sqrt((1 - mu0 * mu0) * (1 - mu * mu)) * std::cos(phi);
      const double p = albedo * phase.value(0, 1 - cosine);
      const double m = std::fabs(mu);
      const double expected =
          mu > 0 ? p * mu0 / (mu0 + m) * -std::expm1(-tau * (1 / m + 1 / mu0))
                 : p * mu0 / (mu0 - m) * (std::exp(-tau / mu0) - std::exp(-tau / m));
      const SlabEstimate estimate =
          slabRadianceMonteCarlo(tau, albedo, phase, mu0, mu, phi, 100000, 5, 1, 1);
      EXPECT_NEAR(estimate.value, expected, ERRORS * estimate.standardError) << mu << " " << phi;
      EXPECT_LT(estimate.standardError, 0.01 * expected);
    }
  }
}

TEST(SlabMonteCarlo, WithoutAbsorptionAllLightComesOut) {
  for (const double g : {0.85, -0.3}) {
    const PhaseFunction phase = PhaseFunction::henyeyGreenstein(g);
    const double mu0 = 0.64;
    const SlabEstimate up = slabFluxMonteCarlo(4, 1, phase, mu0, 1, 40000, 1);
    const SlabEstimate down = slabFluxMonteCarlo(4, 1, phase, mu0, -1, 40000, 2);
    EXPECT_NEAR(up.value + down.value + std::exp(-4 / mu0), 1,
                ERRORS * std::hypot(up.standardError, down.standardError));
    EXPECT_LT(up.standardError + down.standardError, 0.02);
  }
}

TEST(SlabMonteCarlo, IsReciprocal) {
  // I(mu; mu0) / mu0 = I(mu0; mu) / mu.
  const PhaseFunction phase = PhaseFunction::henyeyGreenstein(0.8);
  const SlabEstimate there = slabRadianceMonteCarlo(6, 0.98, phase, 0.3, 0.9, 1, 80000, 3);
  const SlabEstimate back = slabRadianceMonteCarlo(6, 0.98, phase, 0.9, 0.3, 1, 80000, 4);
  EXPECT_NEAR(there.value / 0.3, back.value / 0.9,
              ERRORS * std::hypot(there.standardError / 0.3, back.standardError / 0.9));
  EXPECT_LT(there.standardError, 0.02 * there.value);
}

TEST(SlabMonteCarlo, NothingScattersInNothing) {
  EXPECT_EQ(slabRadianceMonteCarlo(0, 1, PhaseFunction::isotropic(), 0.5, 0.5, 0, 10, 1).value, 0);
  EXPECT_EQ(slabRadianceMonteCarlo(2, 0, PhaseFunction::isotropic(), 0.5, 0.5, 0, 10, 1).value, 0);
}

}  // namespace
}  // namespace welkin::reference
