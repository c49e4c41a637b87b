// SPDX-License-Identifier: MIT
// Every call of Vulkan that can fail fails once, at every place of an engine's life: creation,
// uploads, preparation, frames, a resize, destruction. The failing function says so, changes
// nothing and leaks nothing; after a lack of memory the same call succeeds, and the picture is the
// one without faults; after a lost device nothing is asked of Vulkan any more but to destroy.
#include <algorithm>
#include <set>

#include "stress/engine_life.hpp"
#include "stress/fault_count.hpp"
#include "support/fault_layer.hpp"

namespace welkin::test {
namespace {

class Faults : public ::testing::TestWithParam<Kind> {
 protected:
  Faults() { FaultLayer::failNever(); }
  ~Faults() override {
    FaultLayer::failNever();
    FaultLayer::makeHollowPipelines(false);
    EXPECT_TRUE(engine.spy.messages().empty()) << engine.spy.messages().front();
    EXPECT_TRUE(FaultLayer::unknown().empty()) << *FaultLayer::unknown().begin();
  }

  // A life whose k-th call fails. Tells how many calls there are.
  uint64_t live(const Kind& kind, uint64_t k, VkResult code);
  // Whether the life's objects and host memory are gone.
  bool nothingLeft(const Life& life, const char* when) {
    const auto left = FaultLayer::live();
    EXPECT_TRUE(left.empty()) << when << ": " << left.size() << " kinds are left, among them "
                              << left.begin()->second << " of " << left.begin()->first;
    EXPECT_EQ(life.memory.live(), 0u) << when << ": host memory is left";
    return left.empty() && life.memory.live() == 0;
  }
  void expectRefused(const Step& step);

  Engine engine;
  FaultCounts counts;
  std::vector<const char*> entries;  // of the last life without faults: each call's function
};

// Handles that were never made are the only other thing that fails.
void Faults::expectRefused(const Step& step) {
  const uint64_t before = FaultLayer::anyCalls() - FaultLayer::destructions();
  const WlkResult result = step.call();
  EXPECT_TRUE(result == WLK_ERROR_INVALID_HANDLE || result == WLK_NOT_READY ||
              result == (step.needsDevice ? WLK_ERROR_DEVICE_LOST : WLK_SUCCESS))
      << step.entry << " returns " << result;
  EXPECT_EQ(FaultLayer::anyCalls() - FaultLayer::destructions(), before)
      << step.entry << " asks a lost device";
}

uint64_t Faults::live(const Kind& kind, uint64_t k, VkResult code) {
  FaultLayer::failAt(k, code, false);
  uint64_t calls = 0;
  const char* failedEntry = nullptr;
  Life life(engine, kind, FaultLayer::getInstanceProcAddr());
  bool clean = true;
  bool lost = false;
  if (k == FaultLayer::NEVER) {
    entries.clear();
  }
  for (const Step& step : life.steps()) {
    if (lost) {
      expectRefused(step);
      continue;
    }
    const WlkResult result = step.call();
    if (k == FaultLayer::NEVER) {
      entries.resize(FaultLayer::calls(), step.entry);
    }
    if (result >= 0) {
      continue;
    }
    EXPECT_EQ(failedEntry, nullptr)
        << step.entry << " fails without a fault: " << lastError().message;
    failedEntry = step.entry;
    EXPECT_EQ(result, codeOf(code)) << step.entry;
    EXPECT_EQ(lastError().vkResult, code) << step.entry;
    EXPECT_STREQ(lastError().field, FaultLayer::failed()) << step.entry;
    if (life.context == nullptr) {
      clean = nothingLeft(life, "after a failed wlkCreateContext");
    } else {
      lost = code == VK_ERROR_DEVICE_LOST;
    }
    if (!lost) {
      EXPECT_EQ(step.call(), WLK_SUCCESS) << "again, " << step.entry << ": " << lastError().field;
    }
  }
  calls = FaultLayer::calls();
  EXPECT_TRUE(failedEntry != nullptr || k >= calls ||
              std::string(FaultLayer::failed()) == "vkGetQueryPoolResults")
      << FaultLayer::failed() << " failed and nobody said so";
  wlkDestroyContext(life.context);
  life.context = nullptr;
  clean = nothingLeft(life, "after wlkDestroyContext") && clean;
  if (k < calls) {
    counts.add(failedEntry != nullptr ? failedEntry : "unread timestamps",
               wlkResultName(codeOf(code)), clean);
  }
  return calls;
}

// Pipelines are hollow here: compiling them takes the driver 3 s for each life.
// The codes take turns, and in most lives it is not every call; with WELKIN_ALL_FAULTS in the
// environment (1, or a stride) each call meets each code.
TEST_P(Faults, EveryCallOfVulkanMayFailOnce) {
  FaultLayer::makeHollowPipelines(true);
  const Kind& kind = GetParam();
  const uint64_t all = strideOfAll();
  const uint64_t calls = live(kind, FaultLayer::NEVER, VK_SUCCESS);
  ASSERT_GT(calls, 100u);
  const std::vector<const char*> functions = entries;
  const uint64_t stride = all > 0 ? all : SPARSER * kind.stride;
  std::set<std::string> tried;
  for (uint64_t k = 0; k < calls && !HasFailure(); ++k) {
    // The first of each function fails in any case.
    const std::string entry = k < functions.size() ? functions[k] : "";
    const bool first = tried.insert(entry).second;
    if (!first && k % stride != 0) {
      continue;
    }
    for (uint64_t i = 0; i < (all > 0 ? CODES.size() : 1); ++i) {
      const VkResult code = CODES[(k + i) % CODES.size()];
      SCOPED_TRACE("call " + std::to_string(k) + " returns " + std::to_string(code));
      live(kind, k, code);
    }
  }
  counts.report("vulkan", kind.name);
  EXPECT_GT(counts.of("wlkCreateContext"), 0u);
  EXPECT_GT(counts.of("wlkPrepare"), 0u);
  EXPECT_TRUE(!kind.setters || counts.of("wlkVulkanSetVolumeImage") > 0);
  EXPECT_TRUE(!kind.surface || counts.of("wlkCreateSurface") > 0);
  EXPECT_TRUE(!kind.diameters || counts.of("wlkUploadVolumeDiameters") > 0);
}

INSTANTIATE_TEST_SUITE_P(Of, Faults,
                         ::testing::Values(CLOUD, AIR, WHOLE, TARGETS, DROPLETS, SURFACE, SETTERS),
                         [](const auto& one) { return std::string(one.param.name); });

using FaultPicture = Faults;

TEST_P(FaultPicture, IsTheOneWithoutFaults) {
  const Kind& kind = GetParam();
  const uint64_t calls = live(kind, FaultLayer::NEVER, VK_SUCCESS);
  const std::vector<float> truth = engine.picture();
  EXPECT_GT(*std::max_element(truth.begin(), truth.end()), 0.0f);
  constexpr uint64_t LIVES = 4;
  for (uint64_t i = 0; i < LIVES; ++i) {
    const uint64_t k = calls * (2 * i + 1) / (2 * LIVES);
    SCOPED_TRACE("call " + std::to_string(k));
    live(kind, k, CODES[i % 2]);
    EXPECT_TRUE(engine.picture() == truth) << "another one after " << FaultLayer::failed();
  }
}

INSTANTIATE_TEST_SUITE_P(Of, FaultPicture, ::testing::Values(WHOLE),
                         [](const auto& one) { return std::string(one.param.name); });

}  // namespace
}  // namespace welkin::test
