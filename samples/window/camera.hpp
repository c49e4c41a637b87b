// SPDX-License-Identifier: MIT
// A camera to fly with: right-handed world, y up, metres; reversed depth without a far plane.
#pragma once

#include <glm/glm.hpp>

struct Camera {
  glm::dvec3 position{0.0, 60.0, 0.0};
  double yaw = 0.0;     // rad; 0 looks along -z, positive turns left
  double pitch = 0.08;  // rad; positive looks up

  // Rotation from the world into the view, which looks along -z.
  glm::dmat3 viewFromWorld() const;
  glm::dvec3 forward() const;
  glm::dvec3 right() const;
};

// Distance of depth value 1, m. Depth is NEAR_PLANE / view depth: 0 at infinity.
constexpr double NEAR_PLANE = 0.5;

// Vulkan clip space (y down, depth 0 to 1) for 60 degrees of vertical field of view.
glm::dmat4 projection(double aspect);
