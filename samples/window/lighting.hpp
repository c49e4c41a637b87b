// SPDX-License-Identifier: MIT
#pragma once

#include <glm/glm.hpp>

// Light on the engine's surfaces.
struct Lighting {
  glm::dvec3 toSun{0.0, 1.0, 0.0};
  glm::dvec3 sunIrradiance{0.0};  // on a surface that faces the sun
  glm::dvec3 skyIrradiance{0.0};  // on a level surface
};
