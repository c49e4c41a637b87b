// SPDX-License-Identifier: MIT
#include "bench/front_relative.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace bench {
namespace {

// Samples to each side that tell how fast the machine was. Of two pairs of runs on a loud machine 1
// to 8 left 15 to 16 of 196 and 2 to 6 of 187 CPU times that differed by more than 5 %.
constexpr size_t NEIGHBOURS = 3;
// Each goes half the way to where it is at rest, so that none swings, until none moves by REST.
constexpr double STEP = 0.5;
constexpr double REST = 1e-7;
constexpr size_t MOST_ITERATIONS = 200;
// The outer quarters are left out, of three samples two.
constexpr size_t TRIM = 4;
constexpr size_t LEAST_TRIMMED = 3;

struct Mean {
  double value = 0.0;
  double error = 0.0;
};

// Of the middle half. Its standard error is that of the values with the outer quarters drawn to the
// edges of the middle (Tukey and McLaughlin 1963), of all values where one is left.
Mean middleMean(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const size_t count = values.size();
  const size_t left = count < LEAST_TRIMMED ? 0 : std::max<size_t>(count / TRIM, 1);
  const size_t kept = count - 2 * left;
  const auto from = values.begin() + static_cast<ptrdiff_t>(left);
  const auto to = from + static_cast<ptrdiff_t>(kept);
  Mean mean;
  mean.value = std::accumulate(from, to, 0.0) / static_cast<double>(kept);
  const bool draw = kept > 1;
  if (draw) {
    std::fill(values.begin(), from, *from);
    std::fill(to, values.end(), *(to - 1));
  }
  const double middle =
      std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(count);
  double squares = 0.0;
  for (const double value : values) {
    squares += (value - middle) * (value - middle);
  }
  const auto n = static_cast<double>(draw ? kept : count);
  mean.error = std::sqrt(squares / (n * (n - 1.0)));  // 0 / 0: nothing tells
  return mean;
}

// What the samples around add to their methods' times: the median, since a mean of samples that are
// often the same methods' would amplify what middle means leave out.
double addedAround(const std::vector<TimedMethod>& samples, const std::vector<double>& added,
                   size_t at) {
  const size_t first = at - std::min(at, NEIGHBOURS);
  const size_t last = std::min(at + NEIGHBOURS + 1, added.size());
  std::vector<double> around;
  for (size_t k = first; k < last; ++k) {
    if (k != at && samples[k].block == samples[at].block) {
      around.push_back(added[k]);
    }
  }
  return around.empty() ? 0.0 : medianOf(std::move(around));
}

std::vector<Mean> meansOf(const std::vector<TimedMethod>& samples,
                          const std::vector<double>& values, size_t methods) {
  std::vector<std::vector<double>> ofMethod(methods);
  for (size_t k = 0; k < samples.size(); ++k) {
    ofMethod[samples[k].method].push_back(values[k]);
  }
  std::vector<Mean> means;
  double all = 0.0;
  for (std::vector<double>& own : ofMethod) {
    means.push_back(middleMean(std::move(own)));
    all += means.back().value / static_cast<double>(methods);
  }
  for (Mean& mean : means) {
    mean.value -= all;
  }
  return means;
}

}  // namespace

double medianOf(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

std::vector<RelativeTime> relativeTimes(const std::vector<TimedMethod>& samples, size_t methods) {
  std::vector<double> logs;
  for (const TimedMethod& sample : samples) {
    logs.push_back(std::log(sample.time));
  }
  std::vector<Mean> means = meansOf(samples, logs, methods);
  std::vector<double> added(samples.size());
  std::vector<double> own(samples.size());
  double moved = 1.0;
  for (size_t iteration = 0; iteration < MOST_ITERATIONS && moved > REST; ++iteration) {
    for (size_t k = 0; k < samples.size(); ++k) {
      added[k] = logs[k] - means[samples[k].method].value;
    }
    for (size_t k = 0; k < samples.size(); ++k) {
      own[k] = logs[k] - addedAround(samples, added, k);
    }
    const std::vector<Mean> next = meansOf(samples, own, methods);
    moved = 0.0;
    for (size_t i = 0; i < methods; ++i) {
      const double step = STEP * (next[i].value - means[i].value);
      means[i] = {means[i].value + step, next[i].error};
      moved = std::max(moved, std::abs(step));
    }
  }
  std::vector<RelativeTime> result;
  for (const Mean& mean : means) {
    result.push_back({std::exp(mean.value), mean.error});
  }
  return result;
}

}  // namespace bench
