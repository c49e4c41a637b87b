// SPDX-License-Identifier: MIT
// Factors that tolerances are made of, and the error statistics that tests assert.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace welkin::test {

// Relative error of one rounding.
inline constexpr double EPS_FLOAT = 0x1p-24;
inline constexpr double EPS_DOUBLE = 0x1p-53;

// |value / truth - 1|; 0 / 0 counts as equal, anything not finite as infinitely wrong.
inline double relativeError(long double value, long double truth) {
  if (!std::isfinite(value)) {
    return std::numeric_limits<double>::infinity();
  }
  if (value == truth) {
    return 0.0;
  }
  return static_cast<double>(std::fabs((value - truth) / truth));
}

// Order statistics of a sample of errors.
class ErrorSample {
 public:
  void add(double error) {
    errors_.push_back(std::isnan(error) ? std::numeric_limits<double>::infinity() : error);
    sorted_ = false;
  }
  std::size_t count() const { return errors_.size(); }
  // Smallest value with at least `fraction` of the sample at or below it.
  double quantile(double fraction) {
    if (!sorted_) {
      std::sort(errors_.begin(), errors_.end());
      sorted_ = true;
    }
    const double rank = std::ceil(fraction * static_cast<double>(errors_.size()));
    const auto index = static_cast<std::size_t>(std::max(rank, 1.0)) - 1;
    return errors_[std::min(index, errors_.size() - 1)];
  }
  double median() { return quantile(0.5); }
  double p95() { return quantile(0.95); }
  double max() { return quantile(1.0); }

 private:
  std::vector<double> errors_;
  bool sorted_ = false;
};

}  // namespace welkin::test
