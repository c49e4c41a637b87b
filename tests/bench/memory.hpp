// SPDX-License-Identifier: MIT
// How much memory the machine, or what the process runs in, has left.
#pragma once

#include <cstdint>

namespace bench {

/// Bytes; both 0 where nobody tells.
struct Memory {
  uint64_t total = 0;
  /// Without swapping, caches given up.
  uint64_t available = 0;
};

/// The machine's, or the control group's (v2) if that has less.
Memory memoryNow();

}  // namespace bench
