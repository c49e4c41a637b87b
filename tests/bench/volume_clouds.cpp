// SPDX-License-Identifier: MIT
#include "bench/volume_clouds.hpp"

#include "common/volume.hpp"

namespace bench {
namespace {

constexpr float CUMULUS_DENSITY = 0.05F;  // extinction at density 1, 1/m

// Data (x, y, z) with z up to rows of the world, (x, z, -y).
std::vector<float> turnedUp(const host::Grid& grid) {
  const auto [nx, ny, nz] = grid.size;
  std::vector<float> values;
  for (uint32_t z = ny; z-- > 0;) {
    for (uint32_t y = 0; y < nz; ++y) {
      const auto row = grid.values.begin() + std::ptrdiff_t{nx} * (z + std::ptrdiff_t{ny} * y);
      values.insert(values.end(), row, row + nx);
    }
  }
  return values;
}

}  // namespace

std::vector<float> cumulusExtinction() {
  host::CumulusInfo info;
  info.size = {96, 72, 96};
  std::vector<float> values = host::makeCumulus(info).values;
  for (float& value : values) {
    value *= CUMULUS_DENSITY;
  }
  return values;
}

std::vector<float> lesExtinction(const std::string& file) {
  return turnedUp(host::loadLes(file, host::LesInfo{}));
}

}  // namespace bench
