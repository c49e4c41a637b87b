// SPDX-License-Identifier: MIT
#include "api/sky_query.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "particles/phase_curve.hpp"
#include "tables/angular_moments.hpp"

namespace welkin {
namespace {

PhaseCurve curveOf(const Particle& droplets) {
  return droplets.analytic
             ? makePhaseCurve([&](size_t, double y) { return evalPhase(droplets.phase, y); })
             : droplets.curve;
}

// The moments of the fog are taken from `known` where that was made for the same droplets.
SkyFieldInput fieldInputOf(const AirState& state, const AirQuery& query,
                           const SkyFieldEntry* known) {
  SkyFieldInput input;
  input.air = query.air;
  input.lightAngularRadius = query.angularRadius;
  for (size_t c = 0; c < 3; ++c) {
    input.groundAlbedo[c] = static_cast<double>(state.planet.groundAlbedo[c]);
  }
  if (query.air.fogExtinction > 0 && known != nullptr && known->fogPhase == state.fogPhase) {
    input.fogMoments = known->input.fogMoments;
  } else if (query.air.fogExtinction > 0) {
    const PhaseCurve curve = curveOf(*query.droplets);
    for (size_t c = 0; c < 3; ++c) {
      std::array<double, FOG_TERMS + 1> chi{};
      legendreMoments(curve.y, curve.value[c], chi);
      for (size_t l = 0; l < FOG_TERMS; ++l) {
        input.fogMoments[l][c] = chi[l + 1];
      }
    }
  }
  return input;
}

// Without the peak's share the phase function is what is left under the level that cuts it off.
SkyColor fogBoundOf(const Particle& droplets, double eyePeak) {
  const PhaseCurve curve = curveOf(droplets);
  SkyColor bound{};
  for (size_t c = 0; c < 3; ++c) {
    bound[c] = cutLevel(curve.y, curve.value[c], eyePeak) / (1 - eyePeak);
  }
  return bound;
}

// Irradiance of the light on horizontal ground at sea level, per unit of it.
glm::dvec3 litGround(const AirQuery& q, double sunMu) {
  double depth[3];
  double visible = 0;
  evalLightDepth(q.air, 0.0, sunMu, q.angularRadius, depth, &visible);
  glm::dvec3 lit(0);
  for (int c = 0; c < 3; ++c) {
    lit[c] = std::max(sunMu, 0.0) * visible * std::exp(-depth[c]);
  }
  return lit;
}

}  // namespace

SkyFieldInput skyFieldInputOf(WlkContext_T& c, const AirQuery& query) {
  return fieldInputOf(c.air, query, c.skyField.get());
}

void finishSkyField(SkyField& field, const Particle& droplets) {
  if (field.air().fogExtinction > 0) {
    field.boundFogPhase(fogBoundOf(droplets, field.eyePeak()));
  }
}

const SkyField& skyFieldOf(WlkContext_T& c, const AirQuery& query) {
  const SkyFieldInput input = skyFieldInputOf(c, query);
  const bool fog = query.air.fogExtinction > 0;
  if (!c.skyField || !(c.skyField->input == input)) {
    auto made = std::make_unique<SkyFieldEntry>(SkyFieldEntry{input, {}, solveSkyField(input)});
    if (fog) {
      finishSkyField(made->field, *query.droplets);
    }
    c.skyField = std::move(made);
  }
  c.skyField->fogPhase = fog ? c.air.fogPhase : nullptr;
  return c.skyField->field;
}

const SkyField* higherOrdersOf(WlkContext_T& c, const AirQuery& query, uint32_t maxOrder) {
  const double* const scattering = query.air.airScattering;
  const bool scatters = query.air.fogExtinction > 0 ||
                        std::any_of(scattering, scattering + 3, [](double x) { return x > 0; });
  return maxOrder == ALL_ORDERS && query.light && scatters ? &skyFieldOf(c, query) : nullptr;
}

SkyQueryRay skyQueryRay(const AirQuery& query, const PlanetFrame& eye, const glm::dvec3& direction,
                        double length) {
  SkyQueryRay ray{};
  // Half way to the planet's centre all is opaque; at the centre nothing is defined.
  ray.altitude = std::max(eye.altitude, -0.5 * query.air.planetRadius);
  ray.viewMu = glm::dot(direction, eye.up);
  ray.sunMu = glm::dot(query.toLight, eye.up);
  const glm::dvec3 apart = direction - query.toLight;
  ray.y = 0.5 * glm::dot(apart, apart);
  const double ground = evalGroundDistance(eye.altitude, ray.viewMu, query.air.planetRadius);
  ray.toGround = ground >= 0 && ground <= length;
  ray.distance = ray.toGround ? ground : length;
  return ray;
}

SkyColor fogPhaseAt(const AirQuery& query, double y) {
  SkyColor phase{};
  for (size_t c = 0; c < 3 && query.air.fogExtinction > 0; ++c) {
    phase[c] = query.droplets->analytic ? evalPhase(query.droplets->phase, y)
                                        : evalPhaseCurve(query.droplets->curve, c, y);
  }
  return phase;
}

SkyQueryResult evalSkyRay(const AirQuery& q, const WlkPlanet& planet, const SkyField* field,
                          const SkyQueryRay& ray, const SkyColor& phase) {
  const double viewSun = 1 - ray.y;
  double scattered[3];
  double depth[3];
  evalAirRay(q.air, ray.altitude, ray.viewMu, ray.sunMu, viewSun, ray.distance, phase.data(),
             q.angularRadius, scattered, depth);
  SkyQueryResult result;
  for (int c = 0; c < 3; ++c) {
    result.transmittance[c] = std::exp(-depth[c]);
  }
  if (!q.light) {
    return result;
  }
  SkyField::Parts more;
  if (field != nullptr) {
    more = field->higherOrders(ray.altitude, ray.viewMu, ray.sunMu, viewSun, ray.distance, phase);
  }
  glm::dvec3 lit(0);
  if (ray.toGround) {
    const double radius = q.air.planetRadius;
    const double mu =
        ((radius + std::max(ray.altitude, 0.0)) * ray.sunMu + ray.distance * viewSun) / radius;
    lit = litGround(q, std::clamp(mu, -1.0, 1.0));
  }
  for (int c = 0; c < 3; ++c) {
    const auto k = static_cast<size_t>(c);
    const double albedo = static_cast<double>(planet.groundAlbedo[c]);
    result.air[c] = q.irradiance[c] * (scattered[c] + more.air[k]);
    result.ground[c] = q.irradiance[c] * (more.ground[k] + albedo / std::numbers::pi * lit[c] *
                                                               result.transmittance[c]);
  }
  return result;
}

}  // namespace welkin
