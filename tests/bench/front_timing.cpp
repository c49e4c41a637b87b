// SPDX-License-Identifier: MIT
#include "bench/front_timing.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <iterator>
#include <limits>
#include <map>
#include <random>
#include <utility>

#include "bench/cores.hpp"
#include "bench/driver_threads.hpp"

namespace bench {
namespace {

// On all cores a frame is repeated until a round spends this long on it: timers and schedulers then
// matter some per cent. Many short rounds follow a machine whose speed drifts better than few long
// ones.
constexpr double MIN_ROUND_ms = 10.0;
constexpr size_t MAX_REPEATS = 64;
// Cheap sets of methods get more rounds in takeRounds, up to MORE_ROUNDS times as many.
constexpr double MIN_STUDY_ms = 2000.0;
constexpr size_t MORE_ROUNDS = 7;
// Warm-ups of a copy end when they took this long, the first frame of all, which compiles, left
// out: what is made once is then a small part of a frame.
constexpr double LONG_WARM_UP_ms = 60.0;
// A method whose first frame takes longer than this (light of all orders) is not copied.
constexpr double LONG_FIRST_ms = 1000.0;
// In takeRounds. Long frames differ less: from so many times MIN_ROUND_ms on a method is timed in
// every second round.
constexpr double LONG_ROUND = 10.0;
constexpr size_t MAX_STRIDE = 2;
// Rounds of a block, and what a method may take of each, ms: longer frames are timed in every
// second one, the longest in one of four. Short frames scatter most, and cost least.
constexpr size_t BLOCK_ROUNDS = 4;
constexpr double SHORT_ms = 60.0;
constexpr double LONG_ms = 320.0;
// Every order has each method beside others, so that what the machine adds can be told.
constexpr uint32_t ORDERS_SEED = 1;
// A method whose fastest quiet rounds, CONFIRMED of them, differ by more than this (last / first)
// is timed in more rounds, up to UNSURE_ROUNDS times as many as were asked for, long ones up to as
// many.
constexpr size_t CONFIRMED = ENOUGH_QUIET;
constexpr double UNSURE = 1.02;
constexpr size_t UNSURE_ROUNDS = 2;
// Unless so many rounds had nothing quiet.
constexpr size_t LOUD_ROUNDS = 3;

// All rounds of a set of methods wait so long for quiet cores, blocks such a part of what those
// before took.
constexpr double PATIENCE_ms = 2500.0;
constexpr double PATIENCE = 0.1;

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

FrameTime timeFrames(const RenderFrame& frame, size_t repeats) {
  FrameTime sample;
  const double wall = wallClock_ms();
  const double cpu = processClock_ms();
  for (size_t i = 0; i < repeats; ++i) {
    sample.gpu += frame();
  }
  sample.cpu = processClock_ms() - cpu;
  sample.wall = wallClock_ms() - wall;
  const auto count = static_cast<double>(repeats);
  sample.wall /= count;
  sample.cpu /= count;
  sample.gpu /= count;
  return sample;
}

std::vector<double> ratios(const std::vector<FrameTime>& samples,
                           const std::vector<FrameTime>& anchor, double FrameTime::*time) {
  std::vector<double> result;
  for (size_t i = 0; i < samples.size(); ++i) {
    result.push_back(samples[i].*time / (anchor[i].*time));
  }
  std::sort(result.begin(), result.end());
  return result;
}

std::vector<double> column(const std::vector<FrameTime>& samples, double FrameTime::*time) {
  std::vector<double> result;
  for (const FrameTime& sample : samples) {
    result.push_back(sample.*time);
  }
  return result;
}

double least(const std::vector<FrameTime>& samples, double FrameTime::*time) {
  double result = std::numeric_limits<double>::infinity();
  for (const FrameTime& sample : samples) {
    result = std::min(result, sample.*time);
  }
  return result;
}

std::vector<FrameTime> quietOf(const std::vector<FrameTime>& samples) {
  std::vector<FrameTime> quiet;
  std::copy_if(samples.begin(), samples.end(), std::back_inserter(quiet),
               [](const FrameTime& sample) { return areQuiet(sample.cores); });
  return quiet;
}

CoreState typical(const std::vector<FrameTime>& samples) {
  std::vector<double> handovers;
  std::vector<double> works;
  for (const FrameTime& sample : samples) {
    handovers.push_back(sample.cores.handover_ns);
    works.push_back(sample.cores.work_ns);
  }
  return {medianOf(handovers), medianOf(works)};
}

bool isUnsure(const std::vector<FrameTime>& samples) {
  std::vector<double> walls = column(quietOf(samples), &FrameTime::wall);
  std::sort(walls.begin(), walls.end());
  return walls.size() < CONFIRMED || walls[CONFIRMED - 1] > UNSURE * walls.front();
}

// In quiet rounds, or in all if those are too few.
std::vector<FrameTime> bestOf(const std::vector<FrameTime>& samples) {
  std::vector<FrameTime> quiet = quietOf(samples);
  return quiet.size() < ENOUGH_QUIET ? samples : quiet;
}

// `anchor`: in the same rounds; `anchorEver`: in all.
Timing summarise(const std::vector<FrameTime>& samples, const std::vector<FrameTime>& anchor,
                 const std::vector<FrameTime>& anchorEver) {
  const std::vector<FrameTime> best = bestOf(samples);
  const std::vector<FrameTime> anchorBest = bestOf(anchorEver);
  Timing timing;
  timing.wall = medianOf(column(best, &FrameTime::wall));
  std::vector<double> distance;
  for (const FrameTime& sample : best) {
    distance.push_back(std::abs(sample.wall - timing.wall));
  }
  timing.wallDeviation = medianOf(distance);
  timing.cpu = medianOf(column(best, &FrameTime::cpu));
  timing.gpu = medianOf(column(best, &FrameTime::gpu));
  timing.fastest = least(best, &FrameTime::wall);
  timing.leastCpu = least(best, &FrameTime::cpu);
  timing.ratio = timing.fastest / least(anchorBest, &FrameTime::wall);
  timing.cpuRatio = timing.leastCpu / least(anchorBest, &FrameTime::cpu);
  timing.rounds = samples.size();
  timing.quietRounds = quietOf(samples).size();
  timing.cores = typical(best);
  const std::vector<double> byRound = ratios(samples, anchor, &FrameTime::wall);
  timing.medianRatio = medianOf(byRound);
  timing.medianCpuRatio = medianOf(ratios(samples, anchor, &FrameTime::cpu));
  // The count of samples below the median is binomial: n/2 +- 1.96 sqrt(n)/2.
  const auto n = static_cast<double>(byRound.size());
  const double rank = std::floor(0.5 * n - 0.98 * std::sqrt(n));
  const size_t skip = rank > 0.0 ? static_cast<size_t>(rank) : 0;
  timing.medianRatioLow = byRound[skip];
  timing.medianRatioHigh = byRound[byRound.size() - 1 - skip];
  return timing;
}

std::vector<std::vector<FrameTime>> byMethod(const std::vector<FrameTime>& samples,
                                             size_t methods) {
  std::vector<std::vector<FrameTime>> result(methods);
  for (const FrameTime& sample : samples) {
    result[sample.method].push_back(sample);
  }
  return result;
}

std::vector<RelativeTime> relate(const std::vector<FrameTime>& samples, size_t methods,
                                 double FrameTime::*time) {
  std::vector<TimedMethod> timed;
  for (const FrameTime& sample : samples) {
    timed.push_back({sample.method, sample.*time, sample.block});
  }
  return relativeTimes(timed, methods);
}

CoreState nobodyLooks(double /*patience_ms*/) {
  return {};
}

}  // namespace

// How one method is timed.
struct Sampler::Turn {
  double frame_ms = std::numeric_limits<double>::infinity();
  /// Of all threads, but no less than a frame takes: on one core it takes that long.
  double work_ms = std::numeric_limits<double>::infinity();
  size_t repeats = 1;
  size_t copies = 1;
  /// Rounds from one timing to the next, in takeRounds and in blocks: on all cores, on one.
  size_t stride = 1;
  std::array<size_t, 2> blockStrides{};

