// SPDX-License-Identifier: MIT
// Air, fog and light as the CPU's models take them. Lengths in m.
#pragma once

#include <glm/glm.hpp>

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

AirQuery airQueryOf(const AirState& state);

}  // namespace welkin
