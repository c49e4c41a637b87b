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
  const char* level = nullptr;
  double measured = 0;  // against all orders
  double slabs = 0;     // against ever thinner slabs; NaN without volumes
  WlkErrorEstimate estimate{};
};

// With a level's slabs and texels, whose limit is that of forward scattering.
host::Image forwardPicture(World& world, const Method& level, const host::RasterResult& opaque) {
  const WlkView view =
      world.addView(explicitQuality(forwardMethods()[level.settings.level].settings));
  world.prepare();
  world.render(view, opaque);
  host::Image picture = world.read(view);
  world.removeView(view);
  return picture;
}

Compared compare(World& world, const Method& method, const host::RasterResult& opaque,
                 const Reference& truth, const Case& one) {
  const WlkView view = world.addView(qualityOf(method));
  world.prepare();
  world.render(view, opaque);
  const host::Image picture = world.read(view);
  Compared row{one.name, levelName(method.settings.level),
               measuredError(errorsOf(picture, truth, one)), NAN, world.estimate(view)};
  world.removeView(view);
  return row;
}

// Every case without opaque geometry, which the estimate leaves out, at every level; those with
// volumes at one of them also without the light of sky and ground.
const std::vector<Compared>& compareAll() {
  static const std::vector<Compared> all = [] {
    std::vector<Compared> result;
    for (const Case& one : readCases(WELKIN_BENCH_FOLDER "/front_cases.json")) {
      World world(one, false);
      World bare(one, false, false);
      if (world.scene().geometry) {
        continue;
      }
      const References references = readReferences(WELKIN_BENCH_FOLDER "/reference", one);
      const host::RasterResult opaque = world.makeOpaque();
      for (const Method& method : levelMethods()) {
        Compared row = compare(world, method, opaque, references.all, one);
        if (references.converged.picture) {
          const Ordered limit =
              errorsOf(forwardPicture(bare, method, opaque), references.converged, one);
          row.slabs = std::sqrt(limit.at("relMSE").get<double>());
        }
        result.push_back(row);
        if (references.converged.picture && method.settings.level == WLK_QUALITY_HIGH) {
          result.push_back(compare(bare, method, opaque, references.all, one));
          result.back().level = "bare";
        }
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
                one.level, one.measured, estimated, factor,
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
                one.level, one.slabs, estimated, estimated / one.slabs);
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
    if (one.level != std::string("low") &&
        (one.name == "slab-16" || one.name == "cumulus-inside")) {
      EXPECT_EQ(one.estimate.dominant, uint32_t{WLK_APPROXIMATION_VOLUME_SCATTERING}) << one.name;
    }
  }
}

}  // namespace
}  // namespace bench