  Turn(const Copies& frames, size_t warmUps) : copies(frames.size()) {
    for (size_t copy = 0; copy < frames.size(); ++copy) {
      double spent = 0.0;
      for (size_t k = 0; k < warmUps && spent < LONG_WARM_UP_ms; ++k) {
        const FrameTime frame = timeFrames(frames[copy], 1);
        const double wall = frame.wall;
        frame_ms = std::min(frame_ms, wall);
        work_ms = std::min(work_ms, std::max(wall, frame.cpu));
        spent += copy == 0 && k == 0 ? 0.0 : wall;
        if (copy == 0 && k == 0 && wall > LONG_FIRST_ms) {
          copies = 1;
        }
      }
      if (copies == 1) {
        break;
      }
    }
    const double wanted = std::ceil(MIN_ROUND_ms / std::max(frame_ms, 1e-3));
    repeats = std::clamp<size_t>(static_cast<size_t>(wanted), 1, MAX_REPEATS);
    const double longer = frame_ms / (LONG_ROUND * MIN_ROUND_ms);
    stride = std::clamp<size_t>(1 + static_cast<size_t>(longer), 1, MAX_STRIDE);
    blockStrides = {blockStrideOf(frame_ms), blockStrideOf(work_ms)};
  }
  [[nodiscard]] double round_ms() const {
    return frame_ms * static_cast<double>(repeats) / static_cast<double>(stride);
  }

