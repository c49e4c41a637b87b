// SPDX-License-Identifier: MIT
// Text of large-eddy simulations: the first byte says how to read it.
#include "common/error.hpp"
#include "common/volume.hpp"
#include "input.hpp"

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  if (size == 0) {
    return 0;
  }
  host::LesInfo info;
  info.indexBase = data[0] % 3 - 1;
  info.diameters = (data[0] & 64) != 0;
  const fuzz::File file(data + 1, size - 1);
  try {
    const host::Grid grid = host::loadLes(file.path(), info);
    fuzz::require(grid.values.size() == size_t{grid.size[0]} * grid.size[1] * grid.size[2],
                  "a value for each cell");
    for (const float value : grid.values) {
      fuzz::require(std::isfinite(value) && value >= 0.0f, "cells are finite, not negative");
    }
  } catch (const host::InputError&) {
    // What is expected of most inputs.
  }
  return 0;
}
