// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <functional>
#include <thread>
#include <vector>

namespace welkin::test {

// Runs work(0) to work(count - 1), each in a thread, and waits. All begin at once.
inline void inThreads(size_t count, const std::function<void(size_t)>& work) {
  std::atomic<size_t> waiting{count};
  std::vector<std::thread> threads;
  for (size_t i = 0; i < count; ++i) {
    threads.emplace_back([&, i] {
      --waiting;
      while (waiting.load() > 0) {
        std::this_thread::yield();
      }
      work(i);
    });
  }
  for (std::thread& thread : threads) {
    thread.join();
  }
}

}  // namespace welkin::test
