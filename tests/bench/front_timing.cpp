// SPDX-License-Identifier: MIT
#include "bench/front_timing.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <iterator>
#include <limits>
#include <numeric>
#include <utility>

#include "bench/cores.hpp"
#include "bench/driver_threads.hpp"

namespace bench {
namespace {

// A frame is repeated until a round spends this long on it: timers and schedulers then matter
// some per cent. Many short rounds follow a machine whose speed drifts better than few long ones.
constexpr double MIN_ROUND_ms = 10.0;
constexpr size_t MAX_REPEATS = 64;
// Cheap scenes get more rounds, up to MORE_ROUNDS times as many.
constexpr double MIN_STUDY_ms = 2000.0;
constexpr size_t MORE_ROUNDS = 7;
// Warm-ups of a copy end when they took this long, the first frame of all, which compiles, left
// out: what is made once is then a small part of a frame.
constexpr double LONG_WARM_UP_ms = 60.0;
// A method whose first frame takes longer than this (light of all orders) is not copied.
constexpr double LONG_FIRST_ms = 1000.0;
// Long frames differ less: from so many times MIN_ROUND_ms on a method is timed in every second
// round.
constexpr double LONG_ROUND = 6.0;
constexpr size_t MAX_STRIDE = 2;
// A method whose fastest quiet rounds, CONFIRMED of them, differ by more than this (last / first)
// is timed in more rounds, up to UNSURE_ROUNDS times as many as were asked for, long ones up to as
// many.
constexpr size_t CONFIRMED = ENOUGH_QUIET;
constexpr double UNSURE = 1.02;
constexpr size_t UNSURE_ROUNDS = 2;
// Unless so many rounds had nothing quiet.
constexpr size_t LOUD_ROUNDS = 3;

// All rounds of a set of methods wait so long for quiet cores.
constexpr double PATIENCE_ms = 2500.0;

struct Sample {
  double wall = 0.0;
  double cpu = 0.0;
  double gpu = 0.0;
  /// The worse before and after.
  CoreState cores;
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

// Cores between samples.
class Cores {
 public:
  explicit Cores(ProbeCores probe) : probe_(std::move(probe)), state_(probe_(0.0)) {}
  // Waits for quiet cores as long as patience lasts.
  void await() {
    if (!areQuiet(state_)) {
      const double start = wallClock_ms();
      state_ = probe_(patience_ms_);
      patience_ms_ = std::max(patience_ms_ - (wallClock_ms() - start), 0.0);
    }
  }
  // The worse of before and after what was done since the call before.
  CoreState around() {
    const CoreState before = std::exchange(state_, probe_(0.0));
    return {std::max(before.handover_ns, state_.handover_ns),
            std::max(before.work_ns, state_.work_ns)};
  }

