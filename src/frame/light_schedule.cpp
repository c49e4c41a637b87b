// SPDX-License-Identifier: MIT
#include "frame/light_schedule.hpp"

namespace welkin {

LightStep LightSchedule::next(LightChange change, uint32_t frames) {
  LightStep step;
  if (change == LightChange::Other || (change == LightChange::Moved && frames == 1)) {
    parts_ = faded_ = 0;
    step.target = step.shown = step.before = shown_;
    step.to = 1;
    step.begins = true;
    return step;
  }
  if (faded_ > 0) {
    faded_ = faded_ + 1 < frames ? faded_ + 1 : 0;
  }
  if (parts_ == 0 && change == LightChange::Moved) {
    // The fade from `before_` may not be over: neither of the two is written.
    target_ = 0;
    while (target_ == shown_ || target_ == before_) {
      ++target_;
    }
    step.begins = true;
  }
  if (parts_ > 0 || step.begins) {
    step.target = target_;
    step.from = parts_;
    step.to = ++parts_;
    step.parts = frames;
  }
  if (parts_ == frames) {
    parts_ = 0;
    before_ = shown_;
    shown_ = target_;
    faded_ = 1;
  }
  step.shown = shown_;
  step.before = faded_ > 0 ? before_ : shown_;
  step.weight = faded_ > 0 ? static_cast<float>(faded_) / static_cast<float>(frames) : 1.0f;
  return step;
}

}  // namespace welkin
