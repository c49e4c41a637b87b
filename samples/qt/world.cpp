// SPDX-License-Identifier: MIT
#include "world.hpp"

#include <cmath>

glm::dmat3 Eye::viewFromWorld() const {
  const glm::dvec3 forward{std::cos(yaw) * std::cos(pitch), std::sin(yaw) * std::cos(pitch),
                           std::sin(pitch)};
  const glm::dvec3 right{-std::sin(yaw), std::cos(yaw), 0.0};
  const glm::dvec3 up{-std::cos(yaw) * std::sin(pitch), -std::sin(yaw) * std::sin(pitch),
                      std::cos(pitch)};
  // The view's axes are the rows.
  return glm::transpose(glm::dmat3(right, up, forward));
}

glm::dmat4 Eye::clipFromView(VkExtent2D extent) const {
  const double scale = 1.0 / std::tan(0.5 * verticalFov);
  glm::dmat4 clip(0.0);
  clip[0][0] = scale * extent.height / extent.width;
  clip[1][1] = -scale;  // Vulkan's y points down
  clip[2][2] = -NEAR_m / (FAR_m - NEAR_m);
  clip[2][3] = 1.0;
  clip[3][2] = NEAR_m * FAR_m / (FAR_m - NEAR_m);
  return clip;
}

glm::dmat3 worldFromMesh() {
  glm::dmat3 m(0.0);
  m[2][0] = -1.0;  // x: ahead
  m[0][1] = 1.0;   // y: right
  m[1][2] = 1.0;   // z: up
  return m;
}
