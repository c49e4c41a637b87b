// SPDX-License-Identifier: MIT
#include "bench/memory.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

namespace bench {
namespace {

TEST(Memory, WhatIsTouchedIsNoLongerAvailable) {
  constexpr uint64_t MIB = uint64_t{1} << 20;
  const Memory before = memoryNow();
  if (before.total == 0) {
    GTEST_SKIP() << "no /proc/meminfo";
  }
  EXPECT_LE(before.available, before.total);
  std::vector<unsigned char> block(256 * MIB);
  std::memset(block.data(), 1, block.size());
  // Half: other processes come and go.
  EXPECT_LT(memoryNow().available + 128 * MIB, before.available);
  EXPECT_EQ(memoryNow().total, before.total);
  EXPECT_EQ(block.back(), 1);
}

}  // namespace
}  // namespace bench
