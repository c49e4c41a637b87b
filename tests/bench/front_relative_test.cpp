// SPDX-License-Identifier: MIT
// Relative times of samples made by a rule, so that the truth is known.
#include "bench/front_relative.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace bench {
namespace {

constexpr size_t METHODS = 5;

// Each is twice as long as the one before; of five the geometric mean is that of the third.
double truth(size_t method, size_t methods = METHODS) {
  return std::exp2(static_cast<double>(method) - 0.5 * static_cast<double>(methods - 1));
}

// In turn, from another method on each round.
size_t turn(size_t sample) {
  return (sample + sample / METHODS) % METHODS;
}

TEST(FrontRelative, TimesWithoutNoiseAreExact) {
  std::vector<TimedMethod> samples;
  for (size_t k = 0; k < 4 * METHODS; ++k) {
    samples.push_back({turn(k), 7.0 * truth(turn(k))});
  }
  const std::vector<RelativeTime> times = relativeTimes(samples, METHODS);
  for (size_t i = 0; i < METHODS; ++i) {
    EXPECT_NEAR(times[i].time, truth(i), 1e-12 * truth(i));  // rounding of logarithms
    EXPECT_NEAR(times[i].error, 0.0, 1e-12);
  }
}

// A slow half hits one method's samples more than others', as where a run ends early: the mean of
// its own would be off by a tenth and more.
TEST(FrontRelative, WhatTheMachineAddsIsTakenOff) {
  std::vector<TimedMethod> samples;
  for (size_t k = 0; k < 200; ++k) {
    const bool slow = k >= 100;
    if (slow && turn(k) == 1 && k % 2 == 0) {
      continue;
    }
    samples.push_back({turn(k), (slow ? 1.6 : 1.0) * truth(turn(k))});
  }
  // Of a method's 30 to 40 samples at most two stand beside the step, outside the middle half.
  const std::vector<RelativeTime> times = relativeTimes(samples, METHODS);
  for (size_t i = 0; i < METHODS; ++i) {
    EXPECT_NEAR(times[i].time, truth(i), 1e-6 * truth(i));  // where iterations end
  }
}

// The machine is another in every block, and blocks end with the same method: what comes after in
// the list says nothing of it.
TEST(FrontRelative, BlocksDoNotTellOfEachOther) {
  std::vector<TimedMethod> samples;
  for (size_t block = 0; block < 12; ++block) {
    for (size_t k = 0; k < METHODS; ++k) {
      samples.push_back({k, (1.0 + static_cast<double>(block)) * truth(k), block});
    }
  }
  const std::vector<RelativeTime> times = relativeTimes(samples, METHODS);
  for (size_t i = 0; i < METHODS; ++i) {
    EXPECT_NEAR(times[i].time, truth(i), 1e-6 * truth(i));  // where iterations end
  }
}

struct Spread {
  double said = 0.0;
  double rms = 0.0;
};

// Noise of 5 %, outliers of a tenth of the samples, and a machine whose speed goes up and down by a
// third; rounds in changing order, as samples are taken.
Spread spreadOf(size_t methods, size_t rounds, size_t runs) {
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0.0, 0.05);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<size_t> order(methods);
  std::iota(order.begin(), order.end(), size_t{0});
  Spread spread;
  for (size_t run = 0; run < runs; ++run) {
    std::vector<TimedMethod> samples;
    for (size_t round = 0; round < rounds; ++round) {
      std::shuffle(order.begin(), order.end(), random);
      for (const size_t method : order) {
        const double phase = 0.05 * static_cast<double>(samples.size() + 37 * run);
        const double held = uniform(random) < 0.1 ? uniform(random) : 0.0;
        const double added = noise(random) + 0.3 * std::sin(phase) + held;
        samples.push_back({method, truth(method, methods) * std::exp(added)});
      }
    }
    const std::vector<RelativeTime> times = relativeTimes(samples, methods);
    for (size_t i = 0; i < methods; ++i) {
      const double off = std::log(times[i].time / truth(i, methods));
      spread.rms += off * off;
      spread.said += times[i].error;
    }
  }
  const auto count = static_cast<double>(runs * methods);
  return {spread.said / count, std::sqrt(spread.rms / count)};
}

TEST(FrontRelative, ErrorsTellHowFarFromTheTruth) {
  const Spread spread = spreadOf(METHODS, 40, 60);
  // 0.05 and what outliers and neighbours add, over sqrt(40): 1.1 %.
  EXPECT_GT(spread.said, 0.008);
  EXPECT_LT(spread.said, 0.02);
  // Neighbours share noise, which leaves 0.82; of 300 the root mean square is known to 4 %.
  EXPECT_GT(spread.rms, 0.7 * spread.said);
  EXPECT_LT(spread.rms, 1.3 * spread.said);
}

// What a sample's neighbours tell depends on their own methods' times, and so on: errors must not
// pile up along such a chain. 1.2 times as large, 2.1 times with the same order in every round.
TEST(FrontRelative, ManyMethodsAreAsExactAsFew) {
  const Spread few = spreadOf(METHODS, 30, 40);
  const Spread many = spreadOf(39, 30, 5);
  EXPECT_LT(many.rms, 1.5 * few.rms);
}

// The machine may have been four times slower then, or the method: nothing tells, but it is no
// error.
TEST(FrontRelative, OneSampleEachIsNoError) {
  const std::vector<RelativeTime> times = relativeTimes({{0, 1.0}, {1, 4.0}}, 2);
  EXPECT_NEAR(times[0].time * times[1].time, 1.0, 1e-12);
  EXPECT_TRUE(std::isnan(times[0].error));
}

}  // namespace
}  // namespace bench
