// SPDX-License-Identifier: MIT
// This engine's conventions: metres, z up, left-handed, x forward, y right; views look along +z
// with y up; reversed depth with a far plane, in a depth buffer of 24 bits.
#pragma once

#include <vulkan/vulkan_core.h>

#include <glm/glm.hpp>

constexpr double NEAR_m = 1.0;
constexpr double FAR_m = 60000.0;

struct Eye {
  glm::dvec3 position{0.0, 0.0, 60.0};
  double yaw = 0.0;    // rad; positive turns right
  double pitch = 0.1;  // rad; positive looks up
  double verticalFov = 1.0;

  glm::dmat3 viewFromWorld() const;
  // Vulkan clip space of a picture of these proportions.
  glm::dmat4 clipFromView(VkExtent2D extent) const;
};

// The shared meshes are right-handed with y up and -z ahead.
glm::dmat3 worldFromMesh();
