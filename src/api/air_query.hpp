// SPDX-License-Identifier: MIT
// Air, fog and light as the CPU's models take them. Lengths in m.
#pragma once

#include <glm/glm.hpp>

#include "frame/plan.hpp"
#include "frame/uniforms.hpp"
#include "model/evaluate.hpp"
#include "particles/medium.hpp"

namespace welkin {

// What queries need of the scene.
struct AirQuery {
  AirInput air;
  const Particle* droplets = nullptr;  // where there is fog
  glm::dvec3 toLight{0, 1, 0};
  double angularRadius = 0;
  bool light = false;
  double irradiance[3] = {0, 0, 0};
};

// With one of the lights, if there are so many.
AirQuery airQueryOf(const AirState& state, uint32_t light = 0);

// Fails, naming `argument`, unless all three are in [-1e9, 1e9].
glm::dvec3 checkedPoint(const double position[3], const char* argument);
// Fails unless the length is 1 within 1e-3; normalised.
glm::dvec3 checkedDirection(const double direction[3], const char* argument);

// Irradiance of the light on a surface facing it, RGB.
glm::dvec3 lightIrradiance(const AirQuery& query, const PlanetFrame& at);

}  // namespace welkin
