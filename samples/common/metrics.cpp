// SPDX-License-Identifier: MIT
#include "common/metrics.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace host {
namespace {

// Neumaier's sum: a few 1e8 samples of mixed size lose nothing.
class Sum {
 public:
  void add(double x) {
    const double total = sum_ + x;
    lost_ += std::abs(sum_) >= std::abs(x) ? (sum_ - total) + x : (x - total) + sum_;
    sum_ = total;
  }
  [[nodiscard]] double value() const { return sum_ + lost_; }

 private:
  double sum_ = 0.0;
  double lost_ = 0.0;
};

// Calls visit(a, b) for each colour sample that is finite in both; returns the number of others.
template <class Visit>
uint64_t visitSamples(const Image& picture, const Image& reference, const Visit& visit) {
  uint64_t nonFinite = 0;
  const size_t count = std::min(picture.rgba.size(), reference.rgba.size());
  for (size_t i = 0; i < count; ++i) {
    if (i % 4 == 3) {
      continue;
    }
    const double a = double{picture.rgba[i]};
    const double b = double{reference.rgba[i]};
    if (std::isfinite(a) && std::isfinite(b)) {
      visit(a, b);
    } else {
      ++nonFinite;
    }
  }
  return nonFinite;
}

}  // namespace

ImageMetrics compareImages(const Image& picture, const Image& reference) {
  ImageMetrics metrics;
  Sum magnitude;
  Sum difference;
  Sum square;
  metrics.nonFinite = visitSamples(picture, reference, [&](double a, double b) {
    magnitude.add(std::abs(b));
    difference.add(a - b);
    square.add((a - b) * (a - b));
    ++metrics.samples;
  });
  if (metrics.samples == 0) {
    return metrics;
  }
  const double count = static_cast<double>(metrics.samples);
  // An all-black reference has no scale: the smallest float keeps the quotients finite and huge.
  constexpr double SMALLEST_SCALE = 1e-38;
  metrics.referenceMean = magnitude.value() / count;
  const double scale = std::max(metrics.referenceMean, SMALLEST_SCALE);
  metrics.rmseOverMean = std::sqrt(square.value() / count) / scale;
  metrics.bias = difference.value() / count / scale;

  const double floor = 0.01 * scale;
  std::vector<double> errors;
  errors.reserve(metrics.samples);
  Sum relativeSquare;
  visitSamples(picture, reference, [&](double a, double b) {
    const double error = std::abs(a - b) / std::max(std::abs(b), floor);
    relativeSquare.add(error * error);
    errors.push_back(error);
  });
  metrics.relMse = relativeSquare.value() / count;
  metrics.maxRelativeError = *std::max_element(errors.begin(), errors.end());
  const auto rank = static_cast<size_t>(std::ceil(0.999 * count)) - 1;
  const auto nth = errors.begin() + static_cast<std::ptrdiff_t>(std::min(rank, errors.size() - 1));
  std::nth_element(errors.begin(), nth, errors.end());
  metrics.p999RelativeError = *nth;
  return metrics;
}

}  // namespace host
