// SPDX-License-Identifier: MIT
// Three doubles: points and directions (m, or unit vectors) and colours (red, green, blue).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace welkin::reference {

using Point = std::array<double, 3>;
using Rgb = std::array<double, 3>;

inline double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline Point minus(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

// origin + t direction.
inline Point along(const Point& origin, const Point& direction, double t) {
  return {origin[0] + t * direction[0], origin[1] + t * direction[1], origin[2] + t * direction[2]};
}

inline Point normalized(const Point& a) {
  const double scale = 1 / std::sqrt(dot(a, a));
  return {a[0] * scale, a[1] * scale, a[2] * scale};
}

// 1 - cos of the angle between unit vectors, without cancellation at small angles.
inline double oneMinusCosine(const Point& a, const Point& b) {
  const Point d = minus(a, b);
  return dot(d, d) / 2;
}

// The unit vector at an angle with 1 - cos = y from `axis`, turned about it by `azimuth` (rad).
inline Point deflected(const Point& axis, double y, double azimuth) {
  const double sine = std::sqrt(std::fmax(y * (2 - y), 0.0));
  // Any vector that is far from parallel gives the azimuth's origin.
  const size_t k = std::fabs(axis[0]) < 0.6 ? 0 : 1;
  Point other{};
  other[k] = 1;
  const Point u = normalized(cross(axis, other));
  const Point v = cross(axis, u);
  const double a = sine * std::cos(azimuth);
  const double b = sine * std::sin(azimuth);
  Point result{};
  for (size_t i = 0; i < 3; ++i) {
    result[i] = axis[i] * (1 - y) + a * u[i] + b * v[i];
  }
  return normalized(result);
}

}  // namespace welkin::reference
