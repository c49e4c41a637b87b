// SPDX-License-Identifier: MIT
// Points of time and error, their fronts, and how cost grows. ms.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace bench {

// What one method took at one number of slices.
struct VolumeRow {
  std::string method;  // welkin, slicer, bare, cpu
  uint32_t slices;
  uint32_t lightSize;
  double time_ms;
  double deviation_ms;
  double cpu_ms;
  double error;  // relative root mean square; negative: none
  double bias;
  uint64_t samples;  // of the eye, in the box
  double eye_ms;     // of the eye pass alone, where known
  double light_ms;
  uint64_t invocations;
  uint64_t commands;  // dispatches or draws
};

// Least time at an error by straight lines between the points of the method's front, in logarithms;
// negative where the front does not reach.
double timeAtError(const std::vector<VolumeRow>& rows, const std::string& method, double error,
                   double VolumeRow::*time);
// RMS of the difference over the truth's mean by which reports tell smaller errors from larger
// ones.
constexpr double DIVIDING_ERROR = 0.5;
// Errors that both methods reach, largest first: the ends of the common range, its middle in
// logarithms, and DIVIDING_ERROR where it lies within.
std::vector<double> commonErrors(const std::vector<VolumeRow>& rows);

// value = offset + slope x by least squares, the part of the variance it explains, and the slope of
// the logarithms.
struct Fit {
  double offset;
  double slope;
  double explained;
  double exponent;
};
Fit fitLine(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace bench
