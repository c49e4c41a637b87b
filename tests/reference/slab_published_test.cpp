// SPDX-License-Identifier: MIT
// The Monte Carlo renderer against published slabs, each value within 3 standard errors plus half a
// unit of the last printed digit. docs/accuracy-and-performance.md lists the sources.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "reference/slab_benchmarks.hpp"
#include "reference/slab_monte_carlo.hpp"
#include "reference/slab_solver.hpp"

namespace welkin::reference {
namespace {

constexpr double PI = std::numbers::pi;
constexpr double ERRORS = 3;
constexpr double MEANINGFUL = 0.01;  // a larger relative standard error would show nothing
constexpr double FIFTH_DECIMAL = 0.5e-5;

void expectPublished(const SlabEstimate& estimate, double scale, double printed, double rounding) {
  EXPECT_NEAR(scale * estimate.value, printed, ERRORS * scale * estimate.standardError + rounding);
  EXPECT_LT(scale * estimate.standardError, MEANINGFUL * printed);
}

TEST(MonteCarloPublished, VanDeHulstTable12) {
  constexpr uint64_t SAMPLES = 150000;
  const PhaseFunction phase = PhaseFunction::isotropic();
  for (const VanDeHulstValue& one : VAN_DE_HULST_12_REFLECTED) {
    SCOPED_TRACE(one.mu);
    expectPublished(slabRadianceMonteCarlo(2, 0.8, phase, one.mu, 0.5, 0, SAMPLES, 1), PI / one.mu,
                    one.value, FIFTH_DECIMAL);
  }
  for (const VanDeHulstValue& one : VAN_DE_HULST_12_TRANSMITTED) {
    SCOPED_TRACE(-one.mu);
    expectPublished(slabRadianceMonteCarlo(2, 0.8, phase, one.mu, -0.5, 0, SAMPLES, 2), PI / one.mu,
                    one.value, FIFTH_DECIMAL);
  }
}

TEST(MonteCarloPublished, VanDeHulstTable35) {
  constexpr uint64_t SAMPLES = 200000;
  const PhaseFunction phase = PhaseFunction::henyeyGreenstein(0.75);
  for (const VanDeHulstValue& one : VAN_DE_HULST_35_REFLECTED) {
    if (one.mu > 0) {  // a ray along the slab's face never leaves it
      SCOPED_TRACE(one.mu);
      expectPublished(slabRadianceMonteCarlo(2, 0.9, phase, 1, one.mu, 0, SAMPLES, 1), PI,
                      one.value, FIFTH_DECIMAL);
    }
  }
  for (const VanDeHulstValue& one : VAN_DE_HULST_35_TRANSMITTED) {
    if (one.mu > 0) {
      SCOPED_TRACE(-one.mu);
      expectPublished(slabRadianceMonteCarlo(2, 0.9, phase, 1, -one.mu, 0, SAMPLES, 2), PI,
                      one.value, FIFTH_DECIMAL);
    }
  }
  expectPublished(slabFluxMonteCarlo(2, 0.9, phase, 1, 1, 60000, 3), 1, VAN_DE_HULST_35_REFLECTANCE,
                  FIFTH_DECIMAL);
  const double direct = std::exp(-2.0);
  expectPublished(slabFluxMonteCarlo(2, 0.9, phase, 1, -1, 60000, 4), 1,
                  VAN_DE_HULST_35_TRANSMITTANCE - direct, FIFTH_DECIMAL);
}

// Haze L, 83 moments: as a table of chords, whose own error stays below a tenth of the noise.
PhaseFunction hazeL() {
  const SlabPhase series = momentSlabPhase(momentsOf(HAZE_L_MOMENTS));
  constexpr int NODES = 4000;
  std::vector<double> angles;
  std::vector<Rgb> values;
  for (int i = 0; i <= NODES; ++i) {
    angles.push_back(PI * i / NODES);
    const double s = std::sin(angles.back() / 2);
    values.push_back(Rgb{});
    values.back().fill(series.value(2 * s * s));
  }
  return PhaseFunction::table(angles, values);
}

void expectHaze(const GarciaSiewertTable& table, double azimuth) {
  constexpr uint64_t SAMPLES = 200000;
  const PhaseFunction phase = hazeL();
  for (const size_t row : {0u, 2u, 5u, 8u, 12u, 15u, 18u, 20u}) {
    const double mu = 1 - 0.1 * static_cast<double>(row);
    const double printed = table[row][row < 10 ? 0 : 6];  // top, bottom
    SCOPED_TRACE(mu);
    expectPublished(slabRadianceMonteCarlo(1, 0.9, phase, 0.5, mu, azimuth, SAMPLES, 5), PI,
                    printed, 1e-6 * printed);
  }
}

TEST(MonteCarloPublished, GarciaAndSiewertTables14And15) {
  for (const GarciaSiewertErratum& one : GARCIA_SIEWERT_ERRATA) {
    // None of those that are compared here is among the wrongly copied ones.
    EXPECT_FALSE(one.table != &GARCIA_SIEWERT_MIE && (one.column == 0 || one.column == 6));
  }
  expectHaze(GARCIA_SIEWERT_HAZE_0, 0);
  expectHaze(GARCIA_SIEWERT_HAZE_90, PI / 2);
}

}  // namespace
}  // namespace welkin::reference
