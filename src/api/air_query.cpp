// SPDX-License-Identifier: MIT
#include "api/air_query.hpp"

#include <algorithm>
#include <cmath>

#include "api/validate.hpp"

namespace welkin {

AirQuery airQueryOf(const AirState& state, uint32_t index) {
  AirQuery q{};
  q.air.planetRadius = state.planet.radius;
  q.air.airScaleHeight = 8000;
  q.air.fogScaleHeight = 100;
  if (state.sky) {
    for (int i = 0; i < 3; ++i) {
      q.air.airScattering[i] = state.sky->rayleighScattering[i];
    }
    q.air.airScaleHeight = state.sky->scaleHeight;
  }
  if (state.sky && state.absorber) {
    for (int i = 0; i < 3; ++i) {
      q.air.absorption[i] = state.absorber->absorption[i];
    }
    q.air.absorberPeak = state.absorber->peakAltitude;
    q.air.absorberWidth = state.absorber->halfWidth;
  }
  if (state.fog) {
    q.air.fogExtinction = state.fog->extinction;
    q.air.fogBaseAltitude = state.fog->baseAltitude;
    q.air.fogScaleHeight = state.fog->scaleHeight;
    for (int i = 0; i < 3; ++i) {
      q.air.fogAlbedo[i] = state.fog->singleScatteringAlbedo[i];
    }
    q.droplets = &state.fogPhase->particle;
  }
  if (index < state.lightCount) {
    const WlkLight& light = state.lights[index];
    q.light = true;
    q.toLight =
        glm::normalize(glm::dvec3(light.direction[0], light.direction[1], light.direction[2]));
    q.angularRadius = 0.5 * light.angularDiameter;
    for (int i = 0; i < 3; ++i) {
      q.irradiance[i] = light.irradiance[i];
    }
  }
  return q;
}

glm::dvec3 checkedPoint(const double position[3], const char* argument) {
  checkPointer(position, argument);
  for (int i = 0; i < 3; ++i) {
    if (!(std::abs(position[i]) <= 1e9)) {
      fail(WLK_ERROR_INVALID_ARGUMENT, 0, argument, "%s holds %g, expected [-1e9, 1e9]", argument,
           position[i]);
    }
  }
  return {position[0], position[1], position[2]};
}

glm::dvec3 checkedDirection(const double direction[3], const char* argument) {
  checkPointer(direction, argument);
  const glm::dvec3 v(direction[0], direction[1], direction[2]);
  const double length = glm::length(v);
  if (!(std::abs(length - 1) <= 1e-3)) {
    fail(WLK_ERROR_INVALID_ARGUMENT, 0, argument, "%s has the length %g, expected 1", argument,
         length);
  }
  return v / length;
}

glm::dvec3 lightIrradiance(const AirQuery& q, const PlanetFrame& at) {
  // As rays do: half way to the planet's centre all is opaque; at the centre nothing is defined.
  const double altitude = std::max(at.altitude, -0.5 * q.air.planetRadius);
  double depth[3];
  double visible = 0;
  evalLightDepth(q.air, altitude, glm::dot(q.toLight, at.up), q.angularRadius, depth, &visible);
  glm::dvec3 result(0);
  for (int i = 0; i < 3; ++i) {
    result[i] = q.irradiance[i] * std::exp(-depth[i]) * visible;
  }
  return result;
}

}  // namespace welkin
