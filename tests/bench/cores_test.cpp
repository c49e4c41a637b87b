// SPDX-License-Identifier: MIT
// What cores are found to be like, alone and beside other work.
#include "bench/cores.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace bench {
namespace {

TEST(Cores, HandoverIsThatOfTwoCores) {
  // A line moves between two cores in no less than a few ns; 100 us are a scheduler's, not a
  // cache's.
  const double handover = coreHandover_ns();
  if (coresOfProcess().size() < 2) {
    EXPECT_EQ(handover, 0.0);
    return;
  }
  EXPECT_GT(handover, 2.0);
  EXPECT_LT(handover, 1e5);
}

// Whatever runs beside the test comes and goes: of many, the fastest tell. No core does 160 000
// multiplications and additions in 2 us.
TEST(Cores, WorkTakesTheSameTimeAgain) {
  constexpr size_t OFTEN = 40;
  std::vector<double> works;
  for (size_t i = 0; i < OFTEN; ++i) {
    works.push_back(coreWork_ns());
  }
  std::sort(works.begin(), works.end());
  EXPECT_GT(works[0], 2000.0);
  EXPECT_LT(works[3], QUIET_WORK * works[0]);
}

TEST(Cores, QuietIsAsGoodAsEver) {
  currentCores();
  const CoreState best = bestCores();
  EXPECT_TRUE(areQuiet(best));
  EXPECT_FALSE(areQuiet({best.handover_ns, 1.2 * best.work_ns}));
  if (best.handover_ns > 0.0) {
    EXPECT_FALSE(areQuiet({3.0 * best.handover_ns, best.work_ns}));
  }
}

}  // namespace
}  // namespace bench
