// SPDX-License-Identifier: MIT
// wlkEvalSkyMap: radiance from all directions in an octahedral map.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "api/context.hpp"
#include "api/sky_query.hpp"
#include "api/validate.hpp"

namespace {

using namespace welkin;

// u, v in [-1, 1]; Cigolle et al., A survey of efficient representations for independent unit
// vectors, JCGT 3 (2), 2014, with y for its z.
glm::dvec3 directionOf(const glm::dvec2& uv) {
  const glm::dvec2 size = glm::abs(uv);
  glm::dvec3 p(uv.x, 1 - size.x - size.y, uv.y);
  if (p.y < 0) {
    p.x = std::copysign(1 - size.y, uv.x);
    p.z = std::copysign(1 - size.x, uv.y);
  }
  return glm::normalize(p);
}

// 1 - cos of 15 degrees, and the largest step there as a part of half the map's side: 0.2 degrees.
constexpr double AUREOLE = 0.034;
constexpr double FINEST = 0.002;

class SkyMap {
 public:
  // Of one of the lights.
  SkyMap(WlkContext_T& c, const WlkSkyMapQuery& query, uint32_t light)
      : planet_(c.air.planet),
        air_(airQueryOf(c.air, light)),
        field_(higherOrdersOf(c, airQueryOf(c.air), query.maxOrder)),
        eye_(planetFrameAt(planet_, checkedPoint(query.position, "position"))) {
    eye_.altitude = std::max(eye_.altitude, 0.0);
  }

  glm::dvec3 texel(const glm::dvec2& uv, double halfWidth) const {
    int ground = 0;
    for (const glm::dvec2& corner : CORNERS) {
      ground += hitsGround(directionOf(uv + halfWidth * corner)) ? 1 : 0;
    }
    const SkyColor phase = meanFogPhase(uv, halfWidth);
    if (ground == 0 || ground == 4) {
      return radiance(directionOf(uv), phase);
    }
    glm::dvec3 sum(0);
    for (const glm::dvec2& point : POINTS) {
      sum += radiance(directionOf(uv + halfWidth * point), phase);
    }
    return sum / 4.0;
  }

 private:
  // Four points that no edge along the map's axes or diagonals hits two of.
  static constexpr glm::dvec2 POINTS[4] = {
      {-0.75, -0.25}, {0.25, -0.75}, {0.75, 0.25}, {-0.25, 0.75}};
  // A little inside, so that no corner leaves the map.
  static constexpr glm::dvec2 CORNERS[4] = {
      {-0.999, -0.999}, {0.999, -0.999}, {0.999, 0.999}, {-0.999, 0.999}};

  bool hitsGround(const glm::dvec3& direction) const {
    return evalGroundDistance(eye_.altitude, glm::dot(direction, eye_.up), air_.air.planetRadius) >=
           0;
  }

  // Of the texel, where it is near the light: droplets scatter half of the light into a few
  // degrees.
  SkyColor meanFogPhase(const glm::dvec2& uv, double halfWidth) const {
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
  double distanceFromLight(const glm::dvec2& uv) const {
    const glm::dvec3 apart = directionOf(uv) - air_.toLight;
    return 0.5 * glm::dot(apart, apart);
  }

  glm::dvec3 radiance(const glm::dvec3& direction, const SkyColor& fogPhase) const {
    const SkyQueryRay ray =
        skyQueryRay(air_, eye_, direction, std::numeric_limits<double>::infinity());
    const SkyQueryResult result = evalSkyRay(air_, planet_, field_, ray, fogPhase);
    return result.air + result.ground;
  }

  WlkPlanet planet_;
  AirQuery air_;
  const SkyField* field_;
  PlanetFrame eye_;
};

}  // namespace

WlkResult wlkEvalSkyMap(WlkContext context, const WlkSkyMapQuery* query, float* rgb) {
  return guarded([&] {
    WlkContext_T& c = checkContext(context);
    const WlkSkyMapQuery q = copyStruct(query, WLK_STRUCT_SKY_MAP_QUERY);
    checkNoChain(query);
    for (const double x : q.position) {
      checkRange(q.sType, "position", x, -1e9, 1e9);
    }
    checkRange(q.sType, "size", q.size, 4, 1024);
    checkRange(q.sType, "maxOrder", q.maxOrder, ALL_ORDERS, FIRST_ORDER);
    checkPointer(rgb, "rgb");
    std::array<std::optional<SkyMap>, MAX_LIGHTS> maps;
    for (uint32_t l = 0; l < std::max(c.air.lightCount, 1U); ++l) {
      maps[l].emplace(c, q, l);
    }
    const double halfWidth = 1.0 / q.size;
    for (uint32_t j = 0; j < q.size; ++j) {
      for (uint32_t i = 0; i < q.size; ++i) {
        const glm::dvec2 uv((2.0 * i + 1) * halfWidth - 1, (2.0 * j + 1) * halfWidth - 1);
        glm::dvec3 light(0);
        for (const std::optional<SkyMap>& map : maps) {
          light += map ? map->texel(uv, halfWidth) : glm::dvec3(0);
        }
        for (int k = 0; k < 3; ++k) {
          *rgb++ = static_cast<float>(
              std::min(light[k], static_cast<double>(std::numeric_limits<float>::max())));
        }
      }
    }
    return WLK_SUCCESS;
  });
}
