// SPDX-License-Identifier: MIT
// The control panel: what it shows and what the user asks for. Drawn with Dear ImGui.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "report.hpp"
#include "settings.hpp"

// What the user, or a script, asked for in this frame.
struct PanelRequest {
  bool clouds = false;       // droplets or density have changed
  bool quality = false;      // level or budget have changed
  std::string screenshot;    // a PNG file to write; empty: none
  std::string scene;         // a file to load; empty: none
  std::optional<Size> size;  // of the window: the panel leaves that to its frame
  bool report = false;       // print what the panel shows
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
