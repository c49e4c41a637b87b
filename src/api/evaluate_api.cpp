// SPDX-License-Identifier: MIT
// CPU queries, in double precision, by the model text that the GPU runs.
#include <algorithm>
#include <cmath>

#include "api/context.hpp"
#include "api/sky_query.hpp"
#include "api/validate.hpp"

namespace {

using namespace welkin;

WlkRay checkedRay(const WlkRayBatch& batch, uint32_t index) {
  WlkRay ray;
  std::memcpy(&ray, reinterpret_cast<const char*>(batch.rays) + size_t{index} * batch.stride,
              sizeof ray);
  double length = 0;
  for (int i = 0; i < 3; ++i) {
    checkRange(batch.sType, "origin", ray.origin[i], -1e9, 1e9);
    checkRange(batch.sType, "direction", ray.direction[i], -1.001, 1.001);
    length += ray.direction[i] * ray.direction[i];
  }
  checkRange(batch.sType, "direction", std::sqrt(length), 0.999, 1.001);
  if (!(ray.length > 0)) {
    fail(WLK_ERROR_INVALID_ARGUMENT, batch.sType, "length", "ray %u has the length %g", index,
         ray.length);
  }
  return ray;
}

// The planet counts as being in the way from so far below sea level on, so that points on it see
// each other. m.
constexpr double GRAZING = 1.0;

// Whether the planet lies between a point and one at least as high, `distance` m away.
bool planetBetween(const AirQuery& q, const PlanetFrame& low, double viewMu, double distance) {
  const double radius = q.air.planetRadius + low.altitude;
  const double nearest = -radius * viewMu;
  if (!(nearest > 0 && nearest < distance)) {
    return false;
  }
  const double sine = std::sqrt(std::max((1 - viewMu) * (1 + viewMu), 0.0));
  const double dip = radius * viewMu * viewMu / (1 + sine);
  return low.altitude - dip < std::min(low.altitude, 0.0) - GRAZING;
}

}  // namespace

WlkResult wlkEvalSky(WlkContext context, const WlkRayBatch* batch, double* radiance,
                     double* transmittance) {
  return guarded([&] {
    WlkContext_T& c = checkContext(context);
    const WlkRayBatch b = copyStruct(batch, WLK_STRUCT_RAY_BATCH);
    checkNoChain(batch);
    checkRange(b.sType, "maxOrder", b.maxOrder, ALL_ORDERS, FIRST_ORDER);
    if (b.count > 0) {
      checkPointer(b.rays, "rays");
    }
    if (b.stride < sizeof(WlkRay)) {
      fail(WLK_ERROR_INVALID_ARGUMENT, b.sType, "stride",
           "WlkRayBatch::stride is %u, expected at least %zu", b.stride, sizeof(WlkRay));
    }
    // All rays are checked before the first result is written.
    for (uint32_t i = 0; i < b.count; ++i) {
      checkedRay(b, i);
    }
    const AirQuery query = airQueryOf(c.air);
    std::array<AirQuery, MAX_LIGHTS> queries{query};
    for (uint32_t l = 1; l < c.air.lightCount; ++l) {
      queries[l] = airQueryOf(c.air, l);
    }
    const bool light = radiance != nullptr && b.count > 0;
    const SkyField* const field = light ? higherOrdersOf(c, query, b.maxOrder) : nullptr;
    for (uint32_t i = 0; i < b.count; ++i) {
      const WlkRay ray = checkedRay(b, i);
      const glm::dvec3 direction(ray.direction[0], ray.direction[1], ray.direction[2]);
      const PlanetFrame eye =
          planetFrameAt(c.air.planet, glm::dvec3(ray.origin[0], ray.origin[1], ray.origin[2]));
      SkyQueryResult result;
      glm::dvec3 sum(0);
      for (uint32_t l = 0; l < std::max(c.air.lightCount, 1U); ++l) {
        const AirQuery& q = queries[l];
        const SkyQueryRay way = skyQueryRay(q, eye, glm::normalize(direction), ray.length);
        result = evalSkyRay(q, c.air.planet, field, way, fogPhaseAt(q, way.y));
        sum += result.air;
      }
      for (int k = 0; k < 3; ++k) {
        const size_t at = size_t{3} * i + static_cast<size_t>(k);
        if (radiance != nullptr) {
          radiance[at] = sum[k];
        }
        if (transmittance != nullptr) {
          transmittance[at] = result.transmittance[k];
        }
      }
    }
    return WLK_SUCCESS;
  });
}

WlkResult wlkEvalLight(WlkContext context, uint32_t lightIndex, const double position[3],
                       double irradiance[3]) {
  return guarded([&] {
    WlkContext_T& c = checkContext(context);
    checkPointer(position, "position");
    checkPointer(irradiance, "irradiance");
    if (lightIndex >= c.air.lightCount) {
      fail(WLK_ERROR_INVALID_ARGUMENT, WLK_STRUCT_LIGHT, "lightIndex", "light %u is not set",
           lightIndex);
    }
    const glm::dvec3 point = checkedPoint(position, "position");
    const AirQuery query = airQueryOf(c.air, lightIndex);
    const glm::dvec3 result = lightIrradiance(query, planetFrameAt(c.air.planet, point));
    for (int i = 0; i < 3; ++i) {
      irradiance[i] = result[i];
    }
    return WLK_SUCCESS;
  });
}

WlkResult wlkEvalTransmittance(WlkContext context, const double from[3], const double to[3],
                               double transmittance[3]) {
  return guarded([&] {
    WlkContext_T& c = checkContext(context);
    const glm::dvec3 ends[2] = {checkedPoint(from, "from"), checkedPoint(to, "to")};
    checkPointer(transmittance, "transmittance");
    const AirQuery query = airQueryOf(c.air);
    const PlanetFrame frames[2] = {planetFrameAt(c.air.planet, ends[0]),
                                   planetFrameAt(c.air.planet, ends[1])};
    // From the lower to the higher one, whichever is which: the same both ways.
    const int low = frames[1].altitude < frames[0].altitude ? 1 : 0;
    const glm::dvec3 way = ends[1 - low] - ends[low];
    const double distance = glm::length(way);
    double depth[3] = {0, 0, 0};
    bool blocked = false;
    if (distance > 0) {
      const double viewMu = std::clamp(glm::dot(way, frames[low].up) / distance, -1.0, 1.0);
      blocked = planetBetween(query, frames[low], viewMu, distance);
      evalAirDepth(query.air, frames[low].altitude, viewMu, distance, depth);
    }
    for (int i = 0; i < 3; ++i) {
      transmittance[i] = blocked ? 0.0 : std::exp(-depth[i]);
    }
    return WLK_SUCCESS;
  });
}
