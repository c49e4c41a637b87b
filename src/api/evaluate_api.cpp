// SPDX-License-Identifier: MIT
// CPU queries, in double precision, by the model text that the GPU runs.
#include <cmath>
#include <limits>

#include "api/air_query.hpp"
#include "api/context.hpp"
#include "api/validate.hpp"
#include "model/evaluate.hpp"
#include "particles/medium.hpp"

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

void evaluateRay(const AirQuery& q, const WlkPlanet& planet, const WlkRay& ray, double* radiance,
                 double* transmittance) {
  const glm::dvec3 origin(ray.origin[0], ray.origin[1], ray.origin[2]);
  const glm::dvec3 direction =
      glm::normalize(glm::dvec3(ray.direction[0], ray.direction[1], ray.direction[2]));
  const PlanetFrame frame = planetFrameAt(planet, origin);
  const double viewMu = glm::dot(direction, frame.up);
  const double ground = evalGroundDistance(frame.altitude, viewMu, planet.radius);
  const double distance = ground >= 0 ? std::min(ground, ray.length) : ray.length;
  const glm::dvec3 apart = direction - q.toLight;
  const double y = 0.5 * glm::dot(apart, apart);
  double phase[3] = {0, 0, 0};
  for (size_t i = 0; i < 3 && q.air.fogExtinction > 0; ++i) {
    phase[i] = q.droplets->analytic ? evalPhase(q.droplets->phase, y)
                                    : evalPhaseCurve(q.droplets->curve, i, y);
  }
  double scattered[3];
  double depth[3];
  evalAirRay(q.air, frame.altitude, viewMu, glm::dot(q.toLight, frame.up), 1.0 - y, distance, phase,
             q.angularRadius, scattered, depth);
  for (int i = 0; i < 3; ++i) {
    if (radiance != nullptr) {
      radiance[i] = q.light ? scattered[i] * q.irradiance[i] : 0.0;
    }
    if (transmittance != nullptr) {
      transmittance[i] = std::exp(-depth[i]);
    }
  }
}

}  // namespace

WlkResult wlkEvalSky(WlkContext context, const WlkRayBatch* batch, double* radiance,
                     double* transmittance) {
  return guarded([&] {
    WlkContext_T& c = checkContext(context);
    const WlkRayBatch b = copyStruct(batch, WLK_STRUCT_RAY_BATCH);
    checkNoChain(batch);
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
    for (uint32_t i = 0; i < b.count; ++i) {
      evaluateRay(query, c.air.planet, checkedRay(b, i),
                  radiance == nullptr ? nullptr : radiance + size_t{3} * i,
                  transmittance == nullptr ? nullptr : transmittance + size_t{3} * i);
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
    if (lightIndex > 0 || !c.air.light) {
      fail(WLK_ERROR_INVALID_ARGUMENT, WLK_STRUCT_LIGHT, "lightIndex", "light %u is not set",
           lightIndex);
    }
    for (int i = 0; i < 3; ++i) {
      if (!(std::abs(position[i]) <= 1e9)) {
        fail(WLK_ERROR_INVALID_ARGUMENT, 0, "position", "position holds %g", position[i]);
      }
    }
    const AirQuery q = airQueryOf(c.air);
    const PlanetFrame frame =
        planetFrameAt(c.air.planet, glm::dvec3(position[0], position[1], position[2]));
    // As rays do: half way to the planet's centre all is opaque; at the centre nothing is defined.
    const double altitude = std::max(frame.altitude, -0.5 * q.air.planetRadius);
    double depth[3];
    double visible = 0;
    evalLightDepth(q.air, altitude, glm::dot(q.toLight, frame.up), q.angularRadius, depth,
                   &visible);
    for (int i = 0; i < 3; ++i) {
      irradiance[i] = q.irradiance[i] * std::exp(-depth[i]) * visible;
    }
    return WLK_SUCCESS;
  });
}
