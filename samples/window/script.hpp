// SPDX-License-Identifier: MIT
// A user's visit to the panel, written down: each action of `--at FRAME:ACTION` writes what a
// widget would, so that runs without hands, such as tests, go the same way.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "panel.hpp"

struct Action {
  uint64_t frame = 0;  // before which it happens; the first is 1
  std::function<void(Settings&, PanelRequest&)> perform;
};

// "12:hour=18.5". Throws std::invalid_argument with what was expected instead.
Action parseAction(const std::string& text);
// The actions that there are, for --help.
std::string actionHelp();

// Picture file of the window after a frame.
Action screenshotAt(uint64_t frame, const std::string& file);

class Script {
 public:
  // Actions of one frame keep their order.
  explicit Script(std::vector<Action> actions);
  // The next action that is due before this frame, or null.
  const Action* next(uint64_t frame);

 private:
  std::vector<Action> actions_;
  size_t done_ = 0;
};
