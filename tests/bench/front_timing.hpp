// SPDX-License-Identifier: MIT
// Times of several methods against one of them, interleaved so that what else the machine does hits
// all alike. ms.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "bench/cores.hpp"

namespace bench {

/// So many rounds on quiet cores are enough to leave the others out.
constexpr size_t ENOUGH_QUIET = 3;

/// Of the rounds on quiet cores, of all if those are fewer than ENOUGH_QUIET.
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
  /// Mean of the fastest third of the rounds, two at least. ms.
  double fastThird = 0.0;
  double fastThirdCpu = 0.0;
  /// Those over their geometric mean of all methods: a yardstick of the same run, which hardly
  /// follows a single one of many.
  double relative = 1.0;
  double relativeCpu = 1.0;
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

/// Gives the driver's threads a core each, calls every copy `warmUps` times, then every method once
/// per round, in an order that turns by one place each round, each when cores are quiet, until
/// it has waited 2.5 s for that; a frame too short to time alone is repeated and its mean taken,
/// cheap sets of methods get more rounds, long frames miss some, and methods whose fastest quiet
/// rounds differ get more. `probe`: awaitQuietCores if there is none and the driver's threads are
/// on several cores.
std::vector<Timing> interleave(const std::vector<Copies>& methods, size_t anchor, size_t warmUps,
                               size_t rounds, ProbeCores probe = nullptr);

double medianOf(std::vector<double> values);

}  // namespace bench
