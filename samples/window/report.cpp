// SPDX-License-Identifier: MIT
#include "report.hpp"

#include <array>
#include <cstdio>

namespace {

const char* controlName(uint32_t control) {
  constexpr std::array names{"level", "time", "reported-time", "error"};
  return control < names.size() ? names[control] : "?";
}

}  // namespace

float totalTime(const FrameReport& report) {
  float sum = 0.0f;
  for (const WlkPassStats& pass : report.passes) {
    sum += static_cast<float>(pass.gpuTime_ns) * 1e-6f;
  }
  return sum;
}

const char* shortReason(const WlkPassStats& pass) {
  return wlkReasonName(pass.reason) + sizeof "WLK_REASON_" - 1;
}

const char* shortReason(const WlkQualityState& quality) {
  return wlkControlReasonName(quality.reason) + sizeof "WLK_CONTROL_REASON_" - 1;
}

std::string describe(const FrameReport& report) {
  if (!report.ready) {
    return "frame=0";
  }
  std::array<char, 320> text{};
  std::snprintf(text.data(), text.size(),
                "frame=%llu control=%s reason=%s rung=%u lowest=%u highest=%u slices=%u "
                "time_ms=%.2f error=%.4f dispatches=%u draws=%u non_finite=%llu "
                "droplet_radius_um=%.3f",
                static_cast<unsigned long long>(report.frame.frameIndex),
                controlName(report.quality.control), shortReason(report.quality),
                report.quality.rung, report.quality.lowestRung, report.quality.highestRung,
                report.quality.sliceCount, double{totalTime(report)}, double{report.relativeError},
                report.frame.dispatches, report.frame.draws,
                static_cast<unsigned long long>(report.frame.nonFinitePixels),
                double{report.dropletRadius_um});
  return text.data();
}