 private:
  static size_t blockStrideOf(double time_ms) {
    if (time_ms <= SHORT_ms) {
      return 1;
    }
    return time_ms <= LONG_ms ? 2 : BLOCK_ROUNDS;
  }
};

// Cores between samples.
class Sampler::Cores {
 public:
  Cores(const ProbeCores& probe, double patience_ms)
      : probe_(probe), state_(probe_(0.0)), patience_ms_(patience_ms) {}
  // Waits for quiet cores as long as patience lasts; how long it did.
  double await() {
    if (areQuiet(state_) || patience_ms_ <= 0.0) {
      return 0.0;
    }
    const double start = wallClock_ms();
    state_ = probe_(patience_ms_);
    const double waited = wallClock_ms() - start;
    patience_ms_ -= waited;
    return waited;
  }
  // The worse of before and after what was done since the call before.
  CoreState around() {
    const CoreState before = std::exchange(state_, probe_(0.0));
    return {std::max(before.handover_ns, state_.handover_ns),
            std::max(before.work_ns, state_.work_ns)};
  }

 private:
  const ProbeCores& probe_;
  CoreState state_;
  double patience_ms_;
};

Sampler::Sampler(std::vector<Copies> methods, size_t anchor, size_t warmUps, ProbeCores probe)
    : methods_(std::move(methods)),
      anchor_(anchor),
      probe_(std::move(probe)),
      driverCores_(pinDriverThreads()),
      random_(ORDERS_SEED) {
  taken_.fill(std::vector<size_t>(methods_.size()));
  if (!probe_) {
    probe_ = driverCores_ > 1 ? awaitQuietCores : nobodyLooks;
  }
  for (const Copies& copies : methods_) {
    turns_.emplace_back(copies, warmUps);
  }
}

Sampler::~Sampler() = default;

void Sampler::take(Cores& cores, std::vector<size_t> due) {
  std::shuffle(due.begin(), due.end(), random_);
  for (const size_t i : due) {
    waited_ms_ += cores.await();
    const RenderFrame& frame = methods_[i][taken_.at(onOneCore_)[i]++ % turns_[i].copies];
    // On one core once: the first of some takes longer, what others left in the caches, and how
    // many there are hangs on how fast the warm-ups were.
    const bool once = onOneCore_ || driverCores_ == 1;
    FrameTime sample = timeFrames(frame, once ? 1 : turns_[i].repeats);
    sample.method = i;
    sample.round = round_;
    sample.block = block_;
    sample.onOneCore = onOneCore_;
    sample.cores = cores.around();
    samples_.push_back(sample);
  }
  ++round_;
}

void Sampler::takeRound(Cores& cores, bool ofBlock) {
  std::vector<size_t> due;
  for (size_t i = 0; i < methods_.size(); ++i) {
    const Turn& turn = turns_[i];
    const size_t stride = ofBlock ? turn.blockStrides.at(onOneCore_) : turn.stride;
    // Of each block's rounds others; ratios to the anchor are of rounds on all cores.
    const bool isDue = (i + round_ + blocks_.at(onOneCore_)) % stride == 0;
    if (isDue || (i == anchor_ && !onOneCore_)) {
      due.push_back(i);
    }
  }
  take(cores, std::move(due));
}

void Sampler::takeBlock(bool onOneCore) {
  onOneCore_ = onOneCore;
  const double start = wallClock_ms();
  const ProbeCores none = nobodyLooks;
  Cores cores(onOneCore ? none : probe_, PATIENCE * spent_ms_ - waited_ms_);
  for (size_t i = 0; i < BLOCK_ROUNDS; ++i) {
    takeRound(cores, true);
  }
  ++block_;
  ++blocks_.at(onOneCore);
  spent_ms_ += wallClock_ms() - start;
}

void Sampler::takeRounds(size_t rounds) {
  onOneCore_ = false;
  double round_ms = 0.0;
  for (const Turn& turn : turns_) {
    round_ms += turn.round_ms();
  }
  const double start = wallClock_ms();
  Cores cores(probe_, PATIENCE_ms);
  const auto fill = static_cast<size_t>(MIN_STUDY_ms / round_ms);
  const size_t most = std::max(std::clamp(fill, rounds, MORE_ROUNDS * rounds), MAX_STRIDE);
  size_t loud = 0;  // rounds since there was a quiet sample
  const auto note = [&](size_t before) {
    const auto first = samples_.begin() + static_cast<ptrdiff_t>(before);
    const bool someQuiet = std::any_of(
        first, samples_.end(), [](const FrameTime& sample) { return areQuiet(sample.cores); });
    loud = someQuiet ? 0 : loud + 1;
  };
  for (size_t done = 0; done < most; ++done) {
    const size_t before = samples_.size();
    takeRound(cores, false);
    note(before);
  }
  for (size_t done = 0; done < UNSURE_ROUNDS * rounds && loud < LOUD_ROUNDS; ++done) {
    const std::vector<std::vector<FrameTime>> own = byMethod(samples_, methods_.size());
    std::vector<size_t> due = {anchor_};
    for (size_t i = 0; i < methods_.size(); ++i) {
      const bool timely = done < rounds || turns_[i].frame_ms < LONG_ROUND * MIN_ROUND_ms;
      if (i != anchor_ && timely && isUnsure(own[i])) {
        due.push_back(i);
      }
    }
    if (due.size() == 1 && !isUnsure(own[anchor_])) {
      break;
    }
    const size_t before = samples_.size();
    take(cores, std::move(due));
    note(before);
  }
  ++block_;
  spent_ms_ += wallClock_ms() - start;
}

std::vector<Timing> timingsOf(const std::vector<FrameTime>& samples, size_t methods,
                              size_t anchor) {
  std::vector<FrameTime> all = samples;
  const auto split = std::stable_partition(
      all.begin(), all.end(), [](const FrameTime& sample) { return !sample.onOneCore; });
  const std::vector<FrameTime> onOne(split, all.end());
  all.erase(split, all.end());
  const std::vector<FrameTime>& related = onOne.empty() ? all : onOne;
  const std::vector<RelativeTime> relative = relate(related, methods, &FrameTime::wall);
  const std::vector<RelativeTime> relativeCpu = relate(related, methods, &FrameTime::cpu);
  const std::vector<std::vector<FrameTime>> own = byMethod(all, methods);
  const std::vector<std::vector<FrameTime>> ownOnOne = byMethod(onOne, methods);
  std::map<size_t, FrameTime> anchorIn;
  for (const FrameTime& sample : own[anchor]) {
    anchorIn[sample.round] = sample;
  }
  std::vector<Timing> timings;
  for (size_t i = 0; i < methods; ++i) {
    std::vector<FrameTime> anchors;
    for (const FrameTime& sample : own[i]) {
      anchors.push_back(anchorIn.at(sample.round));
    }
    Timing& timing = timings.emplace_back(summarise(own[i], anchors, own[anchor]));
    timing.relative = relative[i];
    timing.relativeCpu = relativeCpu[i];
    timing.oneCoreRounds = ownOnOne[i].size();
  }
  return timings;
}

std::vector<Timing> interleave(const std::vector<Copies>& methods, size_t anchor, size_t warmUps,
                               size_t rounds, ProbeCores probe) {
  Sampler sampler(methods, anchor, warmUps, std::move(probe));
  sampler.takeRounds(rounds);
  return timingsOf(sampler.samples(), methods.size(), anchor);
}

}  // namespace bench
