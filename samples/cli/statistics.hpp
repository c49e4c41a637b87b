// SPDX-License-Identifier: MIT
// What a render cost, as JSON.
#pragma once

#include <string>
#include <vector>

#include "common/scene.hpp"

namespace cli {

/// Host-side times in milliseconds.
struct RenderTimes {
  double load_ms = 0.0;
  double prepare_ms = 0.0;
  std::vector<double> frames_ms;
  double total_ms = 0.0;
};

/// Writes scene, device, times, frame statistics and the plan's passes with their reasons.
/// Throws HostError.
void writeStatistics(const std::string& file, WlkContext context, WlkView view,
                     const host::Scene& scene, const RenderTimes& times);

}  // namespace cli
