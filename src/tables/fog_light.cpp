// SPDX-License-Identifier: MIT
#include "tables/fog_light.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tables/sky_table.hpp"

namespace welkin {
namespace {

constexpr double PI = std::numbers::pi;

double nodeOf(size_t i, size_t count) {
  return static_cast<double>(i) / static_cast<double>(count - 1);
}

}  // namespace

// 1 degree apart at the horizon, 6 at the zenith.
double FogLight::sunAt(size_t s) {
  const double x = nodeOf(s, SUNS);
  return std::sin(0.5 * PI * x * std::sqrt(x));
}

double FogLight::viewAt(size_t v) {
  return std::cos(PI * nodeOf(v, VIEWS));
}

double FogLight::azimuthAt(size_t a) {
  return PI * nodeOf(a, AZIMUTHS) * nodeOf(a, AZIMUTHS);
}

double FogLight::heightCoordinate(double altitude) const {
  const double above = depth_ * std::exp(-std::clamp(altitude / scaleHeight_, 0.0, 30.0));
  return depth_ > 0 ? std::log1p(above) / std::log1p(depth_) : 0;
}

double FogLight::sunCoordinate(double mu) {
  const double x = std::cbrt(2 / PI * std::asin(std::clamp(mu, 0.0, 1.0)));
  return x * x;
}

double FogLight::viewCoordinate(double mu) {
  return std::acos(std::clamp(mu, -1.0, 1.0)) / PI;
}

double FogLight::azimuthCoordinate(double cosine) {
  return std::sqrt(viewCoordinate(cosine));
}

double FogLight::lobe(double viewSun) const {
  constexpr double PEAKED = 0.75;
  const double g = asymmetry_;
  const double apart = (1 - g) * (1 - g) + 2 * g * (1 - std::clamp(viewSun, -1.0, 1.0));
  return (1 - PEAKED) + PEAKED * (1 - g * g) / (apart * std::sqrt(apart));
}

std::array<double, 3> FogLight::sourceAt(double altitude, double sunMu,
                                         const Direction& view) const {
  const std::array<SkyNode, 4> nodes = {nodeAt(sunCoordinate(sunMu), SUNS),
                                        nodeAt(heightCoordinate(altitude), HEIGHTS),
                                        nodeAt(azimuthCoordinate(view.azimuth), AZIMUTHS),
                                        nodeAt(viewCoordinate(view.viewMu), VIEWS)};
  constexpr std::array<size_t, 4> COUNTS = {SUNS, HEIGHTS, AZIMUTHS, VIEWS};
  std::array<double, 3> sum{};
  if (table_.empty()) {
    return sum;
  }
  for (size_t corner = 0; corner < 16; ++corner) {
    double weight = lobe(view.viewSun);
    size_t at = 0;
    for (size_t n = 0; n < 4; ++n) {
      const size_t next = corner >> n & 1;
      weight *= next == 1 ? nodes[n].share : 1 - nodes[n].share;
      at = at * COUNTS[n] + nodes[n].index + next;
    }
    for (size_t c = 0; c < 3; ++c) {
      sum[c] += weight * static_cast<double>(table_[LANES * at + c]);
    }
  }
  return sum;
}

}  // namespace welkin
