// SPDX-License-Identifier: MIT
// Runs the hosts with a window in a virtual display and reads the pictures that they write.
#pragma once

#include <map>
#include <ostream>
#include <string>
#include <vector>

namespace host_program {

constexpr int WIDTH = 320;
constexpr int HEIGHT = 180;

// "320x180", as the options want it.
std::string size(int width, int height);

// An 8-bit picture, rows from the top; empty if it could not be read.
struct Picture {
  int width = 0;
  int height = 0;
  std::vector<unsigned char> rgb;

  bool empty() const { return rgb.empty(); }
  int at(int x, int y, int channel) const {
    return rgb.at(3 * static_cast<size_t>(y * width + x) + static_cast<size_t>(channel));
  }
  bool operator==(const Picture& other) const = default;
  // For GoogleTest's messages, which would show addresses.
  friend void PrintTo(const Picture& picture, std::ostream* stream) {
    *stream << size(picture.width, picture.height) << " pixels";
  }
};

// A part of a picture: columns [x0, x1), rows [y0, y1).
struct Region {
  int x0, y0, x1, y1;
};
constexpr int RED = 0;
constexpr int GREEN = 1;
constexpr int BLUE = 2;
double mean(const Picture& picture, const Region& region, int channel);
// Of all channels.
double mean(const Picture& picture, const Region& region);

Picture cut(const Picture& picture, const Region& region);

// Of any value; 256 for pictures of different sizes.
int largestDifference(const Picture& a, const Picture& b);
// Between composite modes. Half-float rounding (2^-10) moves an 8-bit value by less than one step,
// plus its rounding.
constexpr int ROUNDING = 2;

// Exit status, or -1.
int runProgram(const std::string& program, const std::string& arguments);
int runWindow(const std::string& arguments);

// A path for this process that no file has.
std::string temporary(const std::string& name);
// The file, which is removed. Fails the test, and is empty, where there is none.
Picture readPicture(const std::string& file);

// The "name=value" of each line that a program prints, when it ends with status 0; else fails the
// test.
using Report = std::map<std::string, std::string>;
std::vector<Report> reports(const std::string& arguments);
double number(const Report& report, const std::string& name);

}  // namespace host_program

// Where nothing can show a window there is nothing to test.
#define SKIP_WITHOUT(program)                                      \
  if (std::string(program).empty()) {                              \
    GTEST_SKIP() << "no such sample or no xvfb-run in this build"; \
  }                                                                \
  static_assert(true)
