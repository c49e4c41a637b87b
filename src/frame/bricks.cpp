// SPDX-License-Identifier: MIT
#include "frame/bricks.hpp"

#include <algorithm>
#include <cmath>

namespace welkin {
namespace {

constexpr uint32_t HALF_EDGE = BRICK_EDGE / 2;

// Bits of the places along each axis that `places` holds (bit i: place i).
constexpr uint64_t bitsAt(const std::array<uint32_t, 3>& places) {
  uint64_t bits = 0;
  for (uint32_t bit = 0; bit < 64; ++bit) {
    const bool in = (places[0] >> bit % 4 & 1u) != 0 && (places[1] >> bit / 4 % 4 & 1u) != 0 &&
                    (places[2] >> bit / 16 & 1u) != 0;
    bits |= uint64_t{in} << bit;
  }
  return bits;
}

constexpr uint32_t FIRST = 0b0001;
constexpr uint32_t ANYWHERE = 0b1111;

// Voxels that lie in the first layer along all axes of m: the brick before along those needs them.
constexpr std::array<uint64_t, 8> LAYERS = [] {
  std::array<uint64_t, 8> layers{};
  for (uint32_t m = 0; m < 8; ++m) {
    layers[m] = bitsAt({(m & 1u) != 0 ? FIRST : ANYWHERE, (m & 2u) != 0 ? FIRST : ANYWHERE,
                        (m & 4u) != 0 ? FIRST : ANYWHERE});
  }
  return layers;
}();

// Halves along an axis that a voxel reaches: of its own brick, and the second of the one before.
struct Reach {
  uint32_t places;
  uint32_t half;
  uint32_t before;
};
constexpr std::array<Reach, 3> REACHES{{{0b0111, 0, 0}, {0b1100, 1, 0}, {FIRST, 1, 1}}};

struct EighthReach {
  uint64_t bits;
  uint32_t before;  // axes
  uint8_t eighth;   // its bit
};
constexpr std::array<EighthReach, 27> EIGHTHS = [] {
  std::array<EighthReach, 27> list{};
  for (uint32_t i = 0; i < list.size(); ++i) {
    const Reach& x = REACHES[i % 3];
    const Reach& y = REACHES[i / 3 % 3];
    const Reach& z = REACHES[i / 9];
    list[i] = {bitsAt({x.places, y.places, z.places}), x.before | y.before << 1 | z.before << 2,
               static_cast<uint8_t>(1u << (x.half | y.half << 1 | z.half << 2))};
  }
  return list;
}();

uint32_t placeOf(uint32_t voxel) {
  const uint32_t inHalf = voxel % HALF_EDGE;
  return (voxel % BRICK_EDGE < HALF_EDGE ? 0u : 2u) + (inHalf == 0 ? 0u : 1u);
}

}  // namespace

BrickGrid brickGrid(const Edges& size) {
  BrickGrid grid;
  for (size_t i = 0; i < size.size(); ++i) {
    grid.count[i] = (size[i] + BRICK_EDGE - 1) / BRICK_EDGE;
  }
  return grid;
}

uint64_t facesOf(const Edges& voxel) {
  return uint64_t{1} << (placeOf(voxel[0]) + 4 * placeOf(voxel[1]) + 16 * placeOf(voxel[2]));
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

uint64_t countOccupied(std::span<const uint64_t> faces) {
  return static_cast<uint64_t>(
      std::count_if(faces.begin(), faces.end(), [](uint64_t bits) { return bits != 0; }));
}

std::pmr::vector<uint32_t> reachedBricks(const BrickGrid& grid, std::span<const uint64_t> faces,
                                         std::span<const uint32_t> occupied,
                                         std::pmr::memory_resource* memory) {
  std::pmr::vector<uint32_t> reached(memory);
  reached.reserve(occupied.size() + occupied.size() / 4);
  for (const uint32_t index : occupied) {
    const Edges brick = grid.brickOf(index);
    for (uint32_t axes = 0; axes < 8; ++axes) {
      if ((faces[index] & LAYERS[axes]) != 0 && hasBrickBefore(brick, axes)) {
        reached.push_back(static_cast<uint32_t>(brickBefore(grid, index, axes)));
      }
    }
  }
  std::sort(reached.begin(), reached.end());
  reached.erase(std::unique(reached.begin(), reached.end()), reached.end());
  return reached;
}

namespace {

// Marks the eighths that the field's voxels reach.
void markReached(const BrickGrid& grid, std::span<const uint64_t> faces,
                 std::span<BrickLeap> leaps) {
  for (size_t index = 0; index < faces.size(); ++index) {
    if (faces[index] == 0) {
      continue;
    }
    const Edges brick = grid.brickOf(index);
    for (const EighthReach& reach : EIGHTHS) {
      if ((faces[index] & reach.bits) != 0 && hasBrickBefore(brick, reach.before)) {
        BrickLeap& leap = leaps[brickBefore(grid, index, reach.before)];
        leap.distance = 0;
        leap.eighths = static_cast<uint8_t>(leap.eighths | reach.eighth);
      }
    }
  }
}

// One more than the least of the 13 neighbours that come before a brick in the order of `sign`.
uint32_t fromNeighbours(const BrickGrid& grid, const Edges& brick, int sign,
                        std::span<const BrickLeap> leaps) {
  uint32_t least = 255;
  const auto look = [&](int dx, int dy, int dz) {
    const Edges at{brick[0] + static_cast<uint32_t>(sign * dx),
                   brick[1] + static_cast<uint32_t>(sign * dy),
                   brick[2] + static_cast<uint32_t>(sign * dz)};
    if (at[0] < grid.count[0] && at[1] < grid.count[1] && at[2] < grid.count[2]) {
      least = std::min<uint32_t>(least, leaps[grid.at(at)].distance);
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
void findLeaps(const BrickGrid& grid, std::span<const BrickFaces> fields,
               std::span<BrickLeap> leaps) {
  std::fill(leaps.begin(), leaps.end(), BrickLeap{255, 0});
  for (const BrickFaces& faces : fields) {
    markReached(grid, faces, leaps);
  }
  for (const int sign : {1, -1}) {
    for (size_t i = 0; i < leaps.size(); ++i) {
      const size_t index = sign > 0 ? i : leaps.size() - 1 - i;
      uint8_t& distance = leaps[index].distance;
      if (distance > 1) {
        distance = static_cast<uint8_t>(
            std::min<uint32_t>(distance, fromNeighbours(grid, grid.brickOf(index), sign, leaps)));
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
