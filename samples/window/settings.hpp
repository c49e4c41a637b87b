// SPDX-License-Identifier: MIT
// What the user sets while the engine runs.
#pragma once

#include <welkin/welkin.h>

struct Settings {
  double hour = 9.0;                 // local solar time
  float dropletDiameter_um = 20.0f;  // of the sample's clouds
  float cloudExtinction = 0.03f;     // 1/m where their field is 1
  uint32_t quality = WLK_QUALITY_MEDIUM;
  float timeBudget_ms = 0.0f;  // of Welkin's part of a frame, kept by its governor; 0: none
};
