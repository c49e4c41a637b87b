// SPDX-License-Identifier: MIT
// The cases of cases.glsl on the CPU, and inputs for them.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace parity {

#include "parity/case_list.glsl"

using Row = std::array<float, 20>;     // five vec4
using Result = std::array<double, 8>;  // two vec4

Result evaluateFloat(int which, const Row& row);
Result evaluateDouble(int which, const Row& row);
// In float, where the compiler may fuse products and sums; only where canFuse().
Result evaluateFused(int which, const Row& row);
bool canFuse();
// In double, but operations and built-ins are off by what Vulkan allows a device, signs at random
// from `seed`: the difference to evaluateDouble is condition times bound.
Result evaluateNoisy(int which, const Row& row, unsigned seed);

// Inputs of one case: the extremes first, then random ones that cover the range of use.
std::vector<Row> inputs(int which, size_t count);

const char* caseName(int which);

}  // namespace parity
