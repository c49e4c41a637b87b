// SPDX-License-Identifier: MIT
// Runs a loop on every core; for host work that would otherwise keep the user waiting.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <thread>
#include <vector>

namespace host {

/// Calls body(i) for i in [0, count), in any order, on up to 16 threads. `body` must not throw and
/// must write only to what belongs to i, so that the result does not depend on the thread count.
template <class Body>
void parallelFor(uint32_t count, const Body& body) {
  const uint32_t cores = std::clamp(std::thread::hardware_concurrency(), 1u, 16u);
  std::atomic<uint32_t> next{0};
  const auto work = [&] {
    for (uint32_t i = next++; i < count; i = next++) {
      body(i);
    }
  };
  std::vector<std::thread> threads;
  for (uint32_t i = 1; i < std::min(cores, count); ++i) {
    threads.emplace_back(work);
  }
  work();
  for (std::thread& thread : threads) {
    thread.join();
  }
}

}  // namespace host
