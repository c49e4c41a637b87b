// SPDX-License-Identifier: MIT
// How long methods take relative to each other, from samples that were taken in turn on a machine
// that is now faster and now slower.
#pragma once

#include <cstddef>
#include <vector>

namespace bench {

struct RelativeTime {
  /// Over the geometric mean of all methods: a yardstick of the same run, which hardly follows a
  /// single one of many.
  double time = 1.0;
  /// Standard error, as a part of it, as far as samples' scatter tells: what differs between two
  /// processes only, as where memory lies, is not in it. NaN: of a single sample.
  double error = 0.0;
};

struct TimedMethod {
  size_t method = 0;
  double time = 0.0;  // > 0, any unit
  /// What was taken in other blocks tells nothing of how fast the machine was.
  size_t block = 0;
};

/// `samples`: in the order taken, of `methods` methods, each there once at least; not always the
/// same ones beside each other. Their logarithms are what the method takes, plus what the machine
/// adds then, plus noise. What it adds changes slowly: the median of three samples before and three
/// after tells it, each less its own method's time. A method's time is the mean of the middle half
/// of its samples less that.
std::vector<RelativeTime> relativeTimes(const std::vector<TimedMethod>& samples, size_t methods);

double medianOf(std::vector<double> values);

}  // namespace bench
