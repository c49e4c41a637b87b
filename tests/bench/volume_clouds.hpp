// SPDX-License-Identifier: MIT
// Extinction of the clouds of volume_truth.hpp, 1/m, x fastest.
#pragma once

#include <string>
#include <vector>

namespace bench {

/// Of cumulusCases().
std::vector<float> cumulusExtinction();

/// Of lesCases(), by the text file of the simulation's data, which is not part of this repository.
std::vector<float> lesExtinction(const std::string& file);

}  // namespace bench
