// SPDX-License-Identifier: MIT
// Times of several methods against one of them, interleaved so that what else the machine does hits
// all alike. ms.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "bench/cores.hpp"
#include "bench/front_relative.hpp"

namespace bench {

/// So many rounds on quiet cores are enough to leave the others out.
constexpr size_t ENOUGH_QUIET = 3;

/// Of the method's rounds on quiet cores, of all if those are fewer than ENOUGH_QUIET.
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
  /// Of all rounds: what the machine adds is taken off.
  RelativeTime relative;
  RelativeTime relativeCpu;
  /// Median over all rounds of time / anchor's time in that round; low and high: order statistics
  /// that hold the median with 95 % confidence (all rounds if there are fewer than six).
  double medianRatio = 1.0;
  double medianRatioLow = 1.0;
  double medianRatioHigh = 1.0;
  /// The same of CPU times.
  double medianCpuRatio = 1.0;
  /// In all, and those with quiet cores before and after: all where nobody looked, as with one core
  /// or a driver on none.
  size_t rounds = 0;
  size_t quietRounds = 0;
  /// Median around the rounds that count; 0: nobody looked.
  CoreState cores;
};

/// Renders one frame and returns its GPU time in ms.
using RenderFrame = std::function<double()>;

/// One method: copies of its frame whose memory lies elsewhere, which alone may change a time by a
/// tenth. Rounds take them in turn.
using Copies = std::vector<RenderFrame>;

/// Waits for quiet cores no longer than so many ms; what they are like then.
using ProbeCores = std::function<CoreState(double)>;

/// One round of one method, a frame or the mean of some. ms.
struct FrameTime {
  size_t method = 0;
  size_t round = 0;
  double wall = 0.0;
  double cpu = 0.0;
  double gpu = 0.0;
  /// The worse before and after.
  CoreState cores;
};

struct Effort {
  /// Frames of each copy before any is timed.
  size_t warmUps = 1;
  /// At least.
  size_t rounds = 1;
  /// Rounds go on until they took so long. 0: cheap sets of methods get more rounds, and methods
  /// whose fastest quiet rounds differ.
  double least_ms = 0.0;
};

/// Gives the driver's threads a core each, calls every copy as often as its warm-ups ask, then
/// every method once per round, in another order each round, each when cores are quiet, until it
/// has waited 2.5 s or a tenth of `least_ms` for that; a frame too short to time alone is repeated
/// and its mean taken, long frames miss some rounds. Appends to `samples` in the order taken.
/// `probe`: awaitQuietCores if there is none and the driver's threads are on several cores.
void takeSamples(const std::vector<Copies>& methods, size_t anchor, const Effort& effort,
                 std::vector<FrameTime>& samples, ProbeCores probe = nullptr);

/// Each method has a sample at least, and in its rounds the anchor has one.
std::vector<Timing> timingsOf(const std::vector<FrameTime>& samples, size_t methods, size_t anchor);

/// Both.
std::vector<Timing> interleave(const std::vector<Copies>& methods, size_t anchor, size_t warmUps,
                               size_t rounds, ProbeCores probe = nullptr);

}  // namespace bench
