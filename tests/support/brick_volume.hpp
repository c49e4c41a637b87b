// SPDX-License-Identifier: MIT
// Voxels as the bricks that hold anything, for wlkUploadVolumeBricks.
#pragma once

#include <welkin/welkin.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>
#include <welkin/welkin.hpp>

namespace welkin::test {

struct BrickVolume {
  std::vector<uint32_t> coordinates;
  std::vector<float> values;

  WlkVolumeBricks upload(uint32_t field = 0) const {
    auto bricks = make<WlkVolumeBricks>();
    bricks.field = field;
    bricks.count = static_cast<uint32_t>(coordinates.size() / 3);
    bricks.coordinates = coordinates.data();
    bricks.data = values.data();
    bricks.dataSize = values.size() * sizeof(float);
    return bricks;
  }
};

inline BrickVolume bricksOf(const std::array<uint32_t, 3>& size, const std::vector<float>& values) {
  constexpr uint32_t EDGE = 8;
  BrickVolume made;
  for (uint32_t k = 0; k < size[2]; k += EDGE) {
    for (uint32_t j = 0; j < size[1]; j += EDGE) {
      for (uint32_t i = 0; i < size[0]; i += EDGE) {
        std::array<float, 512> brick{};
        for (uint32_t n = 0; n < brick.size(); ++n) {
          const uint32_t x = i + n % EDGE;
          const uint32_t y = j + n / EDGE % EDGE;
          const uint32_t z = k + n / (EDGE * EDGE);
          if (x < size[0] && y < size[1] && z < size[2]) {
            brick[n] = values[(size_t{z} * size[1] + y) * size[0] + x];
          }
        }
        if (std::any_of(brick.begin(), brick.end(), [](float x) { return x > 0; })) {
          made.coordinates.insert(made.coordinates.end(), {i / EDGE, j / EDGE, k / EDGE});
          made.values.insert(made.values.end(), brick.begin(), brick.end());
        }
      }
    }
  }
  return made;
}

}  // namespace welkin::test
