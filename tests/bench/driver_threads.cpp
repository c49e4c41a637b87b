// SPDX-License-Identifier: MIT
#include "bench/driver_threads.hpp"

#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <thread>
#include <vector>

namespace bench {
namespace {

struct Task {
  pid_t id = 0;
  std::string name;
};

// In the order in which they were made, as long as numbers do not begin anew.
std::vector<Task> tasksOfProcess() {
  std::vector<Task> tasks;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/task", none)) {
    std::ifstream file(entry.path() / "comm");
    Task task{std::stoi(entry.path().filename().string()), {}};
    if (std::getline(file, task.name)) {
      tasks.push_back(task);
    }
  }
  std::sort(tasks.begin(), tasks.end(), [](const Task& a, const Task& b) { return a.id < b.id; });
  return tasks;
}

std::vector<size_t> coresOfProcess() {
  cpu_set_t allowed;
  CPU_ZERO(&allowed);
  std::vector<size_t> cores;
  if (sched_getaffinity(getpid(), sizeof allowed, &allowed) == 0) {
    for (size_t core = 0; core < CPU_SETSIZE; ++core) {
      if (CPU_ISSET(core, &allowed)) {
        cores.push_back(core);
      }
    }
  }
  return cores;
}

void pin(const Task& task, size_t core) {
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(core, &one);
  sched_setaffinity(task.id, sizeof one, &one);  // a thread that has ended needs none
}

}  // namespace

size_t pinDriverThreads() {
  const std::vector<size_t> cores = coresOfProcess();
  if (cores.empty()) {
    return 0;
  }
  // A device makes "llvmpipe-0", "llvmpipe-1" ... for triangles, then as many for dispatches, which
  // have the process' name.
  size_t drawing = 0;
  size_t dispatching = 0;
  size_t most = 0;
  for (const Task& task : tasksOfProcess()) {
    if (task.name.rfind("llvmpipe-", 0) == 0) {
      drawing = task.name == "llvmpipe-0" ? 0 : drawing;
      pin(task, cores[drawing++ % cores.size()]);
      dispatching = 0;
      most = std::max(most, drawing);
    } else if (dispatching < drawing) {
      pin(task, cores[dispatching++ % cores.size()]);
    }
  }
  return std::min(most, cores.size());
}

double coreHandover_ns() {
  const std::vector<size_t> cores = coresOfProcess();
  if (cores.size() < 2) {
    return 0.0;
  }
  constexpr uint32_t TURNS = 200;  // of which the fastest of PARTS tells: others were interrupted
  constexpr uint32_t PARTS = 50;
  std::atomic<uint32_t> word{0};
  std::atomic<bool> ready{false};
  std::thread other([&] {
    pin({gettid(), {}}, cores[1]);
    ready = true;
    for (uint32_t turn = 0; turn < TURNS * PARTS; ++turn) {
      while (word.load(std::memory_order_acquire) != 2 * turn + 1) {
      }
      word.store(2 * turn + 2, std::memory_order_release);
    }
  });
  double least_ns = std::numeric_limits<double>::infinity();
  std::thread one([&] {
    pin({gettid(), {}}, cores[0]);
    while (!ready) {
    }
    for (uint32_t part = 0; part < PARTS; ++part) {
      const auto start = std::chrono::steady_clock::now();
      for (uint32_t turn = part * TURNS; turn < (part + 1) * TURNS; ++turn) {
        word.store(2 * turn + 1, std::memory_order_release);
        while (word.load(std::memory_order_acquire) != 2 * turn + 2) {
        }
      }
      const std::chrono::duration<double, std::nano> spent =
          std::chrono::steady_clock::now() - start;
      least_ns = std::min(least_ns, spent.count() / (2.0 * TURNS));
    }
  });
  one.join();
  other.join();
  return least_ns;
}

double awaitNearCores() {
  // What two near cores take differs by a fifth unless the cache is slower for a while.
  constexpr double ALIKE = 1.35;
  constexpr std::chrono::milliseconds NAP{50};
  static int naps = 1200;
  static double least_ns = std::numeric_limits<double>::infinity();
  for (;; --naps) {
    const double handover = coreHandover_ns();
    least_ns = std::min(least_ns, handover);
    if (naps == 0 || handover <= std::min(NEAR_CORES_ns, ALIKE * least_ns)) {
      return handover;
    }
    std::this_thread::sleep_for(NAP);
  }
}

}  // namespace bench
