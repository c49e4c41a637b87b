// SPDX-License-Identifier: MIT
// wlkGetErrorEstimate against the errors of the benchmark's scenes, none of which its constants
// were fitted to. Relative RMS errors, no unit.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "bench/front_errors.hpp"
#include "bench/front_world.hpp"

namespace bench {
namespace {

// Of (a - b) / b over the picture, the noise of the reference taken off.
double measuredError(const Ordered& errors) {
  return std::sqrt(errors.value("relMSEdenoised", NAN));
}

struct Compared {
  std::string name;
  double measured = 0;
  double estimated = 0;
  uint32_t dominant = 0;
};

// Every case without opaque geometry, which the estimate leaves out.
std::vector<Compared> compareAll(uint32_t level) {
  std::vector<Compared> result;
  for (const Case& one : readCases(WELKIN_BENCH_FOLDER "/front_cases.json")) {
    World world(one, false);
    if (world.scene().geometry) {
      continue;
    }
    const References references = readReferences(WELKIN_BENCH_FOLDER "/reference", one);
    const WlkView view = world.addView(qualityOf(levelMethods().at(level)));
    world.prepare();
    const host::RasterResult opaque = world.makeOpaque();
    world.render(view, opaque);
    const Ordered errors = errorsOf(world.read(view), references.all, one);
    const WlkErrorEstimate estimate = world.estimate(view);
    result.push_back({one.name, measuredError(errors), static_cast<double>(estimate.relativeError),
                      estimate.dominant});
  }
  return result;
}

TEST(ErrorEstimate, IsWithinAFactorOfTwoForMostScenes) {
  constexpr double USUAL = 2.0;  // what view.h promises for most scenes
  constexpr double WORST = 4.0;
  for (const uint32_t level : {WLK_QUALITY_LOW, WLK_QUALITY_HIGH}) {
    size_t within = 0;
    const std::vector<Compared> all = compareAll(level);
    ASSERT_GE(all.size(), 12u);
    for (const Compared& one : all) {
      const double factor = one.estimated / one.measured;
      std::printf("%-16s %-6s measured %.3f estimated %.3f factor %.2f by %s\n", one.name.c_str(),
                  levelName(level), one.measured, one.estimated, factor,
                  wlkApproximationName(one.dominant));
      EXPECT_GE(factor, 1 / WORST) << one.name;
      EXPECT_LE(factor, WORST) << one.name;
      within += factor >= 1 / USUAL && factor <= USUAL ? 1 : 0;
    }
    EXPECT_GE(4 * within, 3 * all.size()) << levelName(level);
  }
}

TEST(ErrorEstimate, NamesWhatDominates) {
  for (const Compared& one : compareAll(WLK_QUALITY_HIGH)) {
    if (one.name == "sun-60" || one.name == "sun-80" || one.name == "horizon-10km") {
      EXPECT_EQ(one.dominant, uint32_t{WLK_APPROXIMATION_SKY}) << one.name;
    }
    if (one.name == "slab-16" || one.name == "cumulus-inside") {
      EXPECT_EQ(one.dominant, uint32_t{WLK_APPROXIMATION_VOLUME_SCATTERING}) << one.name;
    }
  }
}

}  // namespace
}  // namespace bench
