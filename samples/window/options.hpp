// SPDX-License-Identifier: MIT
#pragma once

#include <welkin/welkin.h>

#include <string>

struct Options {
  uint32_t width = 1280;
  uint32_t height = 720;
  uint64_t frames = 0;  // 0: until the window is closed
  uint32_t composite = WLK_COMPOSITE_COMPUTE;
  uint32_t quality = WLK_QUALITY_MEDIUM;
  double hour = 9.0;  // local solar time
  std::string screenshot;
  bool validate = false;
};

// Reads the command line; prints and exits for --help and for errors.
Options parseOptions(int count, char** arguments);
