// SPDX-License-Identifier: MIT
#include "api/air_query.hpp"

namespace welkin {

AirQuery airQueryOf(const AirState& state) {
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
  if (state.fog) {
    q.air.fogExtinction = state.fog->extinction;
    q.air.fogBaseAltitude = state.fog->baseAltitude;
    q.air.fogScaleHeight = state.fog->scaleHeight;
    for (int i = 0; i < 3; ++i) {
      q.air.fogAlbedo[i] = state.fog->singleScatteringAlbedo[i];
    }
    q.droplets = &state.fogPhase->particle;
  }
  if (state.light) {
    const WlkLight& light = *state.light;
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

}  // namespace welkin
