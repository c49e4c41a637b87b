// SPDX-License-Identifier: MIT
// A shadow map as an engine would draw it: orthographic, along the light.
#pragma once

#include <welkin/welkin.h>

#include <array>
#include <cmath>
#include <vector>
#include <welkin/welkin.hpp>

namespace welkin::test {

using Vec3 = std::array<double, 3>;

inline double dot(const Vec3& a, const Vec3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline Vec3 unit(const Vec3& a) {
  const double length = std::sqrt(dot(a, a));
  return {a[0] / length, a[1] / length, a[2] / length};
}
// Elevation above the horizon and azimuth from -z towards +x, as SceneBuilder::setSun.
inline Vec3 directionTo(double elevation_deg, double azimuth_deg) {
  constexpr double DEGREE = 3.14159265358979323846 / 180;
  const double level = std::cos(elevation_deg * DEGREE);
  return {level * std::sin(azimuth_deg * DEGREE), std::sin(elevation_deg * DEGREE),
          -level * std::cos(azimuth_deg * DEGREE)};
}

// A cube of `edge` m around `centre` that looks along the light: u, v and depth in [0, 1].
struct LightFrame {
  Vec3 centre;
  double edge;
  Vec3 right, down, travel;
  LightFrame(const Vec3& middle, double edge_m, const Vec3& toLight)
      : centre(middle),
        edge(edge_m),
        right(unit(cross({0, 1, 0}, toLight))),
        down(cross(toLight, right)),
        travel{-toLight[0], -toLight[1], -toLight[2]} {}
  Vec3 place(const Vec3& p) const {
    const Vec3 d{p[0] - centre[0], p[1] - centre[1], p[2] - centre[2]};
    return {dot(d, right) / edge + 0.5, dot(d, down) / edge + 0.5, dot(d, travel) / edge + 0.5};
  }
  // As WlkLightShadow::clipFromWorld, with positions relative to `origin`.
  void write(const Vec3& origin, bool reversed, float (&matrix)[16]) const {
    const double turn = reversed ? -1 : 1;
    const Vec3 d{origin[0] - centre[0], origin[1] - centre[1], origin[2] - centre[2]};
    for (size_t i = 0; i < 3; ++i) {
      matrix[4 * i] = static_cast<float>(2 * right[i] / edge);
      matrix[4 * i + 1] = static_cast<float>(2 * down[i] / edge);
      matrix[4 * i + 2] = static_cast<float>(turn * travel[i] / edge);
      matrix[4 * i + 3] = 0;
    }
    matrix[12] = static_cast<float>(2 * dot(d, right) / edge);
    matrix[13] = static_cast<float>(2 * dot(d, down) / edge);
    matrix[14] = static_cast<float>(turn * dot(d, travel) / edge + 0.5);
    matrix[15] = 1;
  }
};

}  // namespace welkin::test
