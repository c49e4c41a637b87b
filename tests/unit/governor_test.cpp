// SPDX-License-Identifier: MIT
// The governor against synthetic costs: it converges, rests, and never hunts. Times in ms; a time
// reaches it three frames late, as with three frames in flight.
#include "frame/governor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

namespace {

using namespace welkin;

constexpr RungRange ALL{0, RUNGS - 1};
constexpr double BUDGET = 4.0;
constexpr uint64_t LATENCY = 3;
// Frames from a start, and after a change of load, until the governor rests: at most six rungs are
// measured (start, four of the search or two down, one back), 8 times each after two skipped and
// three late ones, and a rung left for being too dear takes 8 more.
constexpr uint64_t SEARCH = 6 * (8 + 2 + LATENCY + 8);

// Cost of a frame: a part that no rung changes and one that grows by `ratio` per rung.
struct Scene {
  double fixed = 0.2;
  double lowest = 0.3;
  double ratio = 1.35;
  double at(uint32_t rung) const { return fixed + lowest * std::pow(ratio, rung); }
  // The best that fits with the margin a step up asks for, and the best that fits at all.
  uint32_t fits(double budget) const {
    uint32_t rung = 0;
    while (rung + 1 < RUNGS && at(rung + 1) <= budget) {
      ++rung;
    }
    return rung;
  }
};

class Simulation {
 public:
  explicit Simulation(RungRange range = ALL) { governor.start(range); }

  // One frame of `cost` by rung.
  void frame(const std::function<double(uint32_t)>& cost, double budget = BUDGET) {
    ++now;
    if (now > LATENCY) {
      governor.feedTime(now - LATENCY, times_[(now - LATENCY) % times_.size()], budget);
    }
    const uint32_t rung = governor.beginFrame(now);
    if (!rungs.empty() && rung != rungs.back()) {
      switches.push_back(now);
      ups.push_back(rung > rungs.back());
    }
    rungs.push_back(rung);
    times_[now % times_.size()] = cost(rung);
  }
  void frames(uint64_t count, const Scene& scene, double budget = BUDGET) {
    for (uint64_t i = 0; i < count; ++i) {
      frame([&](uint32_t rung) { return scene.at(rung); }, budget);
    }
  }

  Governor governor;
  uint64_t now = 0;
  std::vector<uint32_t> rungs;
  std::vector<uint64_t> switches;  // frames
  std::vector<bool> ups;

 private:
  std::array<double, 8> times_{};
};

// Lognormal, and one frame of a hundred takes ten times as long.
class Noise {
 public:
  explicit Noise(double deviation, uint32_t seed = 7) : random_(seed), normal_(0, deviation) {}
  double operator()() {
    const double outlier = std::uniform_real_distribution<double>(0, 1)(random_) < 0.01 ? 10 : 1;
    return outlier * std::exp(normal_(random_));
  }

