// SPDX-License-Identifier: MIT
#include "bench/front_timing.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <limits>

namespace bench {
namespace {

// A frame is repeated until a round spends this long on it: timers and schedulers then matter
// less than 1 %.
constexpr double MIN_ROUND_ms = 30.0;
constexpr size_t MAX_REPEATS = 64;
// Cheap scenes get more rounds, up to MORE_ROUNDS times as many. Ratios of two runs still differ,
// see docs/accuracy-and-performance.md.
constexpr double MIN_STUDY_ms = 4000.0;
constexpr size_t MORE_ROUNDS = 7;
// A frame longer than this needs no second warm-up: what is made once is a small part of it.
constexpr double LONG_WARM_UP_ms = 200.0;

struct Sample {
  double wall = 0.0;
  double cpu = 0.0;
  double gpu = 0.0;
};

double wallClock_ms() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double, std::milli>(now).count();
}

// Of all threads of the process: the driver's workers too.
double processClock_ms() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

Sample timeFrames(const RenderFrame& frame, size_t repeats) {
  Sample sample;
  const double wall = wallClock_ms();
  const double cpu = processClock_ms();
  for (size_t i = 0; i < repeats; ++i) {
    sample.gpu += frame();
  }
  sample.cpu = processClock_ms() - cpu;
  sample.wall = wallClock_ms() - wall;
  const auto count = static_cast<double>(repeats);
  return {sample.wall / count, sample.cpu / count, sample.gpu / count};
}

std::vector<double> ratios(const std::vector<Sample>& samples, const std::vector<Sample>& anchor,
                           double Sample::*time) {
  std::vector<double> result;
  for (size_t i = 0; i < samples.size(); ++i) {
    result.push_back(samples[i].*time / (anchor[i].*time));
  }
  std::sort(result.begin(), result.end());
  return result;
}

std::vector<double> column(const std::vector<Sample>& samples, double Sample::*time) {
  std::vector<double> result;
  for (const Sample& sample : samples) {
    result.push_back(sample.*time);
  }
  return result;
}

Timing summarise(const std::vector<Sample>& samples, const std::vector<Sample>& anchor) {
  Timing timing;
  timing.wall = medianOf(column(samples, &Sample::wall));
  std::vector<double> distance;
  for (const Sample& sample : samples) {
    distance.push_back(std::abs(sample.wall - timing.wall));
  }
  timing.wallDeviation = medianOf(distance);
  timing.cpu = medianOf(column(samples, &Sample::cpu));
  timing.gpu = medianOf(column(samples, &Sample::gpu));
  const std::vector<double> sorted = ratios(samples, anchor, &Sample::wall);
  timing.ratio = medianOf(sorted);
  // The count of samples below the median is binomial: n/2 +- 1.96 sqrt(n)/2.
  const auto n = static_cast<double>(sorted.size());
  const double rank = std::floor(0.5 * n - 0.98 * std::sqrt(n));
  const size_t skip = rank > 0.0 ? static_cast<size_t>(rank) : 0;
  timing.ratioLow = sorted[skip];
  timing.ratioHigh = sorted[sorted.size() - 1 - skip];
  timing.cpuRatio = medianOf(ratios(samples, anchor, &Sample::cpu));
  return timing;
}

}  // namespace

double medianOf(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

std::vector<Timing> interleave(const std::vector<Copies>& methods, size_t anchor, size_t warmUps,
                               size_t rounds) {
  std::vector<size_t> repeats(methods.size(), 1);
  double round_ms = 0;
  for (size_t i = 0; i < methods.size(); ++i) {
    double shortest = std::numeric_limits<double>::infinity();
    for (const RenderFrame& frame : methods[i]) {
      double spent = 0.0;
      for (size_t k = 0; k < warmUps && (k == 0 || spent < LONG_WARM_UP_ms); ++k) {
        const double wall = timeFrames(frame, 1).wall;
        shortest = std::min(shortest, wall);
        spent += wall;
      }
    }
    const double wanted = std::ceil(MIN_ROUND_ms / std::max(shortest, 1e-3));
    repeats[i] = std::clamp<size_t>(static_cast<size_t>(wanted), 1, MAX_REPEATS);
    round_ms += shortest * static_cast<double>(repeats[i]);
  }
  const auto fill = static_cast<size_t>(MIN_STUDY_ms / round_ms);
  rounds = std::clamp(fill, rounds, MORE_ROUNDS * rounds);
  std::vector<std::vector<Sample>> samples(methods.size());
  for (size_t round = 0; round < rounds; ++round) {
    for (size_t k = 0; k < methods.size(); ++k) {
      const size_t i = (k + round) % methods.size();
      const Copies& copies = methods[i];
      samples[i].push_back(timeFrames(copies[round % copies.size()], repeats[i]));
    }
  }
  std::vector<Timing> timings;
  for (const std::vector<Sample>& own : samples) {
    timings.push_back(summarise(own, samples[anchor]));
  }
  return timings;
}

}  // namespace bench
