// SPDX-License-Identifier: MIT
// Light scattered at least once in plane-parallel layers, against the reference's discrete
// ordinates of a homogeneous slab (more streams, exact in depth, own text). Relative errors, no
// unit.
#include "tables/fog_slab.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <sstream>
#include <string>

#include "reference/slab_solver.hpp"

namespace {

namespace ref = welkin::reference;
using welkin::FOG_TERMS;
using welkin::FogBeam;
using welkin::FogCell;
using welkin::FogField;
using welkin::FogSlab;
using welkin::FogTermsOf;

constexpr double PI = 3.14159265358979323846;

// A homogeneous slab in cells that are fine at both faces.
struct Slab {
  std::vector<double> edges;
  std::vector<FogCell> cells;
};

Slab slabOf(double depth, size_t count, const FogCell& like) {
  const double bend = std::log(1 + 2 * depth);
  Slab slab;
  for (size_t k = 0; k <= count; ++k) {
    const double x = 2 * static_cast<double>(k) / static_cast<double>(count) - 1;
    slab.edges.push_back(0.5 * depth * (1 + std::asinh(std::sinh(bend) * x) / bend));
  }
  for (size_t k = 0; k < count; ++k) {
    slab.cells.push_back({slab.edges[k + 1] - slab.edges[k], like.air, like.fog});
  }
  return slab;
}

FogBeam beamOf(const Slab& slab, double sunMu) {
  FogBeam beam;
  beam.sunMu = sunMu;
  for (size_t k = 0; k < slab.cells.size(); ++k) {
    const double slant = slab.cells[k].depth / sunMu;
    beam.irradiance.push_back(std::exp(-slab.edges[k] / sunMu) * -std::expm1(-slant) / slant);
  }
  beam.atGround = std::exp(-slab.edges.back() / sunMu);
  return beam;
}

// Henyey and Greenstein's moments without the peak of the 16th, whose share is `peak`.
FogTermsOf fogTerms(double g, double peak) {
  FogTermsOf terms{};
  for (size_t l = 0; l < FOG_TERMS; ++l) {
    terms[l] = (std::pow(g, l) - peak) / (1 - peak);
  }
  return terms;
}

// Source of the scattering of a field into a direction: integral of P times radiance.
double scatteredOf(const FogField& field, const FogTermsOf& terms, double mu, double azimuth) {
  double sum = 0;
  for (size_t m = 0; m < FOG_TERMS; ++m) {
    const FogTermsOf p = welkin::legendreOf(m, mu);
    double mode = 0;
    for (size_t l = m; l < FOG_TERMS; ++l) {
      mode += static_cast<double>(2 * l + 1) * terms[l] * p[l - m] * field.at(l, m);
    }
    sum += (m > 0 ? 2 : 1) * mode * std::cos(static_cast<double>(m) * azimuth);
  }
  return sum;
}

struct Errors {
  double mean = 0;
  double worst = 0;
};

struct Fog {
  double g = 0;
  double depth = 0;
  double ground = 0;
};

// Radiance of all orders that leaves fog which absorbs nothing. The beam's own scattering is that
// of the whole phase function (Nakajima and Tanaka 1988, TMS).
Errors errorsOf(const Fog& fog, double sunMu, size_t count) {
  const double peak = std::pow(fog.g, FOG_TERMS);
  const FogTermsOf terms = fogTerms(fog.g, peak);
  const Slab slab = slabOf(fog.depth * (1 - peak), count, {0, 0, 1});
  const FogBeam beam = beamOf(slab, sunMu);
  const std::vector<FogField> field = FogSlab(slab.cells, terms, fog.ground).solve({beam})[0];
  const ref::SlabPhase phase = ref::henyeyGreensteinSlabPhase(fog.g);
  const ref::SlabSolver truth(phase, 1, 24);
  const ref::SlabFlux flux = truth.flux(fog.depth, sunMu, fog.depth, fog.ground);
  Errors errors;
  size_t views = 0;
  for (const double mu : {-0.95, -0.6, -0.2, 0.2, 0.6, 0.95}) {
    for (const double azimuth : {0.0, PI / 2, PI}) {
      const double sines = std::sqrt((1 - mu * mu) * (1 - sunMu * sunMu));
      const double first = phase.value(1 + mu * sunMu - sines * std::cos(azimuth)) / (1 - peak);
      const double slope = std::abs(mu);
      double sum = mu > 0 ? std::exp(-slab.edges.back() / slope) * fog.ground / PI *
                                (flux.down + flux.direct)
                          : 0;
      for (size_t k = 0; k < count; ++k) {
        const double source =
            scatteredOf(field[k], terms, mu, azimuth) + first * beam.irradiance[k];
        const double before = mu > 0 ? slab.edges[k] : slab.edges.back() - slab.edges[k + 1];
        sum += source * std::exp(-before / slope) * -std::expm1(-slab.cells[k].depth / slope);
      }
      const double right =
          truth.radiance(fog.depth, sunMu, {mu, azimuth, ref::SlabView::FACE}, fog.ground).total;
      const double error = std::abs(sum / right - 1);
      errors.worst = std::max(errors.worst, error);
      errors.mean += error;
      ++views;
    }
  }
  errors.mean /= static_cast<double>(views);
  return errors;
}

// For the test runner's messages.
void PrintTo(const Fog& fog, std::ostream* stream) {
  *stream << "g " << fog.g << ", depth " << fog.depth << ", ground " << fog.ground;
}

class FogSlabTruth : public testing::TestWithParam<Fog> {};

// Bounds: 16 terms leave 0.5 % of light scattered twice or more in a peak of g = 0.85 and 5 % of it
// in single directions; cells, 32 here, the square of their depth over the streams' cosines.
TEST_P(FogSlabTruth, LeavesAsMuchLightAsTheReference) {
  const Fog fog = GetParam();
  for (const double sunMu : {0.15, 0.6, 1.0}) {
    const double slant = fog.depth / sunMu;
    const double cells = 2e-4 * slant;
    const Errors errors = errorsOf(fog, sunMu, 32);
    EXPECT_LT(errors.mean, 0.01 + cells) << sunMu;
    EXPECT_LT(errors.worst, 0.05 + 4 * cells) << sunMu;
  }
}

std::string fogName(const testing::TestParamInfo<Fog>& info) {
  std::ostringstream name;
  name << "g" << std::lround(100 * info.param.g) << "Depth" << std::lround(100 * info.param.depth)
       << "Ground" << std::lround(100 * info.param.ground);
  return name.str();
}

INSTANTIATE_TEST_SUITE_P(Fogs, FogSlabTruth,
                         testing::Values(Fog{0, 0.1, 0}, Fog{0, 1, 0.3}, Fog{0, 4, 0},
                                         Fog{0.75, 1, 0}, Fog{0.75, 16, 0.3}, Fog{0.85, 0.1, 0},
                                         Fog{0.85, 1, 0.3}, Fog{0.85, 4, 0.8}, Fog{0.85, 16, 0}),
                         fogName);

TEST(FogSlab, ErrorFallsWithTheSquareOfTheCells) {
  const Fog thick{0.5, 16, 0};
  const double coarse = errorsOf(thick, 0.6, 24).mean;
  const double fine = errorsOf(thick, 0.6, 48).mean;
  EXPECT_GT(coarse, 5e-3);
  EXPECT_LT(fine, coarse / 3.2);  // 4 in the limit
}

// Air's phase function is the sum of its terms: nothing is left out.
TEST(FogSlab, AirScattersAsRayleigh) {
  constexpr double DEPTH = 0.5;
  constexpr double SUN = 0.4;
  const Slab slab = slabOf(DEPTH, 32, {0, 0.9, 0});
  const std::vector<FogField> field =
      FogSlab(slab.cells, fogTerms(0.5, 0), 0.2).solve({beamOf(slab, SUN)})[0];
  const ref::SlabSolver truth(ref::rayleighSlabPhase(), 0.9, 24);
  for (const size_t k : {size_t{4}, size_t{16}, size_t{27}}) {
    const double depth = 0.5 * (slab.edges[k] + slab.edges[k + 1]);
    const ref::SlabFlux flux = truth.flux(DEPTH, SUN, depth, 0.2);
    const double net = 4 * PI * field[k].at(1, 0);
    EXPECT_NEAR(net, flux.up - flux.down, 1e-3 * (flux.up + flux.down)) << k;
  }
}

// Where nothing absorbs, the same light passes through every edge between cells: what the ground
// takes. Bound: rounding of sums of a few hundred terms.
TEST(FogSlab, KeepsEnergy) {
  constexpr double ROUNDING = 1e-10;
  constexpr double SUN = 0.3;
  for (const double ground : {0.0, 0.5, 1.0}) {
    const Slab slab = slabOf(20, 40, {0, 0.2, 0.8});
    const std::vector<FogField> field =
        FogSlab(slab.cells, fogTerms(0.8, 0), ground).solve({beamOf(slab, SUN)})[0];
    double lowest = INFINITY;
    double highest = -INFINITY;
    for (size_t k = 0; k < field.size(); ++k) {
      const double straight =
          0.5 * SUN * (std::exp(-slab.edges[k] / SUN) + std::exp(-slab.edges[k + 1] / SUN));
      const double down = straight - 4 * PI * field[k].at(1, 0);
      lowest = std::min(lowest, down);
      highest = std::max(highest, down);
    }
    EXPECT_LT(highest - lowest, ROUNDING) << ground;
    EXPECT_GT(lowest, ground < 1 ? 1e-3 : -ROUNDING) << ground;
    EXPECT_LT(highest, ground < 1 ? SUN : ROUNDING) << ground;
  }
}

// Several beams at once are those alone.
TEST(FogSlab, BeamsDoNotMix) {
  const Slab slab = slabOf(3, 16, {0, 0.1, 0.8});
  const FogSlab fog(slab.cells, fogTerms(0.7, 0), 0.1);
  const auto both = fog.solve({beamOf(slab, 0.2), beamOf(slab, 0.9)});
  const auto alone = fog.solve({beamOf(slab, 0.9)});
  for (size_t l = 0; l < FOG_TERMS; ++l) {
    EXPECT_DOUBLE_EQ(both[1][7].at(l, 0), alone[0][7].at(l, 0)) << l;
    EXPECT_NE(both[0][7].at(l, 0), alone[0][7].at(l, 0)) << l;
  }
}

}  // namespace
