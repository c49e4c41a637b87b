// SPDX-License-Identifier: MIT
#include "api/sky_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace welkin {
namespace {

// 1 - cos of 15 degrees, and the largest step there as a part of half the map's side: 0.2 degrees.
constexpr double AUREOLE = 0.034;
constexpr double FINEST = 0.002;

// Four points that no edge along the map's axes or diagonals hits two of.
constexpr glm::dvec2 POINTS[4] = {{-0.75, -0.25}, {0.25, -0.75}, {0.75, 0.25}, {-0.25, 0.75}};
// A little inside, so that no corner leaves the map.
constexpr glm::dvec2 CORNERS[4] = {
    {-0.999, -0.999}, {0.999, -0.999}, {0.999, 0.999}, {-0.999, 0.999}};

// On the octahedron.
glm::dvec3 pointOf(const glm::dvec2& uv) {
  const glm::dvec2 size = glm::abs(uv);
  glm::dvec3 p(uv.x, 1 - size.x - size.y, uv.y);
  if (p.y < 0) {
    p.x = std::copysign(1 - size.y, uv.x);
    p.z = std::copysign(1 - size.x, uv.y);
  }
  return p;
}

}  // namespace

glm::dvec3 octahedralDirection(const glm::dvec2& uv) {
  return glm::normalize(pointOf(uv));
}

double octahedralSolidAngle(const glm::dvec2& uv, uint32_t size) {
  const double length = glm::length(pointOf(uv));
  return 4.0 / (static_cast<double>(size) * size * length * length * length);
}

SkyMap::SkyMap(const AirState& air, const PlanetFrame& eye, uint32_t light, const SkyField* field)
    : planet_(air.planet), air_(airQueryOf(air, light)), field_(field), eye_(eye) {
  eye_.altitude = std::max(eye_.altitude, 0.0);
}

glm::dvec3 SkyMap::texel(const glm::dvec2& uv, double halfWidth) const {
  int ground = 0;
  for (const glm::dvec2& corner : CORNERS) {
    ground += hitsGround(octahedralDirection(uv + halfWidth * corner)) ? 1 : 0;
  }
  const SkyColor phase = meanFogPhase(uv, halfWidth);
  if (ground == 0 || ground == 4) {
    return radiance(octahedralDirection(uv), phase);
  }
  glm::dvec3 sum(0);
  for (const glm::dvec2& point : POINTS) {
    sum += radiance(octahedralDirection(uv + halfWidth * point), phase);
  }
  return sum / 4.0;
}

bool SkyMap::hitsGround(const glm::dvec3& direction) const {
  return evalGroundDistance(eye_.altitude, glm::dot(direction, eye_.up), air_.air.planetRadius) >=
         0;
}

// Of the texel, where it is near the light: droplets scatter half of the light into a few degrees.
SkyColor SkyMap::meanFogPhase(const glm::dvec2& uv, double halfWidth) const {
  if (!(distanceFromLight(uv) < AUREOLE)) {
    return fogPhaseAt(air_, distanceFromLight(uv));
  }
  const int count = std::clamp(static_cast<int>(2 * halfWidth / FINEST), 1, 64);
  SkyColor sum{};
  for (int j = 0; j < count; ++j) {
    for (int i = 0; i < count; ++i) {
      const glm::dvec2 inside = (2.0 * glm::dvec2(i, j) + 1.0) / static_cast<double>(count) - 1.0;
      const SkyColor one = fogPhaseAt(air_, distanceFromLight(uv + halfWidth * inside));
      for (size_t c = 0; c < 3; ++c) {
        sum[c] += one[c] / (count * count);
      }
    }
  }
  return sum;
}

// 1 - cos of the angle.
double SkyMap::distanceFromLight(const glm::dvec2& uv) const {
  const glm::dvec3 apart = octahedralDirection(uv) - air_.toLight;
  return 0.5 * glm::dot(apart, apart);
}

glm::dvec3 SkyMap::radiance(const glm::dvec3& direction, const SkyColor& fogPhase) const {
  const SkyQueryRay ray =
      skyQueryRay(air_, eye_, direction, std::numeric_limits<double>::infinity());
  const SkyQueryResult result = evalSkyRay(air_, planet_, field_, ray, fogPhase);
  return result.air + result.ground;
}

}  // namespace welkin
