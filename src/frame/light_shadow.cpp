// SPDX-License-Identifier: MIT
#include "frame/light_shadow.hpp"

#include <cmath>

#include "failure.hpp"

namespace welkin {
namespace {

[[noreturn]] void failMatrix(uint32_t cascade, const char* what) {
  fail(WLK_ERROR_INVALID_ARGUMENT, WLK_STRUCT_LIGHT_SHADOW, "clipFromWorld",
       "WlkLightShadow::clipFromWorld[%u] %s", cascade, what);
}

// From clip space to u, v and depth.
glm::dmat4 unitFromWorld(const float (&matrix)[16], uint32_t cascade) {
  glm::dmat4 clip;
  for (int i = 0; i < 16; ++i) {
    const double x = matrix[i];
    if (!(std::abs(x) <= 1e9)) {
      failMatrix(cascade, "has elements outside [-1e9, 1e9]");
    }
    clip[i / 4][i % 4] = x;
  }
  if (clip[0].w != 0 || clip[1].w != 0 || clip[2].w != 0 || !(clip[3].w > 0)) {
    failMatrix(cascade, "is not an orthographic projection");
  }
  clip /= clip[3].w;
  glm::dmat4 halves(1.0);
  halves[0].x = halves[1].y = halves[3].x = halves[3].y = 0.5;
  return halves * clip;
}

glm::dvec3 rowOf(const glm::dmat4& m, int row) {
  return {m[0][row], m[1][row], m[2][row]};
}

// Makes the third row count from the light on. Lines of equal u and v are what the map sees along;
// how depth changes on them against the light's direction tells whether it is reversed.
bool turnDepth(glm::dmat4& map, const glm::dvec3& toLight, uint32_t cascade) {
  const glm::dvec3 u = rowOf(map, 0);
  const glm::dvec3 v = rowOf(map, 1);
  const glm::dvec3 s = rowOf(map, 2);
  const glm::dvec3 sight = glm::cross(u, v);
  const double area = glm::length(sight);
  const double scale = glm::length(u) * glm::length(v);
  // Maps of 2e7 m and of 2 mm lie beyond what floats hold of positions in them.
  constexpr double SMALLEST = 1e-7;
  constexpr double LARGEST = 1e3;
  const double slope = glm::dot(s, sight) / area;
  for (const double per : {glm::length(u), glm::length(v), std::abs(slope)}) {
    if (!(per >= SMALLEST && per <= LARGEST)) {
      failMatrix(cascade, "is singular, or its map's edges are not in [1e-3, 1e7] m");
    }
  }
  if (!(area > 1e-3 * scale)) {
    failMatrix(cascade, "is singular");
  }
  const double along = glm::dot(sight, -toLight) / area;
  constexpr double LEAST_COSINE = 0.8660254037844386;  // 30 degrees
  if (!(std::abs(along) >= LEAST_COSINE)) {
    failMatrix(cascade, "does not look within 30 degrees of the light's direction");
  }
  const bool reversed = slope * along < 0;
  if (reversed) {
    for (int i = 0; i < 4; ++i) {
      map[i][2] = (i == 3 ? 1.0 : 0.0) - map[i][2];
    }
  }
  return reversed;
}

}  // namespace

LightShadow checkedLightShadow(const WlkLightShadow& shadow, const glm::dvec3& toLight) {
  LightShadow result;
  result.light = shadow.light;
  result.cascades = shadow.cascadeCount;
  result.origin = {shadow.origin[0], shadow.origin[1], shadow.origin[2]};
  result.bias = shadow.bias;
  for (uint32_t i = 0; i < shadow.cascadeCount; ++i) {
    result.map[i] = unitFromWorld(shadow.clipFromWorld[i], i);
    result.reversed[i] = turnDepth(result.map[i], toLight, i);
  }
  return result;
}

void fillLightShadow(const LightShadow& shadow, const glm::dvec3& eye, double nearest,
                     interface_::FrameUniforms& out) {
  const glm::dvec4 at(eye - shadow.origin, 1.0);
  out.shadowRange.y = static_cast<float>(shadow.cascades);
  out.shadowRange.z = static_cast<float>(nearest);
  for (uint32_t i = 0; i < shadow.cascades; ++i) {
    const glm::dmat4& map = shadow.map[i];
    for (int row = 0; row < 3; ++row) {
      out.cascade[3 * i + static_cast<uint32_t>(row)] = glm::vec4(
          glm::vec3(rowOf(map, row)), static_cast<float>(map[0][row] * at.x + map[1][row] * at.y +
                                                         map[2][row] * at.z + map[3][row]));
    }
    const glm::dvec3 sight = glm::normalize(glm::cross(rowOf(map, 0), rowOf(map, 1)));
    const double slope = std::abs(glm::dot(rowOf(map, 2), sight));
    out.cascadeDepth[i] =
        glm::vec4(shadow.reversed[i] ? -1.0f : 1.0f, shadow.reversed[i] ? 1.0f : 0.0f,
                  static_cast<float>(shadow.bias * slope), 0.0f);
  }
}

}  // namespace welkin
