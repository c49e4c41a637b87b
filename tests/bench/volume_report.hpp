// SPDX-License-Identifier: MIT
// welkin_volume_cost's results as JSON and as tables in Markdown.
#pragma once

#include <string>
#include <vector>

#include "bench/volume_study.hpp"

namespace bench {

struct VolumeResults {
  std::vector<VolumeStudy> studies;
  std::vector<Scaling> scalings;
  Ordered skips;
  Ordered halfSky;  // per thread count
};

// What is wanted, what was measured, and whether it is reached.
struct Goal {
  std::string what;
  double wanted;
  bool atLeast;
  double measured;  // negative: not measured
  double byCpu;     // the same by CPU times, which the machine's other work disturbs less
  bool reached() const {
    const auto passes = [&](double value) {
      return value >= 0 && (atLeast ? value >= wanted : value <= wanted);
    };
    return passes(measured) && passes(byCpu);  // where they differ it is not shown
  }
};
std::vector<Goal> goalsOf(const VolumeResults& results);

Ordered volumeJson(const VolumeResults& results);
VolumeResults readVolumeJson(const Ordered& report);
std::string volumeTables(const VolumeResults& results);

// Replaces what stands between <!-- volume-cost:begin --> and <!-- volume-cost:end -->.
void writeBlock(const std::string& file, const std::string& text);

}  // namespace bench
