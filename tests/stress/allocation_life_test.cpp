// SPDX-License-Identifier: MIT
// Every allocation of the host's memory fails in an engine's life, each in a life of its own: once,
// or with all that the same call asks for after it. The call says so and changes nothing that the
// context tells; made again it succeeds, and the life goes on to the same end.
#include <algorithm>
#include <set>

#include "stress/engine_life.hpp"
#include "stress/fault_count.hpp"
#include "support/fault_layer.hpp"

namespace welkin::test {
namespace {

enum class Failing { ONCE, ON };

class AllocationFaults : public ::testing::TestWithParam<Kind> {
 protected:
  AllocationFaults() { FaultLayer::failNever(); }
  ~AllocationFaults() override {
    FaultLayer::makeHollowPipelines(false);
    EXPECT_TRUE(engine.spy.messages().empty()) << engine.spy.messages().front();
  }

  // A life whose n-th allocation fails. Tells how many there are.
  uint64_t live(const Kind& kind, uint64_t n, Failing failing);

  Engine engine;
  FaultCounts counts;
  std::vector<double> end;           // what the context of the life before told at its end
  std::vector<const char*> entries;  // of the last life without faults: each allocation's function
};

uint64_t AllocationFaults::live(const Kind& kind, uint64_t n, Failing failing) {
  Life life(engine, kind, FaultLayer::getInstanceProcAddr());
  const char* failedEntry = nullptr;
  bool clean = true;
  uint64_t used = 0;
  bool armed = true;
  if (n == CountingAllocator::NEVER) {
    entries.clear();
  }
  for (const Step& step : life.steps()) {
    // Before the handles go, and after the frames.
    if (std::string(step.entry) == "wlkDestroyView") {
      end = life.told();
    }
    std::vector<double> before;
    if (armed && life.context != nullptr) {
      before = life.told();
    }
    const uint64_t calls = life.memory.calls();
    if (armed && n != CountingAllocator::NEVER && n >= used) {
      failing == Failing::ONCE ? life.memory.failOnce(n - used) : life.memory.failFrom(n - used);
    }
    const WlkResult result = step.call();
    life.memory.failFrom(CountingAllocator::NEVER);
    used += life.memory.calls() - calls;
    if (n == CountingAllocator::NEVER) {
      entries.resize(used, step.entry);
    }
    if (armed && used > n) {
      armed = false;
      failedEntry = step.entry;
      EXPECT_TRUE(result == WLK_ERROR_OUT_OF_HOST_MEMORY) << step.entry << " returns " << result;
    }
    if (result >= 0) {
      continue;
    }
    EXPECT_EQ(failedEntry, step.entry) << step.entry << ": " << lastError().message;
    EXPECT_EQ(lastError().result, WLK_ERROR_OUT_OF_HOST_MEMORY) << step.entry;
    EXPECT_NE(lastError().message[0], '\0');
    if (life.context == nullptr) {
      clean = FaultLayer::live().empty() && life.memory.live() == 0;
      EXPECT_TRUE(clean) << "a failed wlkCreateContext leaves something";
    } else {
      EXPECT_EQ(life.told(), before) << "a failed " << step.entry << " changes something";
    }
    EXPECT_EQ(step.call(), WLK_SUCCESS) << "again, " << step.entry << ": " << lastError().message;
  }
  wlkDestroyContext(life.context);
  life.context = nullptr;
  const auto left = FaultLayer::live();
  const bool gone = left.empty() && life.memory.live() == 0;
  EXPECT_TRUE(gone) << "left by a failing " << (failedEntry != nullptr ? failedEntry : "none")
                    << ": " << life.memory.live() << " allocations, " << left.size()
                    << " kinds of objects, among them "
                    << (left.empty() ? "none" : left.begin()->first);
  if (failedEntry != nullptr) {
    counts.add(failedEntry, failing == Failing::ONCE ? "one allocation" : "all from it on",
               clean && gone);
  }
  return used;
}

// As with calls of Vulkan, pipelines are hollow. WELKIN_ALL_FAULTS is the stride in wlkPrepare; of
// all else each allocation fails then.
TEST_P(AllocationFaults, EachLeavesTheContextAsItWas) {
  FaultLayer::makeHollowPipelines(true);
  const Kind& kind = GetParam();
  const uint64_t all = strideOfAll();
  const uint64_t preparing = all > 0 ? all : SPARSER * kind.preparing;
  const uint64_t other = all > 0 ? 1 : SPARSER * kind.other;
  const uint64_t allocations = live(kind, CountingAllocator::NEVER, Failing::ONCE);
  const std::vector<double> truth = end;
  ASSERT_GT(allocations, 50u);
  EXPECT_GT(truth.at(1), 0.0) << "the transmittance";
  const std::vector<const char*> functions = entries;
  uint64_t lives = 0;
  std::set<std::string> tried;
  for (uint64_t n = 0; n < allocations && !HasFailure(); ++n) {
    // The first of each function fails in any case.
    const std::string entry = functions.at(n);
    const bool first = tried.insert(entry).second;
    const uint64_t stride = entry == "wlkPrepare" ? preparing : other;
    if (!first && n % stride != 0) {
      continue;
    }
    for (const Failing failing : {Failing::ONCE, Failing::ON}) {
      // They take turns where a life is long.
      if (SPARSER > 1 && all == 0 && lives % 2 == uint64_t{failing == Failing::ON}) {
        continue;
      }
      SCOPED_TRACE("allocation " + std::to_string(n) + " of " + std::to_string(allocations));
      live(kind, n, failing);
      EXPECT_EQ(end, truth) << "the life ends in another way";
    }
    ++lives;
  }
  counts.report("host", kind.name);
  EXPECT_GT(counts.of("wlkCreateContext"), 0u);
  EXPECT_GT(counts.of("wlkPrepare"), 0u);
  EXPECT_TRUE(!kind.diameters || counts.of("wlkUploadVolumeDiameters") > 0);
}

INSTANTIATE_TEST_SUITE_P(Of, AllocationFaults,
                         ::testing::Values(CLOUD, AIR, WHOLE, TARGETS, DROPLETS, SURFACE, SETTERS),
                         [](const auto& one) { return std::string(one.param.name); });

using AllocationPicture = AllocationFaults;

TEST_P(AllocationPicture, IsTheOneWithoutFaults) {
  const Kind& kind = GetParam();
  const uint64_t allocations = live(kind, CountingAllocator::NEVER, Failing::ONCE);
  const std::vector<float> truth = engine.picture();
  EXPECT_GT(*std::max_element(truth.begin(), truth.end()), 0.0f);
  constexpr uint64_t LIVES = 4;
  for (uint64_t i = 0; i < LIVES; ++i) {
    const uint64_t n = allocations * (2 * i + 1) / (2 * LIVES);
    SCOPED_TRACE("allocation " + std::to_string(n));
    live(kind, n, i % 2 == 0 ? Failing::ONCE : Failing::ON);
    EXPECT_TRUE(engine.picture() == truth) << "another one";
  }
}

INSTANTIATE_TEST_SUITE_P(Of, AllocationPicture, ::testing::Values(SURFACE),
                         [](const auto& one) { return std::string(one.param.name); });

}  // namespace
}  // namespace welkin::test
