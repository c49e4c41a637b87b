// SPDX-License-Identifier: MIT
// Raw volumes: the input is the description, then the file.
#include "common/error.hpp"
#include "common/volume.hpp"
#include "input.hpp"

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  constexpr size_t DESCRIPTION = 16;
  fuzz::Input input(data, std::min(size, DESCRIPTION));
  host::RawInfo info;
  info.format = static_cast<host::RawFormat>(input.below(3));
  info.up = static_cast<host::UpAxis>(input.below(2));
  const bool small = !input.oneIn(4);  // an edge of any 32 bits seldom fits a file
  for (uint32_t& edge : info.size) {
    edge = small ? input.below(8) : input.take<uint32_t>();
  }
  const size_t used = std::min(size, DESCRIPTION);
  const fuzz::File file(data + used, size - used);
  try {
    const host::Grid grid = host::loadRaw(file.path(), info);
    fuzz::require(grid.values.size() == size_t{grid.size[0]} * grid.size[1] * grid.size[2],
                  "a value for each voxel");
    for (const float value : grid.values) {
      fuzz::require(std::isfinite(value), "voxels are finite");
    }
  } catch (const host::InputError&) {
    // What is expected of most inputs.
  }
  return 0;
}
