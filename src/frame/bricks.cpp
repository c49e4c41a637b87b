// SPDX-License-Identifier: MIT
#include "frame/bricks.hpp"

#include <algorithm>
#include <cmath>

namespace welkin {
namespace {

// Bits of all m whose axes are among `axes`.
constexpr std::array<uint8_t, 8> SUBSETS = [] {
  std::array<uint8_t, 8> bits{};
  for (uint32_t axes = 0; axes < 8; ++axes) {
    for (uint32_t m = 0; m < 8; ++m) {
      if ((m & ~axes) == 0) {
        bits[axes] = static_cast<uint8_t>(bits[axes] | 1u << m);
      }
    }
  }
  return bits;
}();

}  // namespace

BrickGrid brickGrid(const Edges& size) {
  BrickGrid grid;
  for (size_t i = 0; i < size.size(); ++i) {
    grid.count[i] = (size[i] + BRICK_EDGE - 1) / BRICK_EDGE;
  }
  return grid;
}

uint8_t facesOf(const Edges& voxel) {
  uint32_t axes = 0;
  for (uint32_t i = 0; i < 3; ++i) {
    axes |= (voxel[i] % BRICK_EDGE == 0 ? 1u : 0u) << i;
  }
  return SUBSETS[axes];
}

bool hasBrickBefore(const Edges& brick, uint32_t axes) {
  for (uint32_t i = 0; i < 3; ++i) {
    if ((axes >> i & 1u) != 0 && brick[i] == 0) {
      return false;
    }
  }
  return true;
}

size_t brickBefore(const BrickGrid& grid, size_t index, uint32_t axes) {
  return index - (axes & 1u) - (axes >> 1 & 1u) * size_t{grid.count[0]} -
         (axes >> 2 & 1u) * size_t{grid.count[0]} * grid.count[1];
}

uint64_t countOccupied(std::span<const uint8_t> faces) {
  return static_cast<uint64_t>(
      std::count_if(faces.begin(), faces.end(), [](uint8_t bits) { return bits != 0; }));
}

std::pmr::vector<uint32_t> reachedBricks(const BrickGrid& grid, std::span<const uint8_t> faces,
                                         std::span<const uint32_t> occupied,
                                         std::pmr::memory_resource* memory) {
  std::pmr::vector<uint32_t> reached(memory);
  reached.reserve(occupied.size() + occupied.size() / 4);
  for (const uint32_t index : occupied) {
    const Edges brick = grid.brickOf(index);
    for (uint32_t axes = 0; axes < 8; ++axes) {
      if ((uint32_t{faces[index]} >> axes & 1u) != 0 && hasBrickBefore(brick, axes)) {
        reached.push_back(static_cast<uint32_t>(brickBefore(grid, index, axes)));
      }
    }
  }
  std::sort(reached.begin(), reached.end());
  reached.erase(std::unique(reached.begin(), reached.end()), reached.end());
  return reached;
}

namespace {

// Marks what the field's voxels reach with 0.
void markReached(const BrickGrid& grid, std::span<const uint8_t> faces,
                 std::span<uint8_t> distances) {
  for (size_t index = 0; index < faces.size(); ++index) {
    if (faces[index] == 0) {
      continue;
    }
    const Edges brick = grid.brickOf(index);
    for (uint32_t axes = 0; axes < 8; ++axes) {
      if ((uint32_t{faces[index]} >> axes & 1u) != 0 && hasBrickBefore(brick, axes)) {
        distances[brickBefore(grid, index, axes)] = 0;
      }
    }
  }
}

// One more than the least of the 13 neighbours that come before a brick in the order of `sign`.
uint32_t fromNeighbours(const BrickGrid& grid, const Edges& brick, int sign,
                        std::span<const uint8_t> distances) {
  uint32_t least = 255;
  const auto look = [&](int dx, int dy, int dz) {
    const Edges at{brick[0] + static_cast<uint32_t>(sign * dx),
                   brick[1] + static_cast<uint32_t>(sign * dy),
                   brick[2] + static_cast<uint32_t>(sign * dz)};
    if (at[0] < grid.count[0] && at[1] < grid.count[1] && at[2] < grid.count[2]) {
      least = std::min<uint32_t>(least, distances[grid.at(at)]);
    }
  };
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      look(dx, dy, -1);
    }
  }
  for (int dx = -1; dx <= 1; ++dx) {
    look(dx, -1, 0);
  }
  look(-1, 0, 0);
  return least + 1;
}

}  // namespace

// Two sweeps over all neighbours give the chessboard distance exactly (Rosenfeld and Pfaltz 1968).
void brickDistances(const BrickGrid& grid, std::span<const BrickFaces> fields,
                    std::span<uint8_t> distances) {
  std::fill(distances.begin(), distances.end(), uint8_t{255});
  for (const BrickFaces& faces : fields) {
    markReached(grid, faces, distances);
  }
  for (const int sign : {1, -1}) {
    for (size_t i = 0; i < distances.size(); ++i) {
      const size_t index = sign > 0 ? i : distances.size() - 1 - i;
      if (distances[index] > 1) {
        distances[index] = static_cast<uint8_t>(std::min<uint32_t>(
            distances[index], fromNeighbours(grid, grid.brickOf(index), sign, distances)));
      }
    }
  }
}

Edges atlasShape(uint64_t slots, uint32_t most) {
  most = std::min(most, MOST_SLOTS);
  Edges best{};
  uint64_t room = ~uint64_t{0};
  const auto cube = static_cast<uint64_t>(std::cbrt(static_cast<double>(slots)));
  const uint64_t first = std::clamp<uint64_t>(cube / 2, 1, std::max(most, 1u));
  // Near a cube, up to the whole width where the axes are short.
  const uint64_t last = std::min<uint64_t>(most, 4 * cube + 4);
  for (uint64_t x = first; x <= last; ++x) {
    for (uint64_t y = first; y <= x; ++y) {
      const uint64_t z = (slots + x * y - 1) / (x * y);
      if (z <= most && x * y * z < room) {
        room = x * y * z;
        best = {static_cast<uint32_t>(x), static_cast<uint32_t>(y), static_cast<uint32_t>(z)};
      }
    }
  }
  return best;
}

Edges slotCorner(const Edges& shape, uint64_t slot) {
  return {static_cast<uint32_t>(slot % shape[0]), static_cast<uint32_t>(slot / shape[0] % shape[1]),
          static_cast<uint32_t>(slot / shape[0] / shape[1])};
}

float pageOf(const Edges& shape, uint64_t slot) {
  const Edges corner = slotCorner(shape, slot);
  return static_cast<float>(1 + corner[0] + (corner[1] << 8) + (corner[2] << 16));
}

}  // namespace welkin
