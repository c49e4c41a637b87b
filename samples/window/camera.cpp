// SPDX-License-Identifier: MIT
#include "camera.hpp"

#include <cmath>
#include <numbers>

glm::dvec3 Camera::forward() const {
  return {-std::sin(yaw) * std::cos(pitch), std::sin(pitch), -std::cos(yaw) * std::cos(pitch)};
}

glm::dvec3 Camera::right() const {
  return {std::cos(yaw), 0.0, -std::sin(yaw)};
}

glm::dmat3 Camera::viewFromWorld() const {
  const glm::dvec3 back = -forward();
  const glm::dvec3 up = glm::cross(back, right());
  // The view's axes are the rows.
  return glm::transpose(glm::dmat3(right(), up, back));
}

glm::dmat4 projection(double aspect) {
  const double scale = 1.0 / std::tan(std::numbers::pi / 6.0);
  glm::dmat4 clip(0.0);
  clip[0][0] = scale / aspect;
  clip[1][1] = -scale;
  clip[2][3] = -1.0;
  clip[3][2] = NEAR_PLANE;
  return clip;
}
