// SPDX-License-Identifier: MIT
// src/frame/light_schedule: each light is computed whole and from the numbers of one frame, what is
// shown was complete and moves evenly, and lags no more than is promised.
#include "frame/light_schedule.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

using namespace welkin;

// Lights as a renderer keeps them: of which moment each is, and how much of it is there.
class Lights {
 public:
  explicit Lights(uint32_t frames) : frames_(frames) {}

  // A frame at `moment` of a light that moves with it; returns what is shown.
  double show(double moment, LightChange change) {
    step = schedule.next(change, frames_);
    EXPECT_LT(std::max({step.target, step.shown, step.before}), SPREAD_LIGHTS);
    if (step.computes()) {
      if (step.begins) {
        EXPECT_EQ(step.from, 0u);
        moment_[step.target] = moment;
        done_[step.target] = 0;
      }
      EXPECT_EQ(done_[step.target] * step.parts, step.from) << "parts in order, none twice";
      EXPECT_GT(step.to, step.from);
      done_[step.target] = static_cast<double>(step.to) / step.parts;
    }
    for (const uint32_t light : {step.shown, step.before}) {
      EXPECT_EQ(done_[light], 1.0) << "light that is not complete is shown";
    }
    EXPECT_GT(step.weight, 0);
    EXPECT_LE(step.weight, 1);
    const double weight = static_cast<double>(step.weight);
    return weight * moment_[step.shown] + (1 - weight) * moment_[step.before];
  }
  // As a renderer finds it: against the light that was complete last.
  double showMoving(double moment) {
    return show(moment,
                moment_[schedule.newest()] == moment ? LightChange::None : LightChange::Moved);
  }

  LightSchedule schedule;
  LightStep step;

 private:
  uint32_t frames_;
  double moment_[SPREAD_LIGHTS] = {-1, -1, -1};
  double done_[SPREAD_LIGHTS] = {};
};

TEST(LightSchedule, AtOnceInOneFrame) {
  Lights lights(1);
  for (int frame = 0; frame < 5; ++frame) {
    EXPECT_EQ(lights.show(frame, frame == 0 ? LightChange::Other : LightChange::Moved), frame);
    EXPECT_EQ(lights.step.target, 0u) << "one light is enough";
    EXPECT_EQ(lights.step.weight, 1);
  }
  lights.show(9, LightChange::None);
  EXPECT_FALSE(lights.step.computes());
}

TEST(LightSchedule, MovesEvenlyBehindALightThatMovesEvenly) {
  for (const uint32_t frames : {2u, 3u, 8u, 16u, 64u}) {
    Lights lights(frames);
    EXPECT_EQ(lights.show(0, LightChange::Other), 0);
    const double lag = 2.0 * frames - 2;
    double last = 0;
    for (uint32_t frame = 1; frame < 6 * frames; ++frame) {
      const double shown = lights.showMoving(frame);
      EXPECT_TRUE(lights.step.computes()) << "work is even";
      EXPECT_LE(frame - shown, 2.0 * frames);
      EXPECT_GE(shown, last);
      EXPECT_LE(shown - last, 1 + 1e-6) << "no step is larger than the light's own";
      if (frame >= 3 * frames) {
        EXPECT_NEAR(frame - shown, lag, 1e-5 * frames) << frames;
      }
      last = shown;
    }
  }
}

TEST(LightSchedule, ComesToRestWhereTheLightDoes) {
  for (const uint32_t frames : {2u, 5u, 8u}) {
    for (uint32_t moving = 1; moving < 3 * frames; ++moving) {
      Lights lights(frames);
      lights.show(0, LightChange::Other);
      uint32_t frame = 1;
      for (; frame <= moving; ++frame) {
        lights.showMoving(frame);
      }
      for (; frame < moving + 3 * frames; ++frame) {
        lights.showMoving(moving);
      }
      EXPECT_EQ(lights.showMoving(moving), moving) << frames << " frames, moving " << moving;
      EXPECT_EQ(lights.step.weight, 1);
      EXPECT_FALSE(lights.step.computes());
      EXPECT_FALSE(lights.schedule.working());
    }
  }
}

TEST(LightSchedule, AJumpIsShownAtOnceWheneverItComes) {
  constexpr uint32_t FRAMES = 4;
  for (uint32_t when = 1; when < 4 * FRAMES; ++when) {
    Lights lights(FRAMES);
    lights.show(0, LightChange::Other);
    for (uint32_t frame = 1; frame < when; ++frame) {
      lights.showMoving(frame);
    }
    EXPECT_EQ(lights.show(1000, LightChange::Other), 1000);
    EXPECT_EQ(lights.step.parts, 1u);
    EXPECT_EQ(lights.step.weight, 1);
    EXPECT_EQ(lights.showMoving(1000), 1000) << "nothing of before is left";
    EXPECT_FALSE(lights.step.computes());
  }
}

}  // namespace
