// SPDX-License-Identifier: MIT
// Radiance of sky and ground from all directions at a point, as texels of an octahedral map: what
// wlkEvalSkyMap and the ambient light of volumes share.
#pragma once

#include "api/sky_query.hpp"

namespace welkin {

// u, v in [-1, 1]; Cigolle et al., A survey of efficient representations for independent unit
// vectors, JCGT 3 (2), 2014, with y for its z.
glm::dvec3 octahedralDirection(const glm::dvec2& uv);
// sr, of the texel around uv in a map with `size` of them along a side.
double octahedralSolidAngle(const glm::dvec2& uv, uint32_t size);

// The light that one of the scene's lights makes, with the further orders of `field` unless that is
// null.
class SkyMap {
 public:
  SkyMap(const AirState& air, const PlanetFrame& eye, uint32_t light, const SkyField* field);

  // Of the texel around uv.
  glm::dvec3 texel(const glm::dvec2& uv, double halfWidth) const;

 private:
  bool hitsGround(const glm::dvec3& direction) const;
  SkyColor meanFogPhase(const glm::dvec2& uv, double halfWidth) const;
  double distanceFromLight(const glm::dvec2& uv) const;
  glm::dvec3 radiance(const glm::dvec3& direction, const SkyColor& fogPhase) const;

  WlkPlanet planet_;
  AirQuery air_;
  const SkyField* field_;
  PlanetFrame eye_;
};

}  // namespace welkin
