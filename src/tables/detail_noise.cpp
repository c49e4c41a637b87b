// SPDX-License-Identifier: MIT
#include "tables/detail_noise.hpp"

#include <algorithm>
#include <cmath>

namespace welkin {
namespace {

constexpr uint32_t EDGE = DETAIL_TEXELS;
constexpr uint32_t CELLS = DETAIL_LUMPS;
constexpr size_t TEXELS = size_t{EDGE} * EDGE * EDGE;
// Points lie in the middle of their cells, so that the nearest one within FARTHEST is in one of the
// eight cells around a place: in others it is 0.5 + MARGIN away.
constexpr float MARGIN = 0.2F;
constexpr float FARTHEST = 0.5F + MARGIN;

using Point = std::array<float, 3>;

// Of a permuted congruential generator (O'Neill 2014, RXS-M-XS), from 0 to 1.
float random(uint32_t& state) {
  state = state * 747796405U + 2891336453U;
  const uint32_t word = ((state >> ((state >> 28U) + 4U)) ^ state) * 277803737U;
  return static_cast<float>(((word >> 22U) ^ word) >> 8U) * 0x1p-24F;
}

std::vector<Point> scatteredPoints() {
  std::vector<Point> points(size_t{CELLS} * CELLS * CELLS);
  uint32_t state = 1;
  for (Point& p : points) {
    for (float& x : p) {
      x = MARGIN + (1 - 2 * MARGIN) * random(state);
    }
  }
  return points;
}

// Distance to the nearest point, at most FARTHEST; `place` in cells.
float nearest(const std::vector<Point>& points, const std::array<float, 3>& place) {
  float best = FARTHEST * FARTHEST;
  std::array<int, 3> first{};
  for (size_t k = 0; k < 3; ++k) {
    first[k] = static_cast<int>(std::floor(place[k] - 0.5F));
  }
  for (int corner = 0; corner < 8; ++corner) {
    size_t cell = 0;
    std::array<float, 3> away{};
    for (size_t k = 3; k-- > 0;) {
      const int at = first[k] + ((corner >> k) & 1);
      cell = cell * CELLS + static_cast<size_t>(at + static_cast<int>(CELLS)) % CELLS;
      away[k] = static_cast<float>(at) - place[k];
    }
    const Point& p = points[cell];
    float square = 0;
    for (size_t k = 0; k < 3; ++k) {
      square += (away[k] + p[k]) * (away[k] + p[k]);
    }
    best = std::min(best, square);
  }
  return std::sqrt(best);
}

size_t texelAt(uint32_t x, uint32_t y, uint32_t z, uint32_t edge) {
  return (size_t{z % edge} * edge + y % edge) * edge + x % edge;
}

std::vector<float> lumps() {
  const std::vector<Point> points = scatteredPoints();
  constexpr float SCALE = static_cast<float>(CELLS) / EDGE;
  std::vector<float> distance(TEXELS);
  for (uint32_t z = 0; z < EDGE; ++z) {
    for (uint32_t y = 0; y < EDGE; ++y) {
      for (uint32_t x = 0; x < EDGE; ++x) {
        distance[texelAt(x, y, z, EDGE)] = nearest(
            points, {(static_cast<float>(x) + 0.5F) * SCALE, (static_cast<float>(y) + 0.5F) * SCALE,
                     (static_cast<float>(z) + 0.5F) * SCALE});
      }
    }
  }
  return distance;
}

// Half and a quarter as large lumps are the same ones, moved.
std::vector<float> sizes(const std::vector<float>& large) {
  std::vector<float> sum(TEXELS);
  for (uint32_t z = 0; z < EDGE; ++z) {
    for (uint32_t y = 0; y < EDGE; ++y) {
      for (uint32_t x = 0; x < EDGE; ++x) {
        const size_t middle = texelAt(2 * x + 37, 2 * y + 59, 2 * z + 83, EDGE);
        const size_t small = texelAt(4 * x + 101, 4 * y + 13, 4 * z + 47, EDGE);
        sum[texelAt(x, y, z, EDGE)] =
            0.5F * large[texelAt(x, y, z, EDGE)] + 0.3F * large[middle] + 0.2F * large[small];
      }
    }
  }
  return sum;
}

// Each value becomes the part of all values below it: lumps are wide and round, fissures narrow,
// and the mean is a half.
void rank(std::vector<float>& values) {
  constexpr size_t BINS = 8192;
  constexpr float MOST = FARTHEST * 1.0001F;
  std::vector<uint32_t> below(BINS + 1);
  const auto place = [](float x) { return x * (static_cast<float>(BINS) / MOST); };
  for (const float x : values) {
    ++below[static_cast<size_t>(place(x)) + 1];
  }
  for (size_t i = 1; i <= BINS; ++i) {
    below[i] += below[i - 1];
  }
  for (float& x : values) {
    const auto bin = static_cast<size_t>(place(x));
    const float part = place(x) - static_cast<float>(bin);
    x = (static_cast<float>(below[bin]) + part * static_cast<float>(below[bin + 1] - below[bin])) /
        static_cast<float>(TEXELS);
  }
}

}  // namespace

size_t detailLevelBegin(uint32_t level) {
  size_t begin = 0;
  for (uint32_t edge = EDGE; level > 0; --level, edge /= 2) {
    begin += size_t{edge} * edge * edge;
  }
  return begin;
}

std::vector<uint32_t> detailFaces(const std::vector<uint8_t>& noise) {
  std::vector<uint32_t> faces;
  faces.reserve(noise.size());
  const uint8_t* level = noise.data();
  for (uint32_t edge = EDGE; edge > 0; edge /= 2) {
    for (uint32_t y = 0; y < edge; ++y) {
      for (uint32_t x = 0; x < edge; ++x) {
        for (uint32_t z = 0; z < edge; ++z) {
          const auto at = [&](uint32_t right, uint32_t down) {
            return uint32_t{level[texelAt((x + right) % edge, (y + down) % edge, z, edge)]};
          };
          faces.push_back(at(0, 0) | at(1, 0) << 8U | at(0, 1) << 16U | at(1, 1) << 24U);
        }
      }
    }
    level += size_t{edge} * edge * edge;
  }
  return faces;
}

std::vector<uint8_t> detailNoise() {
  std::vector<float> level = sizes(lumps());
  rank(level);
  std::vector<uint8_t> noise;
  noise.reserve(detailLevelBegin(DETAIL_LEVELS));
  for (uint32_t edge = EDGE;; edge /= 2) {
    for (const float x : level) {
      noise.push_back(static_cast<uint8_t>(std::lround(x * 255)));
    }
    if (edge == 1) {
      return noise;
    }
    const uint32_t half = edge / 2;
    std::vector<float> means(size_t{half} * half * half);
    for (uint32_t z = 0; z < half; ++z) {
      for (uint32_t y = 0; y < half; ++y) {
        for (uint32_t x = 0; x < half; ++x) {
          float sum = 0;
          for (uint32_t corner = 0; corner < 8; ++corner) {
            sum += level[texelAt(2 * x + (corner & 1U), 2 * y + (corner >> 1U & 1U),
                                 2 * z + (corner >> 2U), edge)];
          }
          means[texelAt(x, y, z, half)] = sum / 8;
        }
      }
    }
    level = std::move(means);
  }
}

double detailNoiseAt(const std::vector<uint8_t>& noise, const std::array<double, 3>& place) {
  std::array<uint32_t, 3> first{};
  std::array<double, 3> part{};
  for (size_t k = 0; k < 3; ++k) {
    const double texel = (place[k] - std::floor(place[k])) * EDGE - 0.5 + EDGE;
    first[k] = static_cast<uint32_t>(texel);
    part[k] = texel - first[k];
  }
  double sum = 0;
  for (uint32_t corner = 0; corner < 8; ++corner) {
    double weight = 1;
    std::array<uint32_t, 3> at = first;
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t next = corner >> k & 1U;
      weight *= next == 1 ? part[k] : 1 - part[k];
      at[k] += next;
    }
    sum += weight * noise[texelAt(at[0], at[1], at[2], EDGE)];
  }
  return sum / 255;
}

}  // namespace welkin