 private:
  std::mt19937 random_;
  std::normal_distribution<double> normal_;
};

TEST(Governor, ConvergesInTheStatedFramesAndRests) {
  for (const double lowest : {0.01, 0.1, 0.3, 1.0, 2.0, 3.5, 20.0}) {
    for (const double ratio : {1.05, 1.2, 1.35, 1.6}) {
      for (const double fixed : {0.0, 0.2, 2.0}) {
        const Scene scene{fixed, lowest, ratio};
        SCOPED_TRACE(testing::Message() << fixed << " + " << lowest << " * " << ratio << "^rung");
        Simulation run;
        run.frames(SEARCH, scene);
        // Once the search is over it may still climb, a rung per second.
        run.frames(RUNGS * (GOVERNOR_UP_FRAMES + 8 + 2 + LATENCY), scene);
        const size_t settled = run.switches.size();
        const uint32_t rung = run.governor.state().rung;
        run.frames(400, scene);
        EXPECT_EQ(run.switches.size(), settled) << "it rests";
        const uint32_t best = scene.fits(BUDGET);
        EXPECT_LE(rung, best);
        // Not lower than the margin asks for, of ratios that it has learned or supposed.
        const double usual = std::max(usualRatio(rung + (rung + 1 < RUNGS ? 1 : 0)), ratio);
        EXPECT_TRUE(rung == best || scene.at(rung) * usual > GOVERNOR_MARGIN * BUDGET)
            << rung << " of " << best;
        if (scene.at(0) > BUDGET) {
          EXPECT_EQ(run.governor.state().reason, uint32_t{WLK_CONTROL_REASON_UNREACHABLE});
        } else {
          EXPECT_LE(run.governor.state().time, BUDGET);
        }
      }
    }
  }
}

TEST(Governor, KeepsTheBudgetAfterTheSearch) {
  for (double lowest = 0.02; lowest < BUDGET; lowest *= 1.13) {
    const Scene scene{0.0, lowest, 1.35};
    Simulation run;
    run.frames(SEARCH, scene);
    EXPECT_LE(scene.at(run.governor.state().rung), BUDGET) << lowest;
  }
}

TEST(Governor, NoiseMakesItSwitchNoMore) {
  for (double lowest = 0.05; lowest < BUDGET; lowest *= 1.21) {
    const Scene scene{0.2, lowest, 1.35};
    Noise noise(0.1);
    Simulation run;
    const auto cost = [&](uint32_t rung) { return scene.at(rung) * noise(); };
    for (int i = 0; i < 1500; ++i) {
      run.frame(cost);
    }
    const size_t settled = run.switches.size();
    for (int i = 0; i < 20000; ++i) {
      run.frame(cost);
    }
    EXPECT_LE(run.switches.size(), settled + 1) << lowest;
  }
}

TEST(Governor, ALoadBetweenTwoRungsIsNotHunted) {
  // The rung above costs from just under to far over the budget, and more than it is supposed to.
  for (const double above : {0.86, 0.95, 1.0, 1.05, 1.3, 2.0}) {
    const auto cost = [&](uint32_t rung) {
      return BUDGET *
             (rung > 5 ? above * std::pow(1.4, rung - 6.0) : 0.6 * std::pow(1.1, rung - 5.0));
    };
    Simulation run;
    for (int i = 0; i < 10000; ++i) {
      run.frame(cost);
    }
    // A step up that was taken back is tried again after half a minute, then after twice that, and
    // so on: twice in 10000 frames, beside the search and the first climb.
    EXPECT_LE(run.switches.size(), 3u) << above;
    size_t late = 0;
    for (const uint64_t frame : run.switches) {
      late += frame > 5000 ? 1 : 0;
    }
    EXPECT_LE(late, 0u) << above;
  }
}

TEST(Governor, FollowsStepsInTheLoad) {
  const Scene calm{0.2, 0.3, 1.35};
  for (const double factor : {1.5, 3.0, 8.0}) {
    const Scene heavy{calm.fixed, factor * calm.lowest, calm.ratio};
    Simulation run;
    run.frames(1500, calm);
    const uint32_t before = run.governor.state().rung;
    run.frames(SEARCH, heavy);
    EXPECT_LE(heavy.at(run.governor.state().rung), BUDGET) << factor;
    EXPECT_EQ(run.governor.state().rung<before, heavy.at(before)> BUDGET);
    // Back up: a rung per second, or more slowly where it doubted itself.
    run.frames(20000, calm);
    EXPECT_GE(run.governor.state().rung + 1, before) << factor;
  }
}

TEST(Governor, NoLoadMakesItSwitchOftenerThanStated) {
  std::mt19937 random(3);
  for (const uint64_t period : {5U, 11U, 20U, 37U, 64U, 150U, 600U}) {
    for (int kind = 0; kind < 3; ++kind) {
      Noise noise(0.3);
      Simulation run;
      double load = 1;
      for (uint64_t i = 0; i < 12000; ++i) {
        if (i % period == 0) {
          const double dice = std::uniform_real_distribution<double>(-2, 2)(random);
          load = kind == 0 ? (i / period % 2 == 0 ? 0.3 : 3.0) : std::exp(dice);
        }
        const Scene scene{0.1, 0.3 * load, 1.35};
        run.frame([&](uint32_t rung) { return scene.at(rung) * (kind == 2 ? noise() : 1.0); });
      }
      uint64_t lastUp = 0;
      size_t ups = 0;
      for (size_t i = 1; i < run.switches.size(); ++i) {
        // 8 times of this rung come before any switch.
        EXPECT_GE(run.switches[i] - run.switches[i - 1], 8u);
        // Beyond the search no step up sooner than a second after any other.
        if (run.ups[i] && run.switches[i] > 2 * SEARCH) {
          EXPECT_GE(run.switches[i] - run.switches[i - 1], GOVERNOR_UP_FRAMES);
          EXPECT_GE(run.switches[i] - lastUp, GOVERNOR_UP_FRAMES);
          lastUp = run.switches[i];
          ++ups;
        }
      }
      EXPECT_LE(ups, 12000 / GOVERNOR_UP_FRAMES);
      // Of a load that comes and goes for ever, waits that double leave few steps up.
      if (kind == 0 && period < GOVERNOR_UP_FRAMES) {
        EXPECT_LE(ups, 3u) << period;
      }
    }
  }
}

TEST(Governor, IgnoresWhatIsNoTime) {
  Simulation run;
  run.frames(200, Scene{});
  const GovernorState before = run.governor.state();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  uint64_t frame = 100000;
  for (int i = 0; i < 100; ++i) {
    for (const double time : {nan, 0.0, -0.0, -1.0, -1e30, 1e30, infinity, -infinity}) {
      EXPECT_FALSE(run.governor.feedTime(++frame, time, BUDGET)) << time;
    }
  }
  EXPECT_EQ(run.governor.state().rung, before.rung);
  EXPECT_EQ(run.governor.state().time, before.time);
  EXPECT_EQ(run.governor.state().reason, before.reason);
  // None of those frames counts as the newest.
  run.frames(GOVERNOR_DOWN_FRAMES + 40, Scene{10, 1, 1.3});
  EXPECT_LT(run.governor.state().rung, before.rung);
}

TEST(Governor, TimesOfOtherRungsAndOfOldFramesChangeNothing) {
  Governor governor;
  governor.start(ALL);
  governor.beginFrame(1);
  for (uint64_t i = 1; i <= 12; ++i) {
    governor.feedTime(i, 40.0, BUDGET);
  }
  const uint32_t rung = governor.state().rung;
  EXPECT_EQ(governor.state().switches, 1u);
  governor.beginFrame(20);
  for (uint64_t i = 10; i < 20; ++i) {
    governor.feedTime(i, 40.0, BUDGET);  // recorded before the switch
  }
  for (int i = 0; i < 40; ++i) {
    governor.feedTime(20, 40.0, BUDGET);  // the same frame again
  }
  EXPECT_EQ(governor.state().rung, rung);
  EXPECT_EQ(governor.state().time, 0.0) << "nothing of the new rung is known";
  EXPECT_EQ(governor.state().since, 20u);
}

TEST(Governor, WithoutVolumesItStaysWhereItIs) {
  Simulation run;
  run.frames(1000, Scene{});
  const uint32_t rung = run.governor.state().rung;
  for (uint64_t i = 0; i < 500; ++i) {
    run.frame([](uint32_t) { return 100.0; });
    run.governor.idle(run.now);
  }
  EXPECT_EQ(run.governor.state().rung, rung);
  EXPECT_EQ(run.governor.state().reason, uint32_t{WLK_CONTROL_REASON_IDLE});
  run.frames(500, Scene{});
  EXPECT_EQ(run.governor.state().rung, rung);
}

TEST(Governor, TheSameTimesGiveTheSameRungs) {
  std::array<std::vector<uint32_t>, 2> rungs;
  for (auto& list : rungs) {
    Noise noise(0.4, 11);
    Simulation run;
    for (int i = 0; i < 4000; ++i) {
      run.frame([&](uint32_t rung) { return Scene{}.at(rung) * noise(); });
    }
    list = run.rungs;
  }
  EXPECT_EQ(rungs[0], rungs[1]);
}

TEST(Governor, StaysInsideItsRange) {
  for (const RungRange range : {RungRange{0, 0}, RungRange{3, 7}, RungRange{11, 11}}) {
    for (const double lowest : {1e-3, 50.0}) {
      Simulation run(range);
      run.frames(1500, Scene{0, lowest, 1.3});
      for (const uint32_t rung : run.rungs) {
        EXPECT_GE(rung, range.lowest);
        EXPECT_LE(rung, range.highest);
      }
      EXPECT_EQ(run.rungs.back(), lowest < 1 ? range.highest : range.lowest);
      EXPECT_EQ(run.governor.state().reason, lowest < 1 ? uint32_t{WLK_CONTROL_REASON_BEST}
                                                        : uint32_t{WLK_CONTROL_REASON_UNREACHABLE});
    }
  }
}

std::array<double, RUNGS> errorsOf(double lowest) {
  std::array<double, RUNGS> errors{};
  for (uint32_t i = 0; i < RUNGS; ++i) {
    errors[i] = lowest * std::pow(0.7, i);
  }
  return errors;
}

TEST(ErrorControl, TakesTheCheapestRungUnderTheTargetAtOnce) {
  for (const double lowest : {0.01, 0.05, 0.2, 0.9}) {
    Governor governor;
    governor.start(ALL);
    governor.feedErrors(1, errorsOf(lowest), 0.05);
    const uint32_t rung = governor.state().rung;
    EXPECT_LE(errorsOf(lowest)[rung], 0.05);
    EXPECT_TRUE(rung == 0 || errorsOf(lowest)[rung - 1] > 0.05);
    EXPECT_EQ(governor.state().reason, uint32_t{WLK_CONTROL_REASON_FITS});
    EXPECT_EQ(governor.state().error, errorsOf(lowest)[rung]);
  }
}

TEST(ErrorControl, AnUnreachableTargetGivesTheBestAndSaysSo) {
  Governor governor;
  governor.start({2, 9});
  auto errors = errorsOf(0.9);
  governor.feedErrors(1, errors, 1e-4);
  EXPECT_EQ(governor.state().rung, 9u);
  EXPECT_EQ(governor.state().reason, uint32_t{WLK_CONTROL_REASON_UNREACHABLE});
  errors.fill(std::numeric_limits<double>::quiet_NaN());
  governor.feedErrors(9, errors, 0.5);
  EXPECT_EQ(governor.state().rung, 9u) << "what is unknown is not below a target";
  EXPECT_EQ(governor.state().reason, uint32_t{WLK_CONTROL_REASON_UNREACHABLE});
}

TEST(ErrorControl, GoesUpAtOnceAndDownAfterASecondBelowFourFifths) {
  Governor governor;
  governor.start(ALL);
  uint64_t frame = 0;
  const auto run = [&](int frames, double lowest) {
    for (int i = 0; i < frames; ++i) {
      if (governor.wantsErrors(++frame)) {
        governor.feedErrors(frame, errorsOf(lowest), 0.05);
      }
      governor.beginFrame(frame);
    }
    return governor.state().rung;
  };
  const uint32_t first = run(100, 0.2);
  EXPECT_GT(run(GOVERNOR_ERROR_FRAMES, 0.4), first);
  EXPECT_GT(run(40, 0.2), first) << "not yet";
  EXPECT_LE(run(40, 0.2), first + 1);
  // Swinging by a fifth around the target: it stands still.
  const uint64_t before = governor.state().switches;
  for (int i = 0; i < 300; ++i) {
    run(5, 0.2 * (1 + 0.1 * std::sin(0.3 * i)));
  }
  EXPECT_LE(governor.state().switches, before + 1);
}

}  // namespace
