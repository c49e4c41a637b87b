// SPDX-License-Identifier: MIT
// src/tables/gauss_rule: exact for polynomials up to degree 2 n - 1, and not for the next.
#include "tables/gauss_rule.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

using namespace welkin;

// Of x^power over [0, 1], less 1 / (power + 1), in parts of it.
double error(const GaussRule& rule, size_t power) {
  double sum = 0;
  for (size_t i = 0; i < rule.node.size(); ++i) {
    sum += rule.weight[i] * std::pow(rule.node[i], static_cast<double>(power));
  }
  return std::abs(sum * static_cast<double>(power + 1) - 1);
}

TEST(GaussRule, IsExactForPolynomialsUpToItsDegree) {
  for (const size_t count : {1U, 2U, 3U, 8U, 16U, 64U}) {
    const GaussRule rule = gaussRule(count);
    ASSERT_EQ(rule.node.size(), count);
    EXPECT_TRUE(std::is_sorted(rule.node.begin(), rule.node.end()));
    EXPECT_GT(rule.node.front(), 0);
    EXPECT_LT(rule.node.back(), 1);
    for (size_t power = 0; power < 2 * count; ++power) {
      // Newton's iteration stops at steps of 1e-15: so far off a node may be, raised to `power`,
      // and its weight, from a slope squared, each of two factors, some times that.
      const double bound = 1e-15 * static_cast<double>(count * (4 + power));
      EXPECT_LT(error(rule, power), bound) << count << " nodes, power " << power;
    }
    if (count <= 8) {  // beyond, the next is exact to roundings as well
      EXPECT_GT(error(rule, 2 * count), 1e-10) << count;
    }
  }
}

}  // namespace
