// SPDX-License-Identifier: MIT
// What the user sets while the engine runs.
#pragma once

#include <welkin/welkin.h>

struct Size {  // of the window, pixels
  uint32_t width = 1280;
  uint32_t height = 720;
};

struct Settings {
  double hour = 9.0;                 // local solar time
  float dropletDiameter_um = 20.0f;  // of the sample's clouds
  float cloudExtinction = 0.03f;     // 1/m where their field is 1
  uint32_t quality = WLK_QUALITY_MEDIUM;
  float timeBudget_ms = 0.0f;  // of Welkin's part of a frame, kept by its governor; 0: none
};

// What the panel's widgets and the script's actions allow.
struct Range {
  float least;
  float most;
};
inline constexpr Range HOURS{0.0f, 24.0f};
inline constexpr Range DROPLET_DIAMETERS_um{5.0f, 50.0f};
inline constexpr Range CLOUD_EXTINCTIONS{0.001f, 0.2f};
inline constexpr Range TIME_BUDGETS_ms{1.0f, 200.0f};
