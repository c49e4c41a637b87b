// SPDX-License-Identifier: MIT
// Interleaved times of frames that take what they are told to.
#include "bench/front_timing.hpp"

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cmath>
#include <set>

namespace bench {
namespace {

double spin(double time_ms) {
  const auto end =
      std::chrono::steady_clock::now() + std::chrono::duration<double, std::milli>(time_ms);
  while (std::chrono::steady_clock::now() < end) {
  }
  return time_ms;
}

double since_ms(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
      .count();
}

// A scheduler's tick that all rounds met, 1 ms of 10. Slow rounds are 125 % longer.
constexpr double FOUND = 0.1;

TEST(FrontTiming, RatioIsThatOfTheFastestRounds) {
  // The second one is held up in all but every third round of 10 ms, as by other work.
  size_t calls = 0;
  const Copies anchor = {[] { return spin(10.0); }};
  const Copies often = {[&calls] { return spin(calls++ % 3 == 0 ? 20.0 : 45.0); }};
  const std::vector<Timing> timings = interleave({anchor, often}, 0, 1, 6);
  EXPECT_NEAR(timings[0].ratio, 1.0, 1e-9);
  EXPECT_NEAR(timings[1].ratio, 2.0, 2.0 * FOUND);
  EXPECT_NEAR(timings[1].fastest, 20.0, 20.0 * FOUND);
  EXPECT_GT(timings[1].medianRatio, 2.0 * (1.0 + 2.0 * FOUND));
  EXPECT_LE(timings[1].medianRatioLow, timings[1].medianRatio);
  EXPECT_GE(timings[1].medianRatioHigh, timings[1].medianRatio);
}

// Two methods a factor of 4 apart stand a factor of 2 to both sides of their geometric mean; every
// sixth round of one is held up.
TEST(FrontTiming, RelativeTimesAreOverThoseOfAllMethods) {
  size_t calls = 0;
  const Copies one = {[] { return spin(10.0); }};
  const Copies other = {[&calls] { return spin(calls++ % 6 == 0 ? 90.0 : 40.0); }};
  const std::vector<Timing> timings = interleave({one, other}, 0, 1, 8);
  EXPECT_NEAR(timings[0].relative.time, 0.5, 0.5 * FOUND);
  EXPECT_NEAR(timings[1].relative.time, 2.0, 2.0 * FOUND);
  EXPECT_NEAR(timings[0].relativeCpu.time * timings[1].relativeCpu.time, 1.0, 1e-9);
}

// A method whose frames take longer than 60 ms is timed in two of a block's four rounds, longer
// than 320 ms in one, on all cores and on one in other rounds each time.
TEST(FrontTiming, BlocksHoldEveryMethod) {
  size_t second = 0;
  const Copies shortOne = {[] { return spin(10.0); }};
  const Copies middle = {[] { return spin(70.0); }};
  const Copies longOne = {[] { return spin(350.0); },
                          [&second] {
                            ++second;
                            return spin(350.0);
                          }};
  Sampler sampler({shortOne, longOne, middle}, 0, 3);
  const size_t warmedUp = second;
  constexpr size_t BLOCKS = 4;  // of each kind
  for (size_t i = 0; i < BLOCKS; ++i) {
    sampler.takeBlock(false);
    sampler.takeBlock(true);
  }
  const std::vector<FrameTime>& samples = sampler.samples();
  ASSERT_EQ(samples.size(), 2 * 7 * BLOCKS);
  std::array<std::set<size_t>, 2> roundsOfLong;
  for (size_t i = 0; i < samples.size(); ++i) {
    const FrameTime& sample = samples[i];
    EXPECT_EQ(sample.block, i / 7);
    EXPECT_EQ(sample.onOneCore, sample.block % 2 == 1);
    EXPECT_EQ(sample.round / 4, sample.block);
    if (sample.method == 1) {
      roundsOfLong.at(sample.onOneCore).insert(sample.round % 4);
    }
  }
  EXPECT_EQ(roundsOfLong[0].size(), BLOCKS);
  EXPECT_EQ(roundsOfLong[1].size(), BLOCKS);
  EXPECT_EQ(second, warmedUp + BLOCKS);  // copies go on in turn
  const std::vector<Timing> timings = timingsOf(samples, 3, 0);
  EXPECT_EQ(timings[0].rounds, 4 * BLOCKS);
  EXPECT_EQ(timings[1].rounds, BLOCKS);
  EXPECT_EQ(timings[2].rounds, 2 * BLOCKS);
  EXPECT_EQ(timings[2].oneCoreRounds, 2 * BLOCKS);
}

// Blocks wait for quiet cores for a tenth of what they take, and so in the long run: here every
// probe that may wait does so for as long as it may.
TEST(FrontTiming, BlocksWaitForATenthOfTheirTime) {
  const CoreState loud = {2.0 * currentCores().handover_ns, 2.0 * bestCores().work_ns};
  double waited_ms = 0.0;
  const auto probe = [&](double patience_ms) {
    const auto start = std::chrono::steady_clock::now();
    spin(patience_ms);
    waited_ms += since_ms(start);
    return loud;
  };
  Sampler sampler({{[] { return spin(10.0); }}}, 0, 1, probe);
  const auto start = std::chrono::steady_clock::now();
  double spent_ms = 0.0;  // before the last one
  for (size_t i = 0; i < 10; ++i) {
    spent_ms = since_ms(start);
    sampler.takeBlock();
  }
  // Who is held up while waiting waits less later; only the last time is left. Without what was
  // waited taken off it is five times as much.
  EXPECT_GT(waited_ms, 0.1 * spent_ms * (1.0 - FOUND));
  EXPECT_LT(waited_ms, 2.0 * 0.1 * spent_ms);
}

// Threads that share one core do not depend on how near others are.
TEST(FrontTiming, BlocksOnOneCoreDoNotWait) {
  const CoreState loud = {2.0 * currentCores().handover_ns, 2.0 * bestCores().work_ns};
  size_t looks = 0;
  const auto probe = [&](double) {
    ++looks;
    return loud;
  };
  Sampler sampler({{[] { return spin(10.0); }}}, 0, 1, probe);
  sampler.takeBlock(false);
  const size_t before = looks;
  EXPECT_GT(before, 0u);
  sampler.takeBlock(true);
  EXPECT_EQ(looks, before);
  EXPECT_EQ(sampler.samples().back().cores.work_ns, 0.0);
}

// A frame after others' meets other caches than one after itself. The anchor, in every round for
// ratios in rounds, is in as many as others on one core.
TEST(FrontTiming, OnOneCoreFramesAreNotRepeated) {
  size_t calls = 0;
  const Copies anchor = {[] { return spin(70.0); }};
  const Copies shortOne = {[&calls] {
    ++calls;
    return spin(2.0);
  }};
  Sampler sampler({anchor, shortOne}, 0, 3);
  calls = 0;
  sampler.takeBlock(false);
  EXPECT_EQ(sampler.samples().size(), 8u);
  EXPECT_GE(calls, 4u * 2u);  // five times, if warm-ups were not held up
  calls = 0;
  sampler.takeBlock(true);
  EXPECT_EQ(sampler.samples().size(), 8u + 6u);
  EXPECT_EQ(calls, 4u);
}

// The machine is faster in every block, and a block ends with what the next does not begin with.
TEST(FrontTiming, BlocksTellOfTheirOwnMachine) {
  std::vector<FrameTime> samples;
  for (size_t block = 0; block < 12; ++block) {
    for (size_t method = 0; method < 3; ++method) {
      FrameTime sample;
      sample.method = method;
      sample.round = sample.block = block;
      sample.wall = sample.cpu =
          std::exp2(static_cast<double>(method)) / (1.0 + static_cast<double>(block));
      samples.push_back(sample);
    }
  }
  const std::vector<Timing> timings = timingsOf(samples, 3, 0);
  EXPECT_NEAR(timings[0].relative.time, 0.5, 1e-6);  // where iterations end
  EXPECT_NEAR(timings[2].relativeCpu.time, 2.0, 2e-6);
}

// Handing over between cores makes the short frame dearer by more than the long one.
TEST(FrontTiming, RelativeTimesAreThoseOnOneCore) {
  std::vector<FrameTime> samples;
  for (size_t round = 0; round < 9; ++round) {
    for (size_t method = 0; method < 2; ++method) {
      FrameTime sample;
      sample.method = method;
      sample.round = sample.block = round;
      sample.onOneCore = round % 3 != 2;
      const double work = method == 0 ? 10.0 : 40.0;
      sample.cpu = sample.onOneCore ? work : work + 3.0;
      sample.wall = sample.onOneCore ? work : 0.5 * work + 3.0;
      samples.push_back(sample);
    }
  }
  const std::vector<Timing> timings = timingsOf(samples, 2, 0);
  EXPECT_NEAR(timings[0].relative.time, 0.5, 1e-6);
  EXPECT_NEAR(timings[1].relative.time, 2.0, 2e-6);
  EXPECT_NEAR(timings[0].relativeCpu.time, 0.5, 1e-6);
  EXPECT_NEAR(timings[1].relativeCpu.time, 2.0, 2e-6);
  EXPECT_EQ(timings[0].wall, 8.0);
  EXPECT_EQ(timings[0].cpu, 13.0);
  EXPECT_NEAR(timings[1].medianRatio, 23.0 / 8.0, 1e-12);
  EXPECT_EQ(timings[1].rounds, 3u);
  EXPECT_EQ(timings[1].oneCoreRounds, 6u);
}

// Three copies, blocks of four rounds, every second one on one core.
TEST(FrontTiming, CopiesAreTimedOnOneCoreAsOftenAsOnAll) {
  std::array<size_t, 2> calls{};
  Sampler sampler({{[&] {
                      ++calls[0];
                      return spin(10.0);
                    },
                    [&] {
                      ++calls[1];
                      return spin(10.0);
                    },
                    [] { return spin(10.0); }}},
                  0, 1);
  calls = {};
  for (const bool onOneCore : {false, true, false, true}) {
    sampler.takeBlock(onOneCore);
  }
  EXPECT_EQ(calls[0], 6u);  // rounds 0, 3 and 6 of each
  EXPECT_EQ(calls[1], 6u);
  EXPECT_EQ(sampler.samples()[3].onOneCore, false);
  EXPECT_EQ(sampler.samples()[4].onOneCore, true);
}

// Two of three frames run beside others' work, and faster than it ever does in quiet rounds, so
// that the fastest of all would be those.
TEST(FrontTiming, RoundsOnLoudCoresDoNotCount) {
  currentCores();
  const CoreState quiet = bestCores();
  const CoreState loud = {quiet.handover_ns, 2.0 * quiet.work_ns};
  size_t calls = 0;
  const Copies copies = {[&calls] { return spin(++calls % 3 == 0 ? 20.0 : 10.0); }};
  const auto probe = [&](double) { return calls % 3 == 0 || calls % 3 == 2 ? quiet : loud; };
  const std::vector<Timing> timings = interleave({copies}, 0, 2, 3 * ENOUGH_QUIET, probe);
  EXPECT_NEAR(timings[0].wall, 20.0, 20.0 * FOUND);
  EXPECT_NEAR(timings[0].fastest, 20.0, 20.0 * FOUND);
  EXPECT_EQ(timings[0].quietRounds, (timings[0].rounds + 2) / 3);
  EXPECT_EQ(timings[0].cores.work_ns, quiet.work_ns);
}

TEST(FrontTiming, WithTooFewQuietRoundsAllCount) {
  currentCores();
  const CoreState loud = {bestCores().handover_ns, 2.0 * bestCores().work_ns};
  size_t calls = 0;
  const Copies copies = {[&calls] {
    ++calls;
    return spin(10.0);
  }};
  const std::vector<Timing> timings = interleave({copies}, 0, 1, 6, [&](double) { return loud; });
  EXPECT_NEAR(timings[0].wall, 10.0, 10.0 * FOUND);
  EXPECT_EQ(timings[0].quietRounds, 0u);
  EXPECT_EQ(timings[0].cores.work_ns, loud.work_ns);
}

TEST(FrontTiming, ShortFramesAreRepeated) {
  size_t calls = 0;
  const Copies anchor = {[&calls] {
    ++calls;
    return spin(0.5);
  }};
  const std::vector<Timing> timings = interleave({anchor}, 0, 1, 2);
  EXPECT_NEAR(timings[0].fastest, 0.5, 0.5 * FOUND);
  EXPECT_NEAR(timings[0].gpu, 0.5, 1e-9);  // what the frame said
  EXPECT_GE(calls, 2u * 20u);              // rounds of 10 ms at least
}

}  // namespace
}  // namespace bench
