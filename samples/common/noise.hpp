// SPDX-License-Identifier: MIT
// Seedable lattice noise for terrain and clouds: integer hashes only, so every machine agrees.
#pragma once

#include <cmath>
#include <cstdint>

#include "common/vec.hpp"

namespace host {

/// A well mixed 32-bit value of a lattice point (the "lowbias32" finaliser of C. Wellons, thrice).
inline uint32_t hashLattice(int32_t x, int32_t y, int32_t z, uint32_t seed) {
  const auto mix = [](uint32_t v) {
    v = (v ^ (v >> 16)) * 0x7feb352du;
    v = (v ^ (v >> 15)) * 0x846ca68bu;
    return v ^ (v >> 16);
  };
  return mix(static_cast<uint32_t>(x) +
             mix(static_cast<uint32_t>(y) + mix(static_cast<uint32_t>(z) + mix(seed))));
}

/// A number in [0, 1) from a hash.
inline double unitFromHash(uint32_t hash) {
  return (hash >> 8) * (1.0 / 16777216.0);
}

/// Gradient noise, smooth, in about [-1, 1], period none. K. Perlin, "Improving noise", 2002,
/// with 16 random gradients along the edges of a cube.
inline double perlin(Vec3 p, uint32_t seed) {
  const double fx = std::floor(p.x);
  const double fy = std::floor(p.y);
  const double fz = std::floor(p.z);
  const Vec3 local{p.x - fx, p.y - fy, p.z - fz};
  const auto fade = [](double t) { return t * t * t * (t * (t * 6.0 - 15.0) + 10.0); };
  const Vec3 weight{fade(local.x), fade(local.y), fade(local.z)};
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const int i = corner & 1;
    const int j = (corner >> 1) & 1;
    const int k = corner >> 2;
    const uint32_t hash = hashLattice(static_cast<int32_t>(fx) + i, static_cast<int32_t>(fy) + j,
                                      static_cast<int32_t>(fz) + k, seed) >>
                          28;
    const Vec3 d{local.x - i, local.y - j, local.z - k};
    const double u = hash < 8 ? d.x : d.y;
    const double v = hash < 4 ? d.y : (hash == 12 || hash == 14 ? d.x : d.z);
    const double gradient = ((hash & 1) == 0 ? u : -u) + ((hash & 2) == 0 ? v : -v);
    sum += gradient * (i == 1 ? weight.x : 1.0 - weight.x) * (j == 1 ? weight.y : 1.0 - weight.y) *
           (k == 1 ? weight.z : 1.0 - weight.z);
  }
  return sum;
}

/// Distance to the nearest of one random point per cell, in [0, about 1.5]. S. Worley, 1996.
inline double worley(Vec3 p, uint32_t seed) {
  const auto cellX = static_cast<int32_t>(std::floor(p.x));
  const auto cellY = static_cast<int32_t>(std::floor(p.y));
  const auto cellZ = static_cast<int32_t>(std::floor(p.z));
  double nearest = 4.0;
  for (int32_t k = cellZ - 1; k <= cellZ + 1; ++k) {
    for (int32_t j = cellY - 1; j <= cellY + 1; ++j) {
      for (int32_t i = cellX - 1; i <= cellX + 1; ++i) {
        const uint32_t hash = hashLattice(i, j, k, seed);
        // Three coordinates of 10 bits from one hash: 0.1 % of a cell is finer than any voxel.
        const Vec3 d{i + (hash & 1023u) / 1024.0 - p.x, j + ((hash >> 10) & 1023u) / 1024.0 - p.y,
                     k + ((hash >> 20) & 1023u) / 1024.0 - p.z};
        nearest = std::fmin(nearest, dot(d, d));
      }
    }
  }
  return std::sqrt(nearest);
}

/// Sum of `octaves` of perlin, each of twice the frequency and half the amplitude; about [-1, 1].
inline double fbm(Vec3 p, int octaves, uint32_t seed) {
  double sum = 0.0;
  double amplitude = 0.5;
  for (int i = 0; i < octaves; ++i) {
    sum += amplitude * perlin(p, seed + static_cast<uint32_t>(i));
    amplitude *= 0.5;
    // The shift keeps lattice points of successive octaves apart.
    p = p * 2.0 + Vec3{0.31, 0.57, 0.73};
  }
  return sum;
}

}  // namespace host
