// SPDX-License-Identifier: MIT
// The ladder of settings between the quality levels that a governed view moves on: points of the
// measured front of time and error, cheapest first (docs/accuracy-and-performance.md). Rungs differ
// in sizes only, never in a pipeline. No Vulkan.
#pragma once

#include "frame/plan.hpp"

namespace welkin {

constexpr uint32_t RUNGS = 12;

// The rung that is a quality level.
uint32_t rungOfLevel(uint32_t level);

// Time of a rung over that of the one below it, before anything was measured.
double usualRatio(uint32_t rung);

// Rungs a governed view may take.
struct RungRange {
  uint32_t lowest = 0;
  uint32_t highest = 0;
};
RungRange rungRange(const WlkQuality& quality);

inline bool governed(const WlkQuality& quality) {
  return quality.control != WLK_CONTROL_LEVEL;
}

// What a governed view draws on a rung, with room for the highest of its range.
SliceQuality rungQuality(const WlkQuality& quality, uint32_t rung);

// What buffers must have room for: the quality itself, or the largest sizes of all rungs in range.
SliceQuality roomFor(const WlkQuality& quality);

}  // namespace welkin
