// SPDX-License-Identifier: MIT
#include "bench/memory.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <vector>

namespace bench {
namespace {

constexpr uint64_t MIB = uint64_t{1} << 20;

TEST(Memory, NoMoreThanTheMachineHas) {
  if (!std::filesystem::exists("/proc/meminfo")) {
    GTEST_SKIP() << "no /proc/meminfo";
  }
  const Memory memory = memoryNow();
  const auto machine =
      static_cast<uint64_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<uint64_t>(sysconf(_SC_PAGESIZE));
  EXPECT_GT(memory.available, 0u);
  EXPECT_LE(memory.available, memory.total);
  EXPECT_LE(memory.total, machine + MIB);
}

// Other processes come and go: once of ten times, and half of it.
TEST(Memory, WhatIsTouchedIsNoLongerAvailable) {
  if (!std::filesystem::exists("/proc/meminfo")) {
    GTEST_SKIP() << "no /proc/meminfo";
  }
  bool seen = false;
  for (size_t i = 0; i < 10 && !seen; ++i) {
    const uint64_t before = memoryNow().available;
    std::vector<unsigned char> block(256 * MIB);
    std::memset(block.data(), 1, block.size());
    seen = memoryNow().available + 128 * MIB < before && block.back() == 1;
  }
  EXPECT_TRUE(seen);
}

}  // namespace
}  // namespace bench
