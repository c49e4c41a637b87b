// SPDX-License-Identifier: MIT
// The measurements of welkin_volume_cost: time beside error of the library, of per-slice half-angle
// slicing and of a march on the CPU; sample rates; how the library's cost grows. ms.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/front_report.hpp"
#include "bench/volume_points.hpp"
#include "bench/volume_scene.hpp"

namespace bench {

struct VolumeOptions {
  // Pixels along the picture's edge: a million, half of 1080p. Of frames of 512 the waking of
  // threads is a quarter.
  uint32_t size = 1024;
  uint32_t rounds = 5;
  uint32_t truth = 32;  // compared pixels along the edge
  std::string only;     // case
  bool validation = false;
};

// One case, every method timed in turn with the others.
struct VolumeStudy {
  VolumeCase one;
  double occupied;
  double meanDepth;
  std::vector<VolumeRow> rows;
};
std::vector<VolumeStudy> studyVolumes(const VolumeOptions& options, Ordered& device);

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
