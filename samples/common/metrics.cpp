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

// Calls visit(a, b, index) for each colour sample that is finite in both; returns the number of
// others.
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
      visit(a, b, i);
    } else {
      ++nonFinite;
    }
  }
  return nonFinite;
}

// What is left of a mean square once the mean variance of the reference is taken off.
double withoutNoise(double meanSquare, double variance) {
  return std::max(meanSquare - variance, 0.0);
}

}  // namespace

double nearestRank(std::vector<double>& values, double fraction) {
  if (values.empty()) {
    return 0.0;
  }
  // 0.95 and the like are not exact in binary: without the small term a product that should be a
  // whole number could end up above it.
  constexpr double ROUNDING = 1e-9;
  const double rank = std::ceil(fraction * static_cast<double>(values.size()) - ROUNDING) - 1.0;
  const auto index = static_cast<size_t>(std::max(rank, 0.0));
  const auto nth = values.begin() + static_cast<ptrdiff_t>(std::min(index, values.size() - 1));
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

ImageMetrics compareImages(const Image& picture, const Image& reference, const Image* variance) {
  ImageMetrics metrics;
  Sum magnitude;
  Sum difference;
  Sum square;
  Sum noise;
  metrics.nonFinite = visitSamples(picture, reference, [&](double a, double b, size_t i) {
    magnitude.add(std::abs(b));
    difference.add(a - b);
    square.add((a - b) * (a - b));
    if (variance != nullptr) {
      noise.add(double{variance->rgba[i]});
    }
    metrics.negative += a < 0.0 ? 1u : 0u;
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
  Sum relativeNoise;
  visitSamples(picture, reference, [&](double a, double b, size_t i) {
    const double divisor = std::max(std::abs(b), floor);
    const double error = std::abs(a - b) / divisor;
    relativeSquare.add(error * error);
    errors.push_back(error);
    if (variance != nullptr) {
      relativeNoise.add(double{variance->rgba[i]} / divisor / divisor);
    }
  });
  metrics.relMse = relativeSquare.value() / count;
  metrics.maxRelativeError = *std::max_element(errors.begin(), errors.end());
  metrics.medianRelativeError = nearestRank(errors, 0.5);
  metrics.p90RelativeError = nearestRank(errors, 0.9);
  metrics.p95RelativeError = nearestRank(errors, 0.95);
  metrics.p999RelativeError = nearestRank(errors, 0.999);
  if (variance != nullptr) {
    metrics.relMseDenoised = withoutNoise(metrics.relMse, relativeNoise.value() / count);
    metrics.rmseOverMeanDenoised =
        std::sqrt(withoutNoise(square.value() / count, noise.value() / count)) / scale;
    metrics.standardError = std::sqrt(relativeNoise.value() / count);
  }
  return metrics;
}

}  // namespace host
