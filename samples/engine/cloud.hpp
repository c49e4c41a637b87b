// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

// Density of a field of cumulus, x fastest, each value in [0, 1].
struct CloudField {
  std::array<uint32_t, 3> size;
  std::vector<float> values;
};

CloudField makeCloudField();
