// SPDX-License-Identifier: MIT
// The engine's shadow map of a light, by which opaque surfaces shade air, fog and bare ground.
#pragma once

#include <welkin/welkin.h>

#include <array>
#include <glm/glm.hpp>

#include "frame/uniforms.hpp"

namespace welkin {

// Where the layers of a map lie: (u, v, s, 1) = map * (position - origin, 1), u and v in [0, 1]
// over the layer, s in [0, 1] from the light on.
struct LightShadow {
  uint32_t light = 0;  // in the order the engine set them
  uint32_t cascades = 0;
  glm::dvec3 origin{0};
  std::array<glm::dmat4, WLK_MAX_SHADOW_CASCADES> map{};
  std::array<bool, WLK_MAX_SHADOW_CASCADES> reversed{};  // the map holds 1 - s
  double bias = 0;                                       // m along the light
};

// Checks everything and finds the direction of depth by that of the light. Throws INVALID_ARGUMENT.
LightShadow checkedLightShadow(const WlkLightShadow& shadow, const glm::dvec3& toLight);

// `nearest`: distance of the nearest volume that is drawn, m.
void fillLightShadow(const LightShadow& shadow, const glm::dvec3& eye, double nearest,
                     interface_::FrameUniforms& out);

}  // namespace welkin
