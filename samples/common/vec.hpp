// SPDX-License-Identifier: MIT
// Three doubles and the few operations that the host's geometry needs.
#pragma once

#include <array>
#include <cmath>

namespace host {

constexpr double PI = 3.14159265358979323846;
constexpr double RADIANS_PER_DEGREE = PI / 180.0;

using Rgb = std::array<float, 3>;

struct Vec3 {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
};

inline Vec3 operator+(Vec3 a, Vec3 b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Vec3 operator-(Vec3 a, Vec3 b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vec3 operator*(Vec3 a, double s) {
  return {a.x * s, a.y * s, a.z * s};
}
inline Vec3 operator*(Vec3 a, Vec3 b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}
inline double dot(Vec3 a, Vec3 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vec3 cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/// hypot with three arguments neither overflows nor underflows on the way.
inline double length(Vec3 a) {
  return std::hypot(a.x, a.y, a.z);
}
/// The caller makes sure that the length is not 0.
inline Vec3 normalize(Vec3 a) {
  return a * (1.0 / length(a));
}

/// Unit vector of an elevation over the horizon and an azimuth clockwise from -z (north) over +x
/// (east), both in degrees; the one convention of scenes, cameras and sky queries.
inline Vec3 directionFromAngles(double elevationDeg, double azimuthDeg) {
  const double elevation = elevationDeg * RADIANS_PER_DEGREE;
  const double azimuth = azimuthDeg * RADIANS_PER_DEGREE;
  return {std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
          -std::cos(azimuth) * std::cos(elevation)};
}

/// Row-major 3x4 affine map.
using Affine = std::array<double, 12>;

inline Vec3 transformPoint(const Affine& m, Vec3 p) {
  return {m[0] * p.x + m[1] * p.y + m[2] * p.z + m[3], m[4] * p.x + m[5] * p.y + m[6] * p.z + m[7],
          m[8] * p.x + m[9] * p.y + m[10] * p.z + m[11]};
}

/// The map from the unit box to the parallelepiped with corner `origin` and these edges.
inline Affine affineFromEdges(Vec3 origin, Vec3 edgeX, Vec3 edgeY, Vec3 edgeZ) {
  return {edgeX.x, edgeY.x,  edgeZ.x, origin.x, edgeX.y, edgeY.y,
          edgeZ.y, origin.y, edgeX.z, edgeY.z,  edgeZ.z, origin.z};
}

}  // namespace host
