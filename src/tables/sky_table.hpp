// SPDX-License-Identifier: MIT
// How the moments of a SkyField lie in memory and are looked up. Unit of the moments.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "tables/sky_field.hpp"

namespace welkin {

// Colours are padded to four, which is what the compiler's vectors hold.
constexpr size_t LANES = 4;
constexpr size_t VALUES = SkyField::MOMENTS * LANES;
using Lanes = std::array<float, LANES>;

// Light from higher up is less than e^-10 of what the air below scatters.
constexpr double SKY_SCALE_HEIGHTS = 10;

// Altitudes and sun cosines <-> coordinates 0..1 of the table.
class SkyAxes {
 public:
  static constexpr double FOG_SHARE = 0.5;
  explicit SkyAxes(const AirInput& air)
      : top_(SKY_SCALE_HEIGHTS * air.airScaleHeight),
        fogHeight_(air.fogScaleHeight),
        fogShare_(air.fogExtinction > 0 ? FOG_SHARE : 0) {
    if (air.fogExtinction > 0) {
      top_ = std::max(top_, SKY_SCALE_HEIGHTS * fogHeight_);
    }
  }
  double top() const { return top_; }
  // Half of the nodes at equal steps of the fog's column, the others dense towards the ground.
  double coordinate(double altitude) const {
    const double h = std::clamp(altitude, 0.0, top_);
    const double fog = std::expm1(-h / fogHeight_) / std::expm1(-top_ / fogHeight_);
    return (1 - fogShare_) * std::sqrt(h / top_) + fogShare_ * fog;
  }
  double altitudeAt(double coordinate_) const {
    double low = 0;
    double high = top_;
    for (int i = 0; i < 80; ++i) {
      const double middle = 0.5 * (low + high);
      (coordinate(middle) < coordinate_ ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }
  // Dense about the horizontal, 1 degree apart in twilight.
  static constexpr double SUN_BEND = 0.25;
  static double sunCoordinate(double mu) {
    const double size = std::min(std::abs(mu), 1.0);
    return 0.5 + std::copysign(0.5 * (1 + SUN_BEND) * size / (SUN_BEND + size), mu);
  }
  static double sunAt(double coordinate_) {
    const double q = 2 * coordinate_ - 1;
    return SUN_BEND * q / (1 + SUN_BEND - std::abs(q));
  }

 private:
  double top_;
  double fogHeight_;
  double fogShare_;
};

struct SkyNode {
  size_t index;
  double share;  // of the next one
};

inline SkyNode nodeAt(double coordinate, size_t count) {
  const double x = coordinate * static_cast<double>(count - 1);
  const auto i = std::min(static_cast<size_t>(std::max(x, 0.0)), count - 2);
  return {i, std::clamp(x - static_cast<double>(i), 0.0, 1.0)};
}

// The moments at one altitude for every sun.
using SunRow = std::array<float, SkyField::SUNS * VALUES>;

// `count` values from `first` on, of the two altitudes.
inline void blendAltitudes(const std::vector<float>& table, const SkyNode& high, size_t first,
                           size_t count, float* row) {
  const float* a = table.data() + high.index * SkyField::SUNS * VALUES + first;
  const float* b = a + SkyField::SUNS * VALUES;
  const auto v = static_cast<float>(high.share);
  for (size_t i = 0; i < count; ++i) {
    row[i] = (1 - v) * a[i] + v * b[i];
  }
}

// A direction in the frame of the moments.
struct SkyDirection {
  float x, y, z;
};

// What of the moments scatters into a direction: all light, and the parts along it.
struct SkyLight {
  Lanes mean;
  Lanes along;   // of L (v w)
  Lanes square;  // of L (v w)^2
};

// Where broken lines do: between orders of scattering, whose sum they smooth.
inline SkyNode sunNode(float mu) {
  return nodeAt(SkyAxes::sunCoordinate(static_cast<double>(mu)), SkyField::SUNS);
}

// A sun among four nodes in a row: light of twilight falls e-fold from one to the next, and broken
// lines through it would show.
struct SunNodes {
  size_t first;
  std::array<float, 4> weights;
};

// Cubic through the nodes with the slopes of their neighbours (Catmull-Rom), parabolas at the ends.
inline SunNodes sunNodes(double mu) {
  const SkyNode node = nodeAt(SkyAxes::sunCoordinate(mu), SkyField::SUNS);
  const auto first = std::clamp(node.index, size_t{1}, SkyField::SUNS - 3) - 1;
  const auto t = static_cast<float>(node.share);
  const float u = 1 - t;
  SunNodes nodes{first, {}};
  if (node.index == first + 1) {
    nodes.weights = {-0.5F * t * u * u, u * (1 + t - 1.5F * t * t), t * (1 + u - 1.5F * u * u),
                     -0.5F * u * t * t};
  } else if (node.index < first + 1) {
    nodes.weights = {0.5F * u * (2 - t), t * (2 - t), -0.5F * t * u, 0};
  } else {
    nodes.weights = {0, -0.5F * t * u, u * (1 + t), 0.5F * t * (1 + t)};
  }
  return nodes;
}

inline SkyLight gatherMoments(const float* row, const SkyDirection& v, const SunNodes& sun) {
  float m[VALUES] = {};
  for (size_t n = 0; n < 4; ++n) {
    const float* a = row + (sun.first + n) * VALUES;
    for (size_t i = 0; i < VALUES; ++i) {
      m[i] += sun.weights[n] * a[i];
    }
  }
  const float xx = v.x * v.x;
  const float yy = v.y * v.y;
  const float zz = v.z * v.z;
  const float xy = 2 * v.x * v.y;
  SkyLight g;
  for (size_t c = 0; c < LANES; ++c) {
    g.mean[c] = m[c] + m[LANES + c] + m[2 * LANES + c];
    g.square[c] = xx * m[c] + yy * m[LANES + c] + zz * m[2 * LANES + c] + xy * m[3 * LANES + c];
    g.along[c] = v.x * m[4 * LANES + c] + v.y * m[5 * LANES + c];
  }
  return g;
}

// Two Legendre terms of the fog's phase function, without its peak.
struct FogTerms {
  Lanes first;   // 3 chi_1
  Lanes second;  // 5/2 chi_2
};

inline FogTerms fogTerms(const std::array<SkyColor, 2>& chi) {
  FogTerms terms{};
  for (size_t c = 0; c < 3; ++c) {
    terms.first[c] = static_cast<float>(3 * chi[0][c]);
    terms.second[c] = static_cast<float>(2.5 * chi[1][c]);
  }
  return terms;
}

constexpr auto RAYLEIGH = static_cast<float>(3 / (16 * std::numbers::pi));
constexpr auto ISOTROPIC = static_cast<float>(1 / (4 * std::numbers::pi));

inline Lanes irradianceIn(const std::vector<float>& rows, double sunMu) {
  const SunNodes sun = sunNodes(sunMu);
  Lanes result{};
  for (size_t n = 0; n < 4; ++n) {
    for (size_t c = 0; c < LANES; ++c) {
      result[c] += sun.weights[n] * rows[LANES * (sun.first + n) + c];
    }
  }
  return result;
}

}  // namespace welkin
