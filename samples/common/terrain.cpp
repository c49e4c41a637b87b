// SPDX-License-Identifier: MIT
// A height field of ridged multifractal noise (F. K. Musgrave, "Texturing and Modeling", ch. 16).
#include <algorithm>
#include <cmath>

#include "common/geometry.hpp"
#include "common/noise.hpp"
#include "common/parallel.hpp"

namespace host {
namespace {

constexpr int OCTAVES = 9;

// Ridges where the noise crosses 0, each octave weighted by the one before: rough peaks, smooth
// valleys. In [0, about 1].
double ridged(Vec3 p, uint32_t seed) {
  double sum = 0.0;
  double amplitude = 0.5;
  double weight = 1.0;
  for (uint32_t octave = 0; octave < OCTAVES; ++octave) {
    const double ridge = 1.0 - std::min(std::abs(perlin(p, seed + octave)) * 1.4, 1.0);
    const double signal = ridge * ridge * weight;
    weight = std::clamp(signal * 1.6, 0.0, 1.0);
    sum += amplitude * signal;
    amplitude *= 0.48;
    p = p * 2.03 + Vec3{0.31, 0.57, 0.73};
  }
  return sum;
}

double heightAt(const TerrainInfo& info, double x, double z) {
  const Vec3 p = Vec3{x, 0.0, z} * (1.0 / info.featureSize);
  const double relief = ridged(p, info.seed);
  const double lowland = 0.5 + 0.5 * fbm(p * 0.6 + Vec3{7.1, 3.3, 1.7}, 4, info.seed + 100);
  // From 85 % of the half edge outwards everything sinks.
  const double rim = std::max(std::abs(x), std::abs(z)) / (0.5 * info.extent);
  const double fade = std::clamp((1.0 - rim) / 0.15, 0.0, 1.0);
  const double rise = fade * fade * (3.0 - 2.0 * fade);
  return info.amplitude * (relief * lowland * 1.7 - 0.12) * rise -
         0.05 * info.amplitude * (1 - rise);
}

}  // namespace

HeightField::HeightField(const TerrainInfo& info)
    : extent_(info.extent), resolution_(info.resolution) {
  const uint32_t points = resolution_ + 1;
  heights_.resize(size_t{points} * points);
  parallelFor(points, [&](uint32_t row) {
    for (uint32_t column = 0; column < points; ++column) {
      const double x = (static_cast<double>(column) / resolution_ - 0.5) * extent_;
      const double z = (static_cast<double>(row) / resolution_ - 0.5) * extent_;
      heights_[size_t{row} * points + column] =
          static_cast<float>(heightAt(info, x, z) + info.centre.y);
    }
  });
  const auto [low, high] = std::minmax_element(heights_.begin(), heights_.end());
  lowest_ = double{*low};
  highest_ = double{*high};
}

double HeightField::height(double x, double z) const {
  const double u = std::clamp((x / extent_ + 0.5) * resolution_, 0.0, double(resolution_));
  const double v = std::clamp((z / extent_ + 0.5) * resolution_, 0.0, double(resolution_));
  const auto column = std::min(static_cast<uint32_t>(u), resolution_ - 1);
  const auto row = std::min(static_cast<uint32_t>(v), resolution_ - 1);
  const float* h = heights_.data() + size_t{row} * (resolution_ + 1) + column;
  const double fu = u - column;
  const double fv = v - row;
  const double near = double{h[0]} + fu * (double{h[1]} - double{h[0]});
  h += resolution_ + 1;
  const double far = double{h[0]} + fu * (double{h[1]} - double{h[0]});
  return near + fv * (far - near);
}

Vec3 HeightField::normal(double x, double z) const {
  // Differences over two cells: the bilinear facets don't show.
  const double step = extent_ / resolution_;
  return normalize({height(x - step, z) - height(x + step, z), 2.0 * step,
                    height(x, z - step) - height(x, z + step)});
}

}  // namespace host
