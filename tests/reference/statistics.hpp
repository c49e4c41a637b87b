// SPDX-License-Identifier: MIT
// Whether numbers that a test has drawn are distributed as they should be.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace welkin::reference {

// Largest distance between the distribution of the values and the uniform one on [0, 1], times the
// root of their number (Kolmogorov's statistic): above 1.95 in one of 1000 draws, above 2.5 in one
// of 130 000.
inline double uniformityOf(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto n = static_cast<double>(values.size());
  double worst = 0;
  for (size_t i = 0; i < values.size(); ++i) {
    const auto rank = static_cast<double>(i);
    worst = std::max({worst, values[i] - rank / n, (rank + 1) / n - values[i]});
  }
  return worst * std::sqrt(n);
}
constexpr double UNIFORMITY = 2.5;

}  // namespace welkin::reference
