// SPDX-License-Identifier: MIT
// The control panel: what it shows and what the user asks for. Drawn with Dear ImGui.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "settings.hpp"

// What Welkin tells of the last frame.
struct FrameReport {
  WlkFrameStats frame{};
  std::vector<WlkPassStats> passes;
  WlkQualityState quality{};
  float relativeError = 0.0f;
  bool ready = false;  // false before the first frame
};

// What the user asked for in this frame.
struct PanelRequest {
  bool clouds = false;   // droplets or density have changed
  bool quality = false;  // level or budget have changed
  bool screenshot = false;
  std::string scene;  // a file to load; empty: none
};

class Panel {
 public:
  // Between ImGui's NewFrame and Render. `ownClouds`: the sample's clouds are shown, not a scene's.
  PanelRequest draw(Settings& settings, const FrameReport& report, bool ownClouds);
  // Adds a frame's wall time to the plot.
  void addFrame(float milliseconds);
  // Shown at the panel's foot until the next one.
  void setMessage(const std::string& message) { message_ = message; }

 private:
  void drawTimes() const;
  static void drawPasses(const FrameReport& report);

  std::array<float, 120> times_ms_{};  // a ring
  int next_ = 0;
  std::array<char, 256> sceneFile_{};
  std::string message_;
};
