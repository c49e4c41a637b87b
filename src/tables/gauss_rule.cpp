// SPDX-License-Identifier: MIT
#include "tables/gauss_rule.hpp"

#include <cmath>
#include <numbers>

namespace welkin {

// Newton's iteration from the usual guess, on [-1, 1].
GaussRule gaussRule(size_t count) {
  GaussRule rule;
  rule.node.resize(count);
  rule.weight.resize(count);
  const auto n = static_cast<double>(count);
  for (size_t i = 0; i < count; ++i) {
    double x = std::cos(std::numbers::pi * (static_cast<double>(i) + 0.75) / (n + 0.5));
    double slope = 1;
    for (int step = 0; step < 50; ++step) {
      double before = 1;
      double value = x;
      for (size_t l = 2; l <= count; ++l) {
        const auto order = static_cast<double>(l);
        const double next = ((2 * order - 1) * x * value - (order - 1) * before) / order;
        before = value;
        value = next;
      }
      slope = n * (before - x * value) / ((1 - x) * (1 + x));
      const double change = value / slope;
      x -= change;
      if (std::abs(change) < 1e-15) {
        break;
      }
    }
    rule.node[i] = (1 - x) / 2;
    rule.weight[i] = 1 / ((1 - x) * (1 + x) * slope * slope);
  }
  return rule;
}

}  // namespace welkin
