// SPDX-License-Identifier: MIT
// Which part of a volume's light is computed in a frame, and which light is shown: new light is
// computed over `frames` frames while earlier light fades into the one that was complete last. Pure
// data.
#pragma once

#include <array>
#include <cstdint>

namespace welkin {

// Lights that are kept: the one shown, the one that it fades from, the one in work.
constexpr uint32_t SPREAD_LIGHTS = 3;

enum class LightChange {
  None,
  Moved,  // the light came from nearly there before: what is known will do for a while
  Other   // nothing known is of use
};

// What a frame does, in this order.
struct LightStep {
  // Part [from, to) of `parts` of the light `target` is computed; to == 0: nothing is.
  uint32_t target = 0;
  uint32_t from = 0;
  uint32_t to = 0;
  uint32_t parts = 1;
  bool begins = false;  // with the numbers of this frame, which hold for all parts of `target`
  // `weight` of `shown`, the rest of `before`; 1: `shown` alone.
  uint32_t shown = 0;
  uint32_t before = 0;
  float weight = 1;

  bool computes() const { return to > 0; }
};

// With light that moves steadily each complete light fades in until the next is complete: what is
// shown lags by 2 frames - 2 frames and has no steps. Light at rest is shown as computed at once
// after 3 frames at most (LightSchedule.*).
class LightSchedule {
 public:
  // `frames` does not change between calls.
  LightStep next(LightChange change, uint32_t frames);
  // The light that was complete last; what has changed against it is to be computed.
  uint32_t newest() const { return shown_; }
  bool working() const { return parts_ > 0; }

 private:
  uint32_t shown_ = 0;
  uint32_t before_ = 0;
  uint32_t target_ = 0;
  uint32_t parts_ = 0;  // of `target_` computed, 0: none is in work
  uint32_t faded_ = 0;  // frames of the fade from `before_`; 0: over
};

}  // namespace welkin
