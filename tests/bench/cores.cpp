// SPDX-License-Identifier: MIT
#include "bench/cores.hpp"

#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <functional>
#include <limits>
#include <numeric>
#include <thread>

namespace bench {
namespace {

using Clock = std::chrono::steady_clock;

double since_ns(Clock::time_point start) {
  return std::chrono::duration<double, std::nano>(Clock::now() - start).count();
}

// One thread on each core, all begun before any goes on; `work` is told its place among them.
void onCores(const std::vector<size_t>& cores, const std::function<void(size_t)>& work) {
  std::atomic<size_t> ready{0};
  std::vector<std::thread> threads;
  for (size_t i = 0; i < cores.size(); ++i) {
    threads.emplace_back([&, i] {
      pinThread(gettid(), {cores[i]});
      ++ready;
      while (ready < cores.size()) {
      }
      work(i);
    });
  }
  for (std::thread& thread : threads) {
    thread.join();
  }
}

// Independent chains, more than a core works on at once, so that who shares its units is felt.
constexpr size_t CHAINS = 32;
constexpr size_t STEPS = 5000;
float arithmetic() {
  std::array<float, CHAINS> chains{};
  for (size_t step = 0; step < STEPS; ++step) {
    for (float& chain : chains) {
      chain = chain * 0.999f + 0.5f;
    }
  }
  return std::accumulate(chains.begin(), chains.end(), 0.0f);
}

// More than a core's own cache holds, less than a shared one: a float of each line.
constexpr size_t CACHE_FLOATS = size_t{3} << 18;
constexpr size_t LINE_FLOATS = 16;
float reading(const std::vector<float>& memory) {
  float sum = 0.0f;
  for (size_t at = 0; at < memory.size(); at += LINE_FLOATS) {
    sum += memory[at];
  }
  return sum;
}

CoreState& best() {
  constexpr double NONE = std::numeric_limits<double>::infinity();
  static CoreState state{NONE, NONE};
  return state;
}

}  // namespace

std::vector<size_t> coresOf(pid_t thread) {
  cpu_set_t allowed;
  CPU_ZERO(&allowed);
  std::vector<size_t> cores;
  if (sched_getaffinity(thread, sizeof allowed, &allowed) == 0) {
    for (size_t core = 0; core < CPU_SETSIZE; ++core) {
      if (CPU_ISSET(core, &allowed)) {
        cores.push_back(core);
      }
    }
  }
  return cores;
}

const std::vector<size_t>& coresOfProcess() {
  static const std::vector<size_t> cores = coresOf(getpid());
  return cores;
}

void pinThread(pid_t thread, const std::vector<size_t>& cores) {
  cpu_set_t set;
  CPU_ZERO(&set);
  for (const size_t core : cores) {
    CPU_SET(core, &set);
  }
  sched_setaffinity(thread, sizeof set, &set);
}

double coreHandover_ns() {
  std::vector<size_t> cores = coresOfProcess();
  if (cores.size() < 2) {
    return 0.0;
  }
  cores.resize(2);
  constexpr uint32_t TURNS = 200;  // of which the fastest of PARTS tells: others were interrupted
  constexpr uint32_t PARTS = 15;
  std::atomic<uint32_t> word{0};
  double least_ns = std::numeric_limits<double>::infinity();
  onCores(cores, [&](size_t core) {
    for (uint32_t part = 0; part < PARTS; ++part) {
      const Clock::time_point start = Clock::now();
      for (uint32_t turn = part * TURNS; turn < (part + 1) * TURNS; ++turn) {
        const uint32_t mine = 2 * turn + static_cast<uint32_t>(core);
        while (word.load(std::memory_order_acquire) != mine) {
        }
        word.store(mine + 1, std::memory_order_release);
      }
      if (core == 0) {
        least_ns = std::min(least_ns, since_ns(start) / (2.0 * TURNS));
      }
    }
  });
  return least_ns;
}

double coreWork_ns() {
  constexpr size_t PARTS = 7;  // the middle one tells: others were interrupted
  static const std::vector<float> memory(CACHE_FLOATS, 1.0f);
  const std::vector<size_t>& cores = coresOfProcess();
  std::vector<double> ofCore(std::max<size_t>(cores.size(), 1));  // 0: none known
  std::atomic<float> kept{0.0f};
  onCores(cores, [&](size_t core) {
    std::array<double, PARTS> parts{};
    for (double& part : parts) {
      const Clock::time_point start = Clock::now();
      kept = arithmetic() + reading(memory);
      part = since_ns(start);
    }
    std::sort(parts.begin(), parts.end());
    ofCore[core] = parts[PARTS / 2];
  });
  return *std::max_element(ofCore.begin(), ofCore.end());
}

CoreState bestCores() {
  return best();
}

CoreState currentCores() {
  const CoreState now{coreHandover_ns(), coreWork_ns()};
  best() = {std::min(best().handover_ns, now.handover_ns), std::min(best().work_ns, now.work_ns)};
  return now;
}

bool areQuiet(const CoreState& state) {
  // Near cores hand over in 25 to 60 ns, as fast as their cache is at the time; two that are one
  // for a moment faster.
  constexpr double ALIKE = 2.5;
  constexpr double NEAR_ns = 25.0;
  return state.handover_ns <= ALIKE * std::max(best().handover_ns, NEAR_ns) &&
         state.work_ns <= QUIET_WORK * best().work_ns;
}

CoreState awaitQuietCores(double patience_ms) {
  constexpr std::chrono::milliseconds NAP{50};
  const Clock::time_point start = Clock::now();
  for (;;) {
    const CoreState now = currentCores();
    if (areQuiet(now) || 1e-6 * since_ns(start) >= patience_ms) {
      return now;
    }
    std::this_thread::sleep_for(NAP);
  }
}

}  // namespace bench
