// SPDX-License-Identifier: MIT
// Radiance of sky and ground along one ray, all orders of scattering: what wlkEvalSky and
// wlkEvalSkyMap share. Lengths in m.
#pragma once

#include "api/air_query.hpp"
#include "api/context.hpp"

namespace welkin {

// WlkRayBatch::maxOrder and WlkSkyMapQuery::maxOrder.
constexpr uint32_t ALL_ORDERS = 0;
constexpr uint32_t FIRST_ORDER = 1;

// Light of all orders in the context's scene; solved anew if that has changed.
const SkyField& skyFieldOf(WlkContext_T& context, const AirQuery& query);

// What skyFieldOf solves for.
SkyFieldInput skyFieldInputOf(WlkContext_T& context, const AirQuery& query);

// Gives a new field what it does not know of the droplets.
void finishSkyField(SkyField& field, const Particle& droplets);

// Null if only the first order counts or if there is no light, and else skyFieldOf.
const SkyField* higherOrdersOf(WlkContext_T& context, const AirQuery& query, uint32_t maxOrder);

// A ray as the model takes it; it ends at the ground in any case.
struct SkyQueryRay {
  double altitude;
  double viewMu;
  double sunMu;
  double y;  // 1 - cos of the angle with the light, exact where that is small
  double distance;
  bool toGround;
};

SkyQueryRay skyQueryRay(const AirQuery& query, const PlanetFrame& eye, const glm::dvec3& direction,
                        double length);

// RGB. The radiances have the unit of the light's irradiance per sr.
struct SkyQueryResult {
  glm::dvec3 air{0};     // what air and fog send along the ray
  glm::dvec3 ground{0};  // what the ground at its end sends through them
  glm::dvec3 transmittance{1};
};

// With the further orders of `field` unless that is null.
SkyQueryResult evalSkyRay(const AirQuery& query, const WlkPlanet& planet, const SkyField* field,
                          const SkyQueryRay& ray, const SkyColor& fogPhase);

// The fog's phase function, 1/sr, at 1 - cos of the scattering angle; 0 without fog.
SkyColor fogPhaseAt(const AirQuery& query, double y);

}  // namespace welkin
