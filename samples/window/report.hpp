// SPDX-License-Identifier: MIT
// What Welkin tells of the last frame: the panel draws it, a script prints it.
#pragma once

#include <welkin/welkin.h>

#include <string>
#include <vector>

struct FrameReport {
  WlkFrameStats frame{};
  std::vector<WlkPassStats> passes;
  WlkQualityState quality{};
  float relativeError = 0.0f;
  float dropletRadius_um = 0.0f;  // effective radius of the sample's own clouds; 0 without them
  bool ready = false;             // false before the first frame
};

// GPU time of all passes, ms.
float totalTime(const FrameReport& report);
// The part of a name that its kind does not share: "FITS" of "WLK_CONTROL_REASON_FITS".
const char* shortReason(const WlkPassStats& pass);
const char* shortReason(const WlkQualityState& quality);
// One line of "name=value", for programs to read.
std::string describe(const FrameReport& report);
