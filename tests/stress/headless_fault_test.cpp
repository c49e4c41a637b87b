// SPDX-License-Identifier: MIT
// As fault_test.cpp, for contexts that load Vulkan by themselves: a layer between loader and driver
// lets their calls fail, those before the device and those of queue and fence included.
#include <algorithm>

#include "stress/fault_count.hpp"
#include "stress/headless_life.hpp"
#include "support/fault_layer.hpp"
#include "support/vulkan_layer.hpp"

namespace welkin::test {
namespace {

// What was recorded is gone with vkEndCommandBuffer, and cannot be recorded again.
WlkResult expectedOf(VkResult code) {
  return std::string(FaultLayer::failed()) == "vkEndCommandBuffer" ? WLK_ERROR_DEVICE_LOST
                                                                   : codeOf(code);
}

class HeadlessFaults : public ::testing::Test {
 protected:
  HeadlessFaults() { FaultLayer::failNever(); }
  ~HeadlessFaults() override {
    FaultLayer::failNever();
    FaultLayer::makeHollowPipelines(false);
  }
  uint64_t live(uint64_t k, VkResult code);
  bool nothingLeft(const HeadlessLife& life, const char* when) {
    const auto left = FaultLayer::live();
    EXPECT_TRUE(left.empty()) << when << ": " << left.size() << " kinds are left, among them "
                              << left.begin()->second << " of " << left.begin()->first;
    EXPECT_EQ(life.memory.live(), 0u) << when << ": host memory is left";
    return left.empty() && life.memory.live() == 0;
  }
  void fail(HeadlessLife& life, const Step& step, VkResult code, WlkResult result);
  void expectAsRecorded() const;

  UnderFaultLayer layer;
  FaultCounts counts;
  std::vector<float> picture;  // of the life before
  bool clean = true;
  bool lost = false;
};

void HeadlessFaults::fail(HeadlessLife& life, const Step& step, VkResult code, WlkResult result) {
  const WlkResult expected = expectedOf(code);
  EXPECT_EQ(result, expected) << step.entry;
  EXPECT_EQ(lastError().vkResult, code) << step.entry;
  EXPECT_STREQ(lastError().field, FaultLayer::failed()) << step.entry;
  if (life.context == nullptr) {
    clean = nothingLeft(life, "after a failed wlkCreateContext");
  } else {
    lost = expected == WLK_ERROR_DEVICE_LOST;
  }
  if (!lost) {
    EXPECT_EQ(step.call(), WLK_SUCCESS) << "again, " << step.entry << ": " << lastError().field;
  }
}

uint64_t HeadlessFaults::live(uint64_t k, VkResult code) {
  FaultLayer::failAt(k, code, false);
  HeadlessLife life;
  const char* failedEntry = nullptr;
  clean = true;
  lost = false;
  for (const Step& step : life.steps()) {
    const uint64_t before = FaultLayer::anyCalls() - FaultLayer::destructions();
    const WlkResult result = step.call();
    if (lost) {
      EXPECT_TRUE(result == WLK_ERROR_INVALID_HANDLE ||
                  result == (step.needsDevice ? WLK_ERROR_DEVICE_LOST : WLK_SUCCESS))
          << step.entry << " returns " << result;
      EXPECT_EQ(FaultLayer::anyCalls() - FaultLayer::destructions(), before)
          << step.entry << " asks a lost device";
    } else if (result < 0) {
      EXPECT_EQ(failedEntry, nullptr) << step.entry << ": " << lastError().message;
      failedEntry = step.entry;
      fail(life, step, code, result);
    } else {
      EXPECT_EQ(result, WLK_SUCCESS) << step.entry;
    }
  }
  const uint64_t calls = FaultLayer::calls();
  EXPECT_TRUE(failedEntry != nullptr || k >= calls ||
              std::string(FaultLayer::failed()) == "vkGetQueryPoolResults")
      << FaultLayer::failed() << " failed and nobody said so";
  picture = life.picture;
  wlkDestroyContext(life.context);
  life.context = nullptr;
  clean = nothingLeft(life, "after wlkDestroyContext") && clean;
  if (k < calls) {
    counts.add(failedEntry != nullptr ? failedEntry : "unread timestamps",
               wlkResultName(codeOf(code)), clean);
  }
  return calls;
}

// docs/results/faults.csv is of this library: each function meets as many failing calls as its rows
// tell. Theirs come by each code, here by one of them.
void HeadlessFaults::expectAsRecorded() const {
  const std::map<std::string, uint64_t> recorded =
      recordedFaults("vulkan", "headless", wlkResultName(WLK_ERROR_OUT_OF_HOST_MEMORY));
  EXPECT_FALSE(recorded.empty());
  for (const auto& [entry, faults] : recorded) {
    EXPECT_EQ(counts.of(entry), faults)
        << entry << ": the recorded faults are stale, see docs/reliability.md";
  }
  for (const std::string& entry : counts.entries()) {
    EXPECT_EQ(recorded.count(entry), 1u) << entry << " has no recorded faults";
  }
}

TEST_F(HeadlessFaults, EveryCallOfVulkanMayFailOnce) {
  FaultLayer::makeHollowPipelines(true);
  const uint64_t calls = live(FaultLayer::NEVER, VK_SUCCESS);
  ASSERT_GT(calls, 100u);
  for (uint64_t k = 0; k < calls && !HasFailure(); ++k) {
    for (uint64_t i = 0; i < (strideOfAll() > 0 ? CODES.size() : 1); ++i) {
      const VkResult code = CODES[(k + i) % CODES.size()];
      if (k == 0 && code == VK_ERROR_DEVICE_LOST) {
        continue;  // vkCreateInstance has no device to lose
      }
      SCOPED_TRACE("call " + std::to_string(k) + " returns " + std::to_string(code));
      live(k, code);
    }
  }
  counts.report("vulkan", "headless");
  if (strideOfAll() == 0) {
    expectAsRecorded();
  }
  EXPECT_GT(counts.of("wlkCreateContext"), 0u);
  EXPECT_GT(counts.of("wlkRenderHeadless"), 0u);
}

// Uploads that were recorded into a frame which could not be submitted come with the next one. The
// calls of a frame are the last of this life.
TEST_F(HeadlessFaults, NoUploadIsLostWithAFrame) {
  const uint64_t calls = live(FaultLayer::NEVER, VK_SUCCESS);
  const std::vector<float> truth = picture;
  EXPECT_GT(*std::max_element(truth.begin(), truth.end()), 0.0f);
  uint64_t frames = 0;
  for (uint64_t k = calls - 20; k < calls; ++k) {
    live(k, VK_ERROR_OUT_OF_HOST_MEMORY);
    const std::string failed = FaultLayer::failed();
    if (!lost &&
        (failed == "vkQueueSubmit" || failed == "vkWaitForFences" || failed == "vkResetFences")) {
      ++frames;
      EXPECT_TRUE(picture == truth) << "another picture after " << failed << ", call " << k;
    }
  }
  EXPECT_GT(frames, 2u);
}

}  // namespace
}  // namespace welkin::test
