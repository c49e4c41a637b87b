// SPDX-License-Identifier: MIT
// Times of several methods against one of them, interleaved so that what else the machine does hits
// all alike. ms.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <random>
#include <vector>

#include "bench/cores.hpp"
#include "bench/front_relative.hpp"

namespace bench {

/// So many rounds on quiet cores are enough to leave the others out.
constexpr size_t ENOUGH_QUIET = 3;

/// Of the method's rounds on quiet cores, of all if those are fewer than ENOUGH_QUIET. Rounds on
/// one core count for relative times only.
struct Timing {
  /// Median over the rounds, and the median distance from it. ms.
  double wall = 0.0;
  double wallDeviation = 0.0;
  double cpu = 0.0;
  double gpu = 0.0;
  /// The fastest round's, and the least CPU time of a round. ms.
  double fastest = 0.0;
  double leastCpu = 0.0;
  /// Those over the anchor's. What else a machine does adds to times, and adds to short and long
  /// frames alike, so that medians of ratios differ between runs.
  double ratio = 1.0;
  double cpuRatio = 1.0;
  /// Of all rounds on one core, of all if there are none: what the machine adds is taken off.
  RelativeTime relative;
  RelativeTime relativeCpu;
  size_t oneCoreRounds = 0;
  /// Median over all rounds on all cores of time / anchor's time in that round; low and high: order
  /// statistics that hold the median with 95 % confidence (all rounds if there are fewer than six).
  double medianRatio = 1.0;
  double medianRatioLow = 1.0;
  double medianRatioHigh = 1.0;
  /// The same of CPU times.
  double medianCpuRatio = 1.0;
  /// In all on all cores, and those with quiet cores before and after: all where nobody looked, as
  /// with one core or a driver on none.
  size_t rounds = 0;
  size_t quietRounds = 0;
  /// Median around the rounds that count; 0: nobody looked.
  CoreState cores;
};

/// Renders one frame and returns its GPU time in ms.
using RenderFrame = std::function<double()>;

/// One method: copies of its frame whose memory lies elsewhere, which alone may change a time by
/// some per cent. Rounds take them in turn.
using Copies = std::vector<RenderFrame>;

/// Waits for quiet cores no longer than so many ms; what they are like then.
using ProbeCores = std::function<CoreState(double)>;

/// One round of one method, a frame or the mean of some. ms.
struct FrameTime {
  size_t method = 0;
  size_t round = 0;
  /// What stands beside each other in one block was taken one right after another.
  size_t block = 0;
  bool onOneCore = false;
  double wall = 0.0;
  double cpu = 0.0;
  double gpu = 0.0;
  /// The worse before and after; zeros: nobody looked.
  CoreState cores;
};

/// Times several methods in turn: every method once per round, in another order each round, each
/// when cores are quiet, or when it has waited too long for that. On all cores a frame too short to
/// time alone is repeated and its mean taken. Long frames miss some rounds.
class Sampler {
 public:
  /// Gives the driver's threads a core each, then calls every copy as often as its warm-ups ask.
  /// `probe`: awaitQuietCores if there is none and the driver's threads are on several cores.
  Sampler(std::vector<Copies> methods, size_t anchor, size_t warmUps, ProbeCores probe = nullptr);
  ~Sampler();
  Sampler(const Sampler&) = delete;
  Sampler& operator=(const Sampler&) = delete;

  /// Rounds in which every method is timed, one right after another: a block of its own. Waits for
  /// a tenth of the time of all blocks. `onOneCore`: as the caller has placed the threads; nothing
  /// is waited for then.
  void takeBlock(bool onOneCore = false);
  /// So many rounds at least, all one block; cheap sets of methods get more, and methods whose
  /// fastest quiet rounds differ. Waits 2.5 s at the most.
  void takeRounds(size_t rounds);
  /// On how many cores the driver's threads are; 0: it has none in this process.
  [[nodiscard]] size_t driverCores() const { return driverCores_; }
  /// In the order taken.
  [[nodiscard]] const std::vector<FrameTime>& samples() const { return samples_; }

 private:
  struct Turn;
  class Cores;

  void takeRound(Cores& cores, bool ofBlock);
  void take(Cores& cores, std::vector<size_t> due);

  std::vector<Copies> methods_;
  size_t anchor_;
  ProbeCores probe_;
  size_t driverCores_;
  std::vector<Turn> turns_;
  std::mt19937 random_;
  std::array<std::vector<size_t>, 2> taken_;  // on all cores, on one; by method
  size_t round_ = 0;
  size_t block_ = 0;
  std::array<size_t, 2> blocks_{};  // on all cores, on one
  bool onOneCore_ = false;
  double spent_ms_ = 0.0;
  double waited_ms_ = 0.0;
  std::vector<FrameTime> samples_;
};

/// Each method has a sample at least that is not of one core, and of those too if there are any,
/// and in its rounds on all cores the anchor has one.
std::vector<Timing> timingsOf(const std::vector<FrameTime>& samples, size_t methods, size_t anchor);

/// Times of `rounds` rounds, Sampler::takeRounds.
std::vector<Timing> interleave(const std::vector<Copies>& methods, size_t anchor, size_t warmUps,
                               size_t rounds, ProbeCores probe = nullptr);

}  // namespace bench
