// SPDX-License-Identifier: MIT
// Phase functions in closed form: kinds, parameters and mean cosines.
#include "particles/fog_phase.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "reference/phase_reference.hpp"

namespace {

using namespace welkin;
using reference::Real;

double yOf(Real theta) {
  const Real s = std::sin(theta / 2);
  return static_cast<double>(2 * s * s);
}

TEST(FogPhaseParams, EveryKindEvaluatesItsOwnPhaseFunction) {
  const reference::Fog fog(12);
  for (const Real theta : {0.0L, 0.01L, 0.5L, 1.6L, 2.9L}) {
    const Real c = std::cos(theta);
    const double y = yOf(theta);
    const auto value = [&](PhaseKind kind) { return evalPhase(phaseParameters(kind, 12, 0.7), y); };
    const double rounding = 1e-14;  // some 40 roundings of double
    EXPECT_NEAR(value(PhaseKind::HgDraine) / static_cast<double>(fog(c)), 1, rounding);
    EXPECT_NEAR(value(PhaseKind::HenyeyGreenstein) /
                    static_cast<double>(reference::henyeyGreenstein(0.7, c)),
                1, rounding);
    EXPECT_NEAR(value(PhaseKind::Rayleigh) / static_cast<double>(reference::rayleigh(c)), 1,
                rounding);
  }
}

TEST(FogPhaseParams, MeanCosineMatchesQuadrature) {
  std::vector<FogPhaseParams> all = {phaseParameters(PhaseKind::Rayleigh, 0, 0)};
  for (const double d : {5.0, 11.0, 27.0, 50.0}) {
    all.push_back(phaseParameters(PhaseKind::HgDraine, d, 0));
  }
  for (const double g : {-0.8, 0.0, 0.5, 0.97}) {
    all.push_back(phaseParameters(PhaseKind::HenyeyGreenstein, 0, g));
  }
  for (const FogPhaseParams& p : all) {
    const Real truth = reference::integrateSphere(
        [&](Real theta) { return std::cos(theta) * static_cast<Real>(evalPhase(p, yOf(theta))); });
    const double quadrature = 1e-9;
    EXPECT_NEAR(meanCosine(p), static_cast<double>(truth), quadrature);
  }
}

TEST(FogPhaseParams, GapIsHeldWithoutCancellation) {
  const FogPhaseParams p = phaseParameters(PhaseKind::HgDraine, 50, 0);
  const double truth = static_cast<double>(-std::expm1(-0.0990567L / (50 - 1.67154L)));
  EXPECT_NEAR(p.gapHg / truth, 1, 1e-14);
}

}  // namespace
