// SPDX-License-Identifier: MIT
#include "frame/governor.hpp"

#include <algorithm>
#include <cmath>

namespace welkin {
namespace {

constexpr uint32_t SKIP = 2;    // frames after a switch, which may hold work done once
constexpr uint32_t ENOUGH = 8;  // times before a rung is judged
constexpr double SMOOTH = 0.125;
constexpr double STEEPEST = 1.6;      // ratio of two rungs that a search reckons with at least
constexpr uint32_t RETRY = 1800;      // frames after which a learned ratio is doubted
constexpr uint32_t PATIENCE = 16;     // factor by which both waits may grow
constexpr uint32_t TAKEN_BACK = 240;  // frames within which a step down takes back one up
constexpr double CALM = 0.8;  // of the error target, below which a cheaper rung is looked for

}  // namespace

void Governor::start(RungRange range) {
  *this = Governor();
  range_ = range;
  for (uint32_t i = 0; i < RUNGS; ++i) {
    ratio_[i] = usualRatio(i);
  }
  state_.rung = (range.lowest + range.highest) / 2;
  upFrames_ = GOVERNOR_UP_FRAMES;
  retryFrames_ = RETRY;
}

void Governor::retarget() {
  searching_ = true;
  over_ = under_ = 0;
  upFrames_ = GOVERNOR_UP_FRAMES;
  retryFrames_ = RETRY;
  nextErrors_ = 0;
}

void Governor::forgetTimes() {
  skipped_ = count_ = over_ = under_ = steady_ = 0;
  state_.time = 0;
  state_.predicted = 0;
  state_.reason = WLK_CONTROL_REASON_MEASURING;
}

void Governor::switchTo(uint32_t rung) {
  before_ = state_.rung;
  timeBefore_ = state_.time;
  state_.rung = rung;
  ++state_.switches;
  pending_ = true;
  forgetTimes();
}

uint32_t Governor::beginFrame(uint64_t frame) {
  if (pending_) {
    state_.since = frame;
    pending_ = false;
  }
  return state_.rung;
}

void Governor::idle(uint64_t frame) {
  forgetTimes();
  timeBefore_ = 0;
  newest_ = std::max(newest_, frame);
  state_.reason = WLK_CONTROL_REASON_IDLE;
  nextErrors_ = 0;
}

// By the ratios, from the time of this rung.
double Governor::timeOf(uint32_t rung) const {
  double time = state_.time;
  for (uint32_t i = state_.rung; i < rung; ++i) {
    time *= ratio_[i + 1];
  }
  for (uint32_t i = rung; i < state_.rung; ++i) {
    time /= ratio_[i + 1];
  }
  return time;
}

// The ratio of this rung and the one before, now that both are measured. A ratio that turned out
// larger counts at once, since the next step up hangs on it; a smaller one by half. What else
// changed in the scene meanwhile is in it, too: bounded here, doubted after a while in decide().
void Governor::learn() {
  const uint32_t low = std::min(before_, state_.rung);
  const uint32_t high = std::max(before_, state_.rung);
  if (timeBefore_ <= 0 || low == high) {
    return;
  }
  const double change =
      before_ < state_.rung ? state_.time / timeBefore_ : timeBefore_ / state_.time;
  double expected = 1;
  for (uint32_t i = low + 1; i <= high; ++i) {
    expected *= ratio_[i];
  }
  const double correction = std::pow(change / expected, 1.0 / (high - low));
  for (uint32_t i = low + 1; i <= high; ++i) {
    const double usual = usualRatio(i);
    const double measured = std::clamp(ratio_[i] * correction, 1.0, 1.5 * usual);
    ratio_[i] = measured > ratio_[i] ? measured : 0.5 * (ratio_[i] + measured);
  }
  timeBefore_ = 0;
}

bool Governor::feedTime(uint64_t frame, double milliseconds, double budget) {
  if (!(milliseconds > 0 && milliseconds <= GOVERNOR_LONGEST)) {
    return false;
  }
  if (pending_ || frame < state_.since || frame <= newest_) {
    return true;
  }
  newest_ = frame;
  if (skipped_ < SKIP) {
    ++skipped_;
    return true;
  }
  // The median keeps single frames that took long out; the mean smooths what is left.
  window_[count_ % WINDOW] = milliseconds;
  ++count_;
  const uint32_t filled = std::min(count_, WINDOW);
  std::array<double, WINDOW> sorted = window_;
  std::sort(sorted.begin(), sorted.begin() + filled);
  const double median = 0.5 * (sorted[(filled - 1) / 2] + sorted[filled / 2]);
  state_.time = count_ <= WINDOW ? median : state_.time + SMOOTH * (median - state_.time);
  over_ = state_.time > budget ? over_ + 1 : 0;
  if (count_ < ENOUGH) {
    return true;
  }
  if (count_ == ENOUGH) {
    learn();
  }
  decide(budget);
  return true;
}

void Governor::step(uint32_t rung, bool up) {
  if (!up && steppedUp_ && steady_ < TAKEN_BACK) {
    upFrames_ = std::min(2 * upFrames_, PATIENCE * GOVERNOR_UP_FRAMES);
    retryFrames_ = std::min(2 * retryFrames_, PATIENCE * RETRY);
  }
  // The first step that is not up ends the search.
  searching_ = searching_ && (up || !steppedUp_);
  steppedUp_ = up;
  switchTo(rung);
}

void Governor::decide(double budget) {
  const uint32_t rung = state_.rung;
  const bool top = rung == range_.highest;
  ++steady_;
  if (steady_ % retryFrames_ == 0 && !top) {
    ratio_[rung + 1] = std::sqrt(ratio_[rung + 1] * usualRatio(rung + 1));
  }
  state_.predicted = top ? 0 : timeOf(rung + 1);
  if (state_.time > budget) {
    under_ = 0;
    if (rung == range_.lowest) {
      state_.reason = WLK_CONTROL_REASON_UNREACHABLE;
      searching_ = false;
      return;
    }
    state_.reason = WLK_CONTROL_REASON_OVER;
    if (over_ >= GOVERNOR_DOWN_FRAMES) {
      uint32_t next = rung - 1;
      while (next > range_.lowest && timeOf(next) > GOVERNOR_MARGIN * budget) {
        --next;
      }
      step(next, false);
    }
    return;
  }
  if (top) {
    state_.reason = WLK_CONTROL_REASON_BEST;
    searching_ = false;
    return;
  }
  const double allowed = GOVERNOR_MARGIN * budget;
  if (!(state_.predicted <= allowed)) {
    state_.reason = WLK_CONTROL_REASON_FITS;
    under_ = 0;
    searching_ = false;
    return;
  }
  state_.reason = WLK_CONTROL_REASON_RISING;
  ++under_;
  if (searching_) {
    uint32_t next = rung + 1;
    double time = state_.time * std::max(ratio_[next], STEEPEST);
    while (next < range_.highest) {
      time *= std::max(ratio_[next + 1], STEEPEST);
      if (!(time <= allowed)) {
        break;
      }
      ++next;
    }
    step(next, true);
  } else if (under_ >= upFrames_) {
    step(rung + 1, true);
  }
}

bool Governor::feedErrors(uint64_t frame, std::span<const double, RUNGS> errors, double target) {
  const auto cheapest = [&](double limit) {
    uint32_t rung = range_.lowest;
    while (rung < range_.highest && !(errors[rung] <= limit)) {
      ++rung;
    }
    return rung;
  };
  nextErrors_ = frame + GOVERNOR_ERROR_FRAMES;
  const uint32_t before = state_.rung;
  uint32_t next = before;
  const uint32_t needed = cheapest(target);
  const uint32_t calm = searching_ ? needed : cheapest(CALM * target);
  if (needed > before || searching_) {
    next = needed;
  } else if (calm >= before) {
    calmSince_ = frame;
  } else if (frame >= calmSince_ + GOVERNOR_UP_FRAMES) {
    next = calm;
  }
  searching_ = false;
  if (next != before) {
    switchTo(next);
    calmSince_ = frame;
  }
  state_.error = errors[next];
  state_.reason = errors[next] <= target ? uint32_t{WLK_CONTROL_REASON_FITS}
                                         : uint32_t{WLK_CONTROL_REASON_UNREACHABLE};
  return next != before;
}

}  // namespace welkin
