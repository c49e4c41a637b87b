// SPDX-License-Identifier: MIT
// Where a map of the volumes' shadow lies in the world, and each volume in it. Pure data, in m.
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "frame/uniforms.hpp"
#include "welkin/welkin_vulkan.h"

namespace welkin {

// The light's frame: texel (0, 0) has its outer corner at u = v = 0, d grows along the light.
struct ShadowLayout {
  glm::dvec3 acrossU;  // of length 1, like the others
  glm::dvec3 acrossV;
  glm::dvec3 along;
  glm::dvec3 corner;  // u = v = d = 0, in the world
  double width = 1;
  double height = 1;
};

// `up` is the planet's. The axes turn as little as possible with the light: straight from below is
// the only direction around which they jump.
ShadowLayout layoutShadowMap(const WlkCloudShadowInfo& info, const glm::dvec3& toLight,
                             const glm::dvec3& up);

// Row-major 3x4 to (u, v, d).
std::array<double, 12> mapFromWorld(const ShadowLayout& layout);

// Constants of a volume's pass; its `rect` is empty where the volume does not reach the map.
// `scattered`: scattered light goes on.
interface_::ShadowVolume shadowVolume(const ShadowLayout& layout, const WlkCloudShadowInfo& info,
                                      const VolumeState& volume, bool scattered);

}  // namespace welkin