 private:
  ProbeCores probe_;
  CoreState state_;
  double patience_ms_ = PATIENCE_ms;
};

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

double least(const std::vector<Sample>& samples, double Sample::*time) {
  double result = std::numeric_limits<double>::infinity();
  for (const Sample& sample : samples) {
    result = std::min(result, sample.*time);
  }
  return result;
}

// Two at least: of four or five a third would be a single one.
double fastThirdOf(const std::vector<Sample>& samples, double Sample::*time) {
  std::vector<double> times = column(samples, time);
  std::sort(times.begin(), times.end());
  times.resize(std::min(std::max<size_t>(times.size() / 3, 2), times.size()));
  return std::accumulate(times.begin(), times.end(), 0.0) / static_cast<double>(times.size());
}

std::vector<Sample> quietOf(const std::vector<Sample>& samples) {
  std::vector<Sample> quiet;
  std::copy_if(samples.begin(), samples.end(), std::back_inserter(quiet),
               [](const Sample& sample) { return areQuiet(sample.cores); });
  return quiet;
}

CoreState typical(const std::vector<Sample>& samples) {
  std::vector<double> handovers;
  std::vector<double> works;
  for (const Sample& sample : samples) {
    handovers.push_back(sample.cores.handover_ns);
    works.push_back(sample.cores.work_ns);
  }
  return {medianOf(handovers), medianOf(works)};
}

bool isUnsure(const std::vector<Sample>& samples) {
  std::vector<double> walls = column(quietOf(samples), &Sample::wall);
  std::sort(walls.begin(), walls.end());
  return walls.size() < CONFIRMED || walls[CONFIRMED - 1] > UNSURE * walls.front();
}

// In quiet rounds, or in all if those are too few.
std::vector<Sample> bestOf(const std::vector<Sample>& samples) {
  std::vector<Sample> quiet = quietOf(samples);
  return quiet.size() < ENOUGH_QUIET ? samples : quiet;
}

// `anchor`: in the same rounds; `anchorEver`: in all.
Timing summarise(const std::vector<Sample>& samples, const std::vector<Sample>& anchor,
                 const std::vector<Sample>& anchorEver) {
  const std::vector<Sample> best = bestOf(samples);
  const std::vector<Sample> anchorBest = bestOf(anchorEver);
  Timing timing;
  timing.wall = medianOf(column(best, &Sample::wall));
  std::vector<double> distance;
  for (const Sample& sample : best) {
    distance.push_back(std::abs(sample.wall - timing.wall));
  }
  timing.wallDeviation = medianOf(distance);
  timing.cpu = medianOf(column(best, &Sample::cpu));
  timing.gpu = medianOf(column(best, &Sample::gpu));
  timing.fastest = least(best, &Sample::wall);
  timing.leastCpu = least(best, &Sample::cpu);
  timing.ratio = timing.fastest / least(anchorBest, &Sample::wall);
  timing.cpuRatio = timing.leastCpu / least(anchorBest, &Sample::cpu);
  timing.fastThird = fastThirdOf(best, &Sample::wall);
  timing.fastThirdCpu = fastThirdOf(best, &Sample::cpu);
  timing.rounds = samples.size();
  timing.quietRounds = quietOf(samples).size();
  timing.cores = typical(best);
  const std::vector<double> byRound = ratios(samples, anchor, &Sample::wall);
  timing.medianRatio = medianOf(byRound);
  timing.medianCpuRatio = medianOf(ratios(samples, anchor, &Sample::cpu));
  // The count of samples below the median is binomial: n/2 +- 1.96 sqrt(n)/2.
  const auto n = static_cast<double>(byRound.size());
  const double rank = std::floor(0.5 * n - 0.98 * std::sqrt(n));
  const size_t skip = rank > 0.0 ? static_cast<size_t>(rank) : 0;
  timing.medianRatioLow = byRound[skip];
  timing.medianRatioHigh = byRound[byRound.size() - 1 - skip];
  return timing;
}

double geometricMean(const std::vector<Timing>& timings, double Timing::*time) {
  double sum = 0.0;
  for (const Timing& timing : timings) {
    sum += std::log(timing.*time);
  }
  return std::exp(sum / static_cast<double>(timings.size()));
}

void relate(std::vector<Timing>& timings) {
  const double wall = geometricMean(timings, &Timing::fastThird);
  const double cpu = geometricMean(timings, &Timing::fastThirdCpu);
  for (Timing& timing : timings) {
    timing.relative = timing.fastThird / wall;
    timing.relativeCpu = timing.fastThirdCpu / cpu;
  }
}

// How one method is timed.
struct Turn {
  double frame_ms = std::numeric_limits<double>::infinity();
  size_t repeats = 1;
  size_t copies = 1;
  /// Rounds from one timing to the next.
  size_t stride = 1;
};

Turn warmUp(const Copies& copies, size_t warmUps) {
  Turn turn;
  turn.copies = copies.size();
  for (size_t copy = 0; copy < turn.copies; ++copy) {
    double spent = 0.0;
    for (size_t k = 0; k < warmUps && spent < LONG_WARM_UP_ms; ++k) {
      const double wall = timeFrames(copies[copy], 1).wall;
      turn.frame_ms = std::min(turn.frame_ms, wall);
      spent += copy == 0 && k == 0 ? 0.0 : wall;
      if (wall > LONG_FIRST_ms) {
        turn.copies = 1;
      }
    }
  }
  const double wanted = std::ceil(MIN_ROUND_ms / std::max(turn.frame_ms, 1e-3));
  turn.repeats = std::clamp<size_t>(static_cast<size_t>(wanted), 1, MAX_REPEATS);
  const double longer = turn.frame_ms / (LONG_ROUND * MIN_ROUND_ms);
  turn.stride = std::clamp<size_t>(1 + static_cast<size_t>(longer), 1, MAX_STRIDE);
  return turn;
}

}  // namespace

double medianOf(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

std::vector<Timing> interleave(const std::vector<Copies>& methods, size_t anchor, size_t warmUps,
                               size_t rounds, ProbeCores probe) {
  const bool onCores = pinDriverThreads() > 1;
  if (!probe) {
    probe = onCores ? awaitQuietCores : [](double) { return CoreState{}; };
  }
  std::vector<Turn> turns;
  double round_ms = 0;
  for (size_t i = 0; i < methods.size(); ++i) {
    turns.push_back(warmUp(methods[i], warmUps));
    if (i == anchor) {
      turns[i].stride = 1;
    }
    round_ms += turns[i].frame_ms * static_cast<double>(turns[i].repeats) /
                static_cast<double>(turns[i].stride);
  }
  const size_t asked = rounds;
  const auto fill = static_cast<size_t>(MIN_STUDY_ms / round_ms);
  rounds = std::max(std::clamp(fill, rounds, MORE_ROUNDS * rounds), MAX_STRIDE);
  std::vector<std::vector<Sample>> samples(methods.size());
  std::vector<std::vector<Sample>> anchors(methods.size());  // of the same rounds
  Cores cores(std::move(probe));
  size_t loud = 0;  // rounds since there was a quiet sample
  const auto time = [&](const std::vector<size_t>& due) {
    bool someQuiet = false;
    for (const size_t i : due) {
      cores.await();
      const RenderFrame& frame = methods[i][samples[i].size() % turns[i].copies];
      samples[i].push_back(timeFrames(frame, turns[i].repeats));
      samples[i].back().cores = cores.around();
      someQuiet = someQuiet || areQuiet(samples[i].back().cores);
    }
    for (const size_t i : due) {
      anchors[i].push_back(samples[anchor].back());
    }
    loud = someQuiet ? 0 : loud + 1;
  };
  for (size_t round = 0; round < rounds; ++round) {
    std::vector<size_t> due;
    for (size_t k = 0; k < methods.size(); ++k) {
      const size_t i = (k + round) % methods.size();
      if ((i + round) % turns[i].stride == 0) {
        due.push_back(i);
      }
    }
    time(due);
  }
  for (size_t more = 0; more < UNSURE_ROUNDS * asked && loud < LOUD_ROUNDS; ++more) {
    std::vector<size_t> due = {anchor};
    for (size_t i = 0; i < methods.size(); ++i) {
      const bool timely = more < asked || turns[i].frame_ms < LONG_ROUND * MIN_ROUND_ms;
      if (i != anchor && timely && isUnsure(samples[i])) {
        due.push_back(i);
      }
    }
    if (due.size() == 1 && !isUnsure(samples[anchor])) {
      break;
    }
    std::rotate(due.begin(), due.begin() + static_cast<ptrdiff_t>(more % due.size()), due.end());
    time(due);
  }
  std::vector<Timing> timings;
  for (size_t i = 0; i < methods.size(); ++i) {
    timings.push_back(summarise(samples[i], anchors[i], samples[anchor]));
  }
  relate(timings);
  return timings;
}

}  // namespace bench
