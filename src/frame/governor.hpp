// SPDX-License-Identifier: MIT
// Chooses a governed view's rung of the ladder (frame/ladder.hpp) from times of finished frames in
// ms, or from estimates of the relative error. Pure logic: what it is fed decides, nothing else.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "frame/ladder.hpp"

namespace welkin {

// Frames that a rung must be over the budget, and that the next one up must promise to fit, before
// it is left; what of the budget the next rung may be predicted to take. 60 frames are a second, in
// which nobody sees the picture pump; 15 % are five standard deviations of the smoothed time where
// frames vary by 10 %.
constexpr uint32_t GOVERNOR_DOWN_FRAMES = 8;
constexpr uint32_t GOVERNOR_UP_FRAMES = 60;
constexpr double GOVERNOR_MARGIN = 0.85;
// Times outside are no times.
constexpr double GOVERNOR_LONGEST = 1e6;
// Frames between two looks at the error.
constexpr uint32_t GOVERNOR_ERROR_FRAMES = 8;

struct GovernorState {
  uint32_t rung = 0;
  uint32_t reason = WLK_CONTROL_REASON_MEASURING;
  double time = 0;       // smoothed, of the rung; 0 before enough frames were measured
  double predicted = 0;  // of the next rung up, 0 if there is none or nothing to predict from
  double error = 0;      // estimate of the rung
  uint64_t since = 0;    // first frame on this rung
  uint64_t switches = 0;
};

class Governor {
 public:
  // Forgets everything and starts in the middle of the range.
  void start(RungRange range);
  // Another budget or target on the same rungs: keeps what was learned.
  void retarget();

  // The rung of the frame that is recorded now.
  uint32_t beginFrame(uint64_t frame);
  // The frame that is recorded now has no volume: its time says nothing about rungs.
  void idle(uint64_t frame);

  // GPU time of a finished frame. Ignored, and false, if it is no time above 0; of an older frame
  // than the last, or of another rung, it changes nothing.
  bool feedTime(uint64_t frame, double milliseconds, double budget);

  bool wantsErrors(uint64_t frame) const { return frame >= nextErrors_; }
  // Estimates of all rungs for the frame that is planned now; true if the rung has changed.
  bool feedErrors(uint64_t frame, std::span<const double, RUNGS> errors, double target);

  const GovernorState& state() const { return state_; }

 private:
  static constexpr uint32_t WINDOW = 5;
  void switchTo(uint32_t rung);
  void forgetTimes();
  void learn();
  double timeOf(uint32_t rung) const;
  void decide(double budget);
  void step(uint32_t rung, bool up);

  RungRange range_;
  GovernorState state_;
  std::array<double, RUNGS> ratio_{};  // time of a rung over that of the one below it
  bool pending_ = true;                // no frame of this rung was recorded yet
  bool searching_ = true;              // since the start: larger steps up, and sooner
  uint64_t newest_ = 0;                // last frame with a time
  uint32_t skipped_ = 0;
  uint32_t count_ = 0;  // times on this rung
  std::array<double, WINDOW> window_{};
  uint32_t over_ = 0;
  uint32_t under_ = 0;
  uint32_t steady_ = 0;    // frames since the last switch or retry
  uint32_t upFrames_ = 0;  // GOVERNOR_UP_FRAMES, or more where steps up were taken back
  uint32_t retryFrames_ = 0;
  bool steppedUp_ = false;  // the last switch was one up
  uint32_t before_ = 0;     // the rung before the last switch, and its time; 0: unknown
  double timeBefore_ = 0;
  uint64_t nextErrors_ = 0;
  uint64_t calmSince_ = 0;
};

}  // namespace welkin
