// SPDX-License-Identifier: MIT
// A scene of air, haze and a sun on a CPU context for the tests of queries, asked in arrays.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "welkin/welkin.hpp"

namespace welkin::test {

using Rgb = std::array<double, 3>;
using Point = std::array<double, 3>;

constexpr double PI = 3.14159265358979323846;
constexpr double INF = std::numeric_limits<double>::infinity();
constexpr double ALBEDO = 0.25;

inline Point towards(double elevation_deg, double azimuth_deg) {
  const double e = elevation_deg * PI / 180;
  const double a = azimuth_deg * PI / 180;
  return {std::cos(e) * std::cos(a), std::sin(e), std::cos(e) * std::sin(a)};
}

struct SkyScene {
  SkyScene() : context(make<WlkContextInfo>()) {
    for (float& one : planet.groundAlbedo) {
      one = static_cast<float>(ALBEDO);
    }
    check(wlkSetPlanet(context, &planet));
  }
  void setSky() const { check(wlkSetSky(context, &sky)); }
  void setSun(const Point& direction) const {
    auto light = make<WlkLight>();
    for (size_t i = 0; i < 3; ++i) {
      light.direction[i] = static_cast<float>(direction[i]);
    }
    check(wlkSetLights(context, 1, sizeof light, &light));
  }
  void setHaze() const {
    auto fog = make<WlkFog>();
    fog.dropletDiameter_um = 1;
    fog.extinction = 1e-5F;
    fog.scaleHeight = 1200;
    check(wlkSetFog(context, &fog));
  }
  Rgb radiance(const Point& origin, const Point& direction, double length,
               uint32_t maxOrder = 0) const {
    WlkRay ray{};
    std::copy(origin.begin(), origin.end(), ray.origin);
    std::copy(direction.begin(), direction.end(), ray.direction);
    ray.length = length;
    auto batch = make<WlkRayBatch>();
    batch.count = 1;
    batch.rays = &ray;
    batch.maxOrder = maxOrder;
    Rgb result{};
    check(wlkEvalSky(context, &batch, result.data(), nullptr));
    return result;
  }
  Rgb transmittance(const Point& from, const Point& to) const {
    Rgb result{};
    check(wlkEvalTransmittance(context, from.data(), to.data(), result.data()));
    return result;
  }
  Rgb direct(const Point& position, const Point& normal) const {
    Rgb result{};
    check(wlkEvalIrradiance(context, position.data(), normal.data(), result.data(), nullptr));
    return result;
  }
  Rgb diffuse(const Point& position, const Point& normal) const {
    Rgb result{};
    check(wlkEvalIrradiance(context, position.data(), normal.data(), nullptr, result.data()));
    return result;
  }
  std::vector<float> map(double altitude, uint32_t size, uint32_t maxOrder = 0) const {
    auto query = make<WlkSkyMapQuery>();
    query.position[1] = altitude;
    query.size = size;
    query.maxOrder = maxOrder;
    std::vector<float> rgb(size_t{3} * size * size);
    check(wlkEvalSkyMap(context, &query, rgb.data(), rgb.size() * sizeof(float)));
    return rgb;
  }

  WlkPlanet planet = make<WlkPlanet>();
  WlkSky sky = make<WlkSky>();
  welkin::Context context;
};

}  // namespace welkin::test
