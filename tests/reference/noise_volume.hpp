// SPDX-License-Identifier: MIT
// Deterministic density fields for image tests: values in [0, 1], multiples of 1/1024, which half
// and single precision hold exactly, so that every path sees the same numbers.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace welkin::reference {

inline double latticeValue(int x, int y, int z) {
  uint32_t h = static_cast<uint32_t>(x) * 0x8da6b343u ^ static_cast<uint32_t>(y) * 0xd8163841u ^
               static_cast<uint32_t>(z) * 0xcb1ab31fu;
  h = (h ^ (h >> 13)) * 0x5bd1e995u;
  h = (h ^ (h >> 15)) * 0x2c1b3c6du;
  return static_cast<double>(h ^ (h >> 16)) / 4294967296.0;
}

// Value noise, C2 between lattice points.
inline double valueNoise(double x, double y, double z) {
  const double p[3] = {x, y, z};
  int i[3];
  double f[3];
  for (int k = 0; k < 3; ++k) {
    i[k] = static_cast<int>(std::floor(p[k]));
    const double t = p[k] - i[k];
    f[k] = t * t * t * (t * (6 * t - 15) + 10);
  }
  double sum = 0;
  for (int c = 0; c < 8; ++c) {
    const int a = c & 1;
    const int b = c >> 1 & 1;
    const int d = c >> 2;
    sum += (a ? f[0] : 1 - f[0]) * (b ? f[1] : 1 - f[1]) * (d ? f[2] : 1 - f[2]) *
           latticeValue(i[0] + a, i[1] + b, i[2] + d);
  }
  return sum;
}

// Octaves from `frequency` lattice cells per box, each with half the amplitude of the last.
inline double fractalNoise(double x, double y, double z, double frequency, int octaves) {
  double sum = 0;
  double amplitude = 0.5;
  for (int o = 0; o < octaves; ++o) {
    sum += amplitude * valueNoise(frequency * x + 17 * o, frequency * y, frequency * z);
    frequency *= 2;
    amplitude *= 0.5;
  }
  return sum;
}

template <typename F>
std::vector<float> sampleBox(int n, F f) {
  std::vector<float> values;
  values.reserve(static_cast<size_t>(n) * static_cast<size_t>(n) * static_cast<size_t>(n));
  for (int z = 0; z < n; ++z) {
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) {
        const double v = f((x + 0.5) / n, (y + 0.5) / n, (z + 0.5) / n);
        values.push_back(static_cast<float>(std::round(std::clamp(v, 0.0, 1.0) * 1024) / 1024));
      }
    }
  }
  return values;
}

inline double ballDistance(double x, double y, double z) {
  return std::sqrt((x - 0.5) * (x - 0.5) + (y - 0.5) * (y - 0.5) + (z - 0.5) * (z - 0.5));
}

// A ball of billows. Meant for NOISE_CLOUD_SIZE voxels along an edge and 0.3 optical depth per
// voxel at value 1: the densest column then has a depth of about 12.
constexpr int NOISE_CLOUD_SIZE = 64;
inline std::vector<float> noiseCloud() {
  return sampleBox(NOISE_CLOUD_SIZE, [](double x, double y, double z) {
    const double fall = std::clamp((0.5 - ballDistance(x, y, z)) / 0.2, 0.0, 1.0);
    return 5.0 * fall * (fractalNoise(x, y, z, 5, 4) - 0.36);
  });
}

// Of every so many of its voxels along each axis one.
inline std::vector<float> coarseNoiseCloud(size_t size) {
  constexpr size_t N = NOISE_CLOUD_SIZE;
  const std::vector<float> all = noiseCloud();
  std::vector<float> some;
  for (size_t i = 0; i < size * size * size; ++i) {
    some.push_back(all[N / size * (i % size + N * (i / size % size + N * (i / size / size)))]);
  }
  return some;
}

// As from a large-eddy simulation: full density within a voxel or two of the edge, holes inside.
// Meant for 4 optical depths per voxel at value 1.
constexpr int STEEP_CLOUD_SIZE = 40;
inline std::vector<float> steepCloud() {
  return sampleBox(STEEP_CLOUD_SIZE, [](double x, double y, double z) {
    const double edge = 0.33 + 0.35 * (fractalNoise(x, y, z, 6, 2) - 0.38);
    return (edge - ballDistance(x, y, z)) * 20 * fractalNoise(x, y, z, 9, 2);
  });
}

}  // namespace welkin::reference
