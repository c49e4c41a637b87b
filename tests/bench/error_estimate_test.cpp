// SPDX-License-Identifier: MIT
// wlkGetErrorEstimate against the errors of the benchmark's scenes, none of which its constants
// were fitted to. Relative RMS errors, no unit.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "bench/error_gate_cases.hpp"

namespace bench {
namespace {

struct Compared {
  std::string name;
  std::string level;
  double measured = 0;  // against all orders
  double slabs = 0;     // against ever thinner slabs; NaN without volumes
  WlkErrorEstimate estimate{};
};

// Of the same slabs and texels with forward scattering, whose limit is no grid's.
double slabsOf(const GateCase& gate, const std::string& level) {
  for (const Measured& measured : gate.levels) {
    if (measured.row.at("level") == "forward-" + level) {
      return measured.slabs;
    }
  }
  return NAN;
}

// Every case without opaque geometry, which the estimate leaves out, at every level that
// test runs measure; those with volumes at one of them also without the light of sky and ground.
const std::vector<Compared>& compareAll() {
  static const std::vector<Compared> all = [] {
    std::vector<Compared> result;
    for (const Case& one : gateCases()) {
      if (sceneOf(one, false).geometry) {
        continue;
      }
      const GateCase& gate = gateCase(one);
      for (const Measured& own : gate.levels) {
        if (own.isLevel) {
          const std::string level = own.row.at("level");
          result.push_back({one.name, level, own.truth, slabsOf(gate, level), own.estimate});
        }
      }
      if (gate.references.converged.picture) {
        const Measured bare = measureBare(one, gate.references);
        result.push_back({one.name, "bare", bare.truth, NAN, bare.estimate});
      }
    }
    return result;
  }();
  return all;
}

TEST(ErrorEstimate, IsWithinAFactorOfTwoForMostScenes) {
  constexpr double USUAL = 2.0;  // what view.h promises for most scenes
  constexpr double WORST = 4.0;
  constexpr double NOISE = 0.01;  // smaller errors are not told from the references' noise
  size_t within = 0;
  size_t rows = 0;
  const std::vector<Compared>& all = compareAll();
  ASSERT_GE(all.size(), 48u);
  for (const Compared& one : all) {
    const double estimated = static_cast<double>(one.estimate.relativeError);
    const double factor = estimated / one.measured;
    std::printf("%-16s %-6s measured %.3f estimated %.3f factor %.2f by %s\n", one.name.c_str(),
                one.level.c_str(), one.measured, estimated, factor,
                wlkApproximationName(one.estimate.dominant));
    if (one.measured < NOISE) {
      EXPECT_LE(estimated, 2 * NOISE) << one.name;
      continue;
    }
    ++rows;
    EXPECT_GE(factor, 1 / WORST) << one.name;
    EXPECT_LE(factor, WORST) << one.name;
    within += factor >= 1 / USUAL && factor <= USUAL ? 1 : 0;
  }
  EXPECT_GE(rows, 40u);
  EXPECT_GE(4 * within, 3 * rows);
}

// Thickness of slabs and size of texels alone, where they are seen at all.
TEST(ErrorEstimate, FollowsTheSlabs) {
  constexpr double SEEN = 2e-3;
  constexpr double USUAL = 4.0;  // one rule for soft layers and for hard edges
  size_t rows = 0;
  size_t within = 0;
  for (const Compared& one : compareAll()) {
    const auto estimated = static_cast<double>(one.estimate.part[WLK_APPROXIMATION_VOLUME_SLICES]);
    std::printf("%-16s %-6s measured %.4f estimated %.4f factor %.2f\n", one.name.c_str(),
                one.level.c_str(), one.slabs, estimated, estimated / one.slabs);
    if (one.slabs > SEEN) {
      ++rows;
      within += estimated >= one.slabs / USUAL && estimated <= one.slabs * USUAL ? 1 : 0;
    }
  }
  ASSERT_GE(rows, 20u);
  EXPECT_GE(4 * within, 3 * rows);
}

TEST(ErrorEstimate, NamesWhatDominates) {
  for (const Compared& one : compareAll()) {
    if (one.name == "sun-60" || one.name == "sun-80" || one.name == "horizon-10km") {
      EXPECT_EQ(one.estimate.dominant, uint32_t{WLK_APPROXIMATION_SKY}) << one.name;
    }
    // At low its slabs may be worse.
    if (one.level != "low" && (one.name == "slab-16" || one.name == "cumulus-inside")) {
      EXPECT_EQ(one.estimate.dominant, uint32_t{WLK_APPROXIMATION_VOLUME_SCATTERING}) << one.name;
    }
  }
}

}  // namespace
}  // namespace bench
