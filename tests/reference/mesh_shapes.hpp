// SPDX-License-Identifier: MIT
// Bodies for tests of what is bounded by a mesh.
#pragma once

#include <cmath>
#include <numbers>
#include <utility>

#include "reference/mesh_body.hpp"

namespace welkin::reference {

struct MeshShape {
  std::vector<Point> position;
  std::vector<std::array<uint32_t, 3>> triangle;
};

// Corners at +-1.
inline MeshShape boxShape() {
  MeshShape shape;
  for (unsigned i = 0; i < 8; ++i) {
    shape.position.push_back({i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0});
  }
  shape.triangle = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return shape;
}

// Radius 1, by latitude and longitude, 2 bands of triangles for each of `bands`.
inline MeshShape sphereShape(uint32_t bands) {
  MeshShape shape;
  const uint32_t around = 2 * bands;
  for (uint32_t i = 1; i < bands; ++i) {
    for (uint32_t j = 0; j < around; ++j) {
      const double polar = std::numbers::pi * i / bands;
      const double azimuth = std::numbers::pi * j / bands;
      shape.position.push_back({std::sin(polar) * std::cos(azimuth),
                                std::sin(polar) * std::sin(azimuth), std::cos(polar)});
    }
  }
  const auto north = static_cast<uint32_t>(shape.position.size());
  shape.position.push_back({0, 0, 1});
  shape.position.push_back({0, 0, -1});
  for (uint32_t j = 0; j < around; ++j) {
    const uint32_t next = (j + 1) % around;
    shape.triangle.push_back({north, j, next});
    for (uint32_t i = 0; i + 2 < bands; ++i) {
      const uint32_t row = i * around;
      shape.triangle.push_back({row + j, row + around + j, row + around + next});
      shape.triangle.push_back({row + j, row + around + next, row + next});
    }
    const uint32_t last = (bands - 2) * around;
    shape.triangle.push_back({north + 1, last + next, last + j});
  }
  return shape;
}

// Not convex: rays cross it up to four times. Radii 0.7 and 0.3.
inline MeshShape torusShape() {
  constexpr uint32_t AROUND = 24;
  constexpr uint32_t ACROSS = 12;
  MeshShape shape;
  const auto at = [](uint32_t i, uint32_t j) { return i % AROUND * ACROSS + j % ACROSS; };
  for (uint32_t i = 0; i < AROUND; ++i) {
    for (uint32_t j = 0; j < ACROSS; ++j) {
      const double u = 2 * std::numbers::pi * i / AROUND;
      const double v = 2 * std::numbers::pi * j / ACROSS;
      const double r = 0.7 + 0.3 * std::cos(v);
      shape.position.push_back({r * std::cos(u), r * std::sin(u), 0.3 * std::sin(v)});
      shape.triangle.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      shape.triangle.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return shape;
}

// Each axis scaled, then turned about z by an angle (rad).
inline MeshBody shaped(const MeshShape& shape, const Point& scale, double angle = 0) {
  std::vector<Point> positions;
  for (const Point& p : shape.position) {
    const double x = p[0] * scale[0];
    const double y = p[1] * scale[1];
    positions.push_back({x * std::cos(angle) - y * std::sin(angle),
                         x * std::sin(angle) + y * std::cos(angle), p[2] * scale[2]});
  }
  return {std::move(positions), shape.triangle};
}

// Of the volume of the sphere.
inline MeshBody sphereBody(double radius, uint32_t bands) {
  const MeshShape shape = sphereShape(bands);
  const double volume = shaped(shape, {1, 1, 1}).volume();
  const double r = radius * std::cbrt(4 * std::numbers::pi / 3 / volume);
  return shaped(shape, {r, r, r});
}

}  // namespace welkin::reference
