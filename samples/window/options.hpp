// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "script.hpp"
#include "settings.hpp"

struct Options {
  Size size;
  uint64_t frames = 0;  // 0: until the window is closed
  uint32_t composite = WLK_COMPOSITE_COMPUTE;
  Settings settings;  // as the engine starts
  std::string scene;  // a scene file instead of the sample's own air and clouds
  std::vector<Action> script;
  bool panel = false;  // also where a number of frames is asked for
  bool validate = false;
};

// Reads the command line; prints and exits for --help and for errors.
Options parseOptions(int count, char** arguments);
