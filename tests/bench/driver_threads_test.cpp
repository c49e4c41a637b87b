// SPDX-License-Identifier: MIT
// Whether threads that look like the driver's get a core each, and others none.
#include "bench/driver_threads.hpp"

#include <gtest/gtest.h>
#include <pthread.h>
#include <sched.h>

#include <algorithm>
#include <atomic>
#include <string>
#include <thread>
#include <vector>

namespace bench {
namespace {

// Threads that wait, with names as lavapipe gives them.
class Pool {
 public:
  explicit Pool(const std::vector<std::string>& names) {
    for (const std::string& name : names) {
      threads_.emplace_back([this] {
        while (!over_) {
          std::this_thread::yield();
        }
      });
      pthread_setname_np(threads_.back().native_handle(), name.c_str());
    }
  }
  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;
  ~Pool() {
    over_ = true;
    for (std::thread& thread : threads_) {
      thread.join();
    }
  }

  // Cores on which it may run.
  int cores(size_t index) {
    cpu_set_t set;
    CPU_ZERO(&set);
    pthread_getaffinity_np(threads_[index].native_handle(), sizeof set, &set);
    return CPU_COUNT(&set);
  }

  void pin(size_t index, size_t core) {
    cpu_set_t set;
    CPU_ZERO(&set);
    CPU_SET(core, &set);
    pthread_setaffinity_np(threads_[index].native_handle(), sizeof set, &set);
  }

  bool runsOn(size_t index, size_t core) {
    cpu_set_t set;
    CPU_ZERO(&set);
    pthread_getaffinity_np(threads_[index].native_handle(), sizeof set, &set);
    return CPU_ISSET(core, &set) != 0;
  }

 private:
  std::atomic<bool> over_ = false;
  std::vector<std::thread> threads_;
};

std::vector<size_t> coresOfThisThread() {
  cpu_set_t set;
  CPU_ZERO(&set);
  sched_getaffinity(0, sizeof set, &set);
  std::vector<size_t> cores;
  for (size_t core = 0; core < CPU_SETSIZE; ++core) {
    if (CPU_ISSET(core, &set)) {
      cores.push_back(core);
    }
  }
  return cores;
}

TEST(DriverThreads, WorkersGetACoreEach) {
  const std::vector<size_t> cores = coresOfThisThread();
  // A queue's thread, two workers for triangles, two for dispatches, and one of something else.
  Pool pool({"welkin", "llvmpipe-0", "llvmpipe-1", "welkin", "welkin", "welkin"});
  EXPECT_EQ(pinDriverThreads(), std::min<size_t>(2, cores.size()));
  EXPECT_EQ(pool.cores(0), static_cast<int>(cores.size()));
  for (size_t worker = 0; worker < 4; ++worker) {
    EXPECT_EQ(pool.cores(1 + worker), 1) << worker;
    EXPECT_TRUE(pool.runsOn(1 + worker, cores[worker % 2 % cores.size()])) << worker;
  }
  EXPECT_EQ(pool.cores(5), static_cast<int>(cores.size()));
}

TEST(DriverThreads, ShareOneCoreForAWhile) {
  const std::vector<size_t> cores = coresOfThisThread();
  // A queue's thread, two workers for triangles, two for dispatches, and one that is somewhere.
  Pool pool({"welkin", "llvmpipe-0", "llvmpipe-1", "welkin", "welkin", "other"});
  pinDriverThreads();
  pool.pin(5, cores.back());
  {
    const OnOneCore together;
    EXPECT_EQ(coresOfThisThread(), std::vector<size_t>{cores.front()});
    for (size_t thread = 0; thread < 6; ++thread) {
      EXPECT_EQ(pool.cores(thread), 1) << thread;
      EXPECT_TRUE(pool.runsOn(thread, cores.front())) << thread;
    }
  }
  EXPECT_EQ(coresOfThisThread(), cores);
  EXPECT_EQ(pool.cores(0), static_cast<int>(cores.size()));
  for (size_t worker = 0; worker < 4; ++worker) {
    EXPECT_EQ(pool.cores(1 + worker), 1) << worker;
    EXPECT_TRUE(pool.runsOn(1 + worker, cores[worker % 2 % cores.size()])) << worker;
  }
  EXPECT_EQ(pool.cores(5), 1);
  EXPECT_TRUE(pool.runsOn(5, cores.back()));
}

TEST(DriverThreads, OtherDriversAreLeftAlone) {
  Pool pool({"worker-0", "worker-1"});
  pool.pin(1, coresOfThisThread().back());
  EXPECT_EQ(pinDriverThreads(), 0u);
  EXPECT_EQ(pool.cores(0), static_cast<int>(coresOfThisThread().size()));
  EXPECT_EQ(pool.cores(1), 1);
}

}  // namespace
}  // namespace bench
