// SPDX-License-Identifier: MIT
// Media: kinds, parameters and mean cosines.
#include "particles/medium.hpp"

#include <gtest/gtest.h>
#include <welkin/welkin.h>

#include <cmath>

#include "reference/phase_reference.hpp"

namespace {

using namespace welkin;
using reference::Real;

constexpr double EPS_FLOAT = 0x1p-24;

static_assert(static_cast<uint32_t>(PhaseKind::HgDraine) == WLK_PHASE_HG_DRAINE);
static_assert(static_cast<uint32_t>(PhaseKind::HenyeyGreenstein) == WLK_PHASE_HENYEY_GREENSTEIN);
static_assert(static_cast<uint32_t>(PhaseKind::Rayleigh) == WLK_PHASE_RAYLEIGH);

double yOf(Real theta) {
  const Real s = std::sin(theta / 2);
  return static_cast<double>(2 * s * s);
}

TEST(Medium, EveryKindEvaluatesItsOwnPhaseFunction) {
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

TEST(Medium, MeanCosineMatchesQuadrature) {
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

TEST(Medium, FloatParametersAreTheDoublesRoundedOnce) {
  for (double d = 5; d <= 50; d += 0.37) {
    const FogPhaseParams p = phaseParameters(PhaseKind::HgDraine, d, 0);
    const FogPhaseParamsF q = phaseParametersF(PhaseKind::HgDraine, d, 0);
    EXPECT_LE(std::abs(static_cast<double>(q.gapHg) / p.gapHg - 1), EPS_FLOAT);
    EXPECT_LE(std::abs(static_cast<double>(q.gHg) / p.gHg - 1), EPS_FLOAT);
    EXPECT_LE(std::abs(static_cast<double>(q.gapD) / p.gapD - 1), EPS_FLOAT);
    EXPECT_LE(std::abs(static_cast<double>(q.weightD) / p.weightD - 1), EPS_FLOAT);
  }
}

TEST(Medium, MakeMediumKeepsWhatItWasGiven) {
  const double albedo[3] = {0.9, 0.95, 1.0};
  const Medium m = makeMedium(PhaseKind::HgDraine, 14, 0.3, albedo);
  EXPECT_EQ(m.kind, PhaseKind::HgDraine);
  EXPECT_EQ(m.dropletDiameter_um, 14);
  EXPECT_EQ(m.asymmetry, 0.3);
  EXPECT_EQ(m.albedo[0], 0.9);
  EXPECT_EQ(m.albedo[2], 1.0);
  EXPECT_EQ(m.phase.gHg, phaseParameters(PhaseKind::HgDraine, 14, 0).gHg);
  EXPECT_EQ(m.phaseF.gapHg, static_cast<float>(m.phase.gapHg));
}

TEST(Medium, GapIsHeldWithoutCancellation) {
  const FogPhaseParams p = phaseParameters(PhaseKind::HgDraine, 50, 0);
  const double truth = static_cast<double>(-std::expm1(-0.0990567L / (50 - 1.67154L)));
  EXPECT_NEAR(p.gapHg / truth, 1, 1e-14);
}

}  // namespace
