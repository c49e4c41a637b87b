// SPDX-License-Identifier: MIT
#include "bench/memory.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

namespace bench {
namespace {

TEST(Memory, NoMoreThanTheMachineHas) {
  if (!std::filesystem::exists("/proc/meminfo")) {
    GTEST_SKIP() << "no /proc/meminfo";
  }
  const Memory memory = memoryNow();
  const auto machine =
      static_cast<uint64_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<uint64_t>(sysconf(_SC_PAGESIZE));
  EXPECT_GT(memory.available, 0u);
  EXPECT_LE(memory.available, memory.total);
  EXPECT_LE(memory.total, machine);
}

}  // namespace
}  // namespace bench
