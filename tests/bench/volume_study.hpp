// SPDX-License-Identifier: MIT
// The measurements of welkin_volume_cost: time beside error of the library, of per-slice half-angle
// slicing and of a march on the CPU; sample rates; how the library's cost grows. ms.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/front_report.hpp"
#include "bench/volume_scene.hpp"

namespace bench {

struct VolumeOptions {
  uint32_t size = 512;  // pixels along the picture's edge
  uint32_t rounds = 5;
  uint32_t truth = 32;  // compared pixels along the edge
  std::string only;     // case
  bool validation = false;
};

// Rows of one case, every method timed in turn with the others.
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
struct VolumeStudy {
  VolumeCase one;
  double occupied;
  double meanDepth;
  std::vector<VolumeRow> rows;
};
std::vector<VolumeStudy> studyVolumes(const VolumeOptions& options, Ordered& device);

// Least time at an error by straight lines between the points of the method's front, in logarithms;
// negative where the front does not reach.
double timeAtError(const std::vector<VolumeRow>& rows, const std::string& method, double error,
                   double VolumeRow::*time);
// Errors that both methods reach: the ends of the common range and its middle, in logarithms.
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

struct Scaling {
  std::string what;
  std::vector<double> x;
  std::vector<double> time_ms;
  std::vector<double> cpu_ms;
  std::vector<double> invocations;
};
std::vector<Scaling> measureScaling(const VolumeOptions& options);

// What the plan records for nothing, for an empty volume and for a second view.
Ordered measureSkips(const VolumeOptions& options);

// Frame times of sky above, cloud below; run in a process of its own.
Ordered measureHalfSky(const VolumeOptions& options);

}  // namespace bench
