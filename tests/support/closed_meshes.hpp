// SPDX-License-Identifier: MIT
// Closed meshes, their triangles against the clock seen from outside.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

namespace support {

struct ClosedMesh {
  std::vector<glm::dvec3> position;
  std::vector<std::array<uint32_t, 3>> triangle;
};

// From an octahedron, each triangle in four, `times` times; on the unit sphere, outwards.
inline ClosedMesh sphereMesh(int times) {
  ClosedMesh mesh;
  mesh.position = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.triangle = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                   {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int i = 0; i < times; ++i) {
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
    const auto middle = [&](uint32_t a, uint32_t b) {
      const auto [found, fresh] = middles.try_emplace(std::minmax(a, b), 0);
      if (fresh) {
        found->second = static_cast<uint32_t>(mesh.position.size());
        mesh.position.push_back(glm::normalize(mesh.position[a] + mesh.position[b]));
      }
      return found->second;
    };
    std::vector<std::array<uint32_t, 3>> finer;
    for (const auto& [a, b, c] : mesh.triangle) {
      const uint32_t ab = middle(a, b);
      const uint32_t bc = middle(b, c);
      const uint32_t ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    mesh.triangle = finer;
  }
  return mesh;
}

// Not convex: rays cross it up to four times.
inline ClosedMesh torusMesh(uint32_t around = 24, uint32_t across = 12) {
  ClosedMesh mesh;
  for (uint32_t i = 0; i < around; ++i) {
    for (uint32_t j = 0; j < across; ++j) {
      const double u = 2 * std::numbers::pi * i / around;
      const double v = 2 * std::numbers::pi * j / across;
      const double r = 0.7 + 0.3 * std::cos(v);
      mesh.position.push_back({r * std::cos(u), r * std::sin(u), 0.3 * std::sin(v)});
      const auto at = [&](uint32_t p, uint32_t q) { return p % around * across + q % across; };
      mesh.triangle.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangle.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh;
}

// Two pyramids over a polygon of so many sides, with tips at z = 1 and -1: needles, all of which
// meet at the tips.
inline ClosedMesh needleMesh(uint32_t sides) {
  ClosedMesh mesh;
  mesh.position = {{0, 0, 1}, {0, 0, -1}};
  for (uint32_t i = 0; i < sides; ++i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    mesh.position.emplace_back(std::cos(angle), std::sin(angle), 0.0);
    const uint32_t here = 2 + i;
    const uint32_t next = 2 + (i + 1) % sides;
    mesh.triangle.push_back({0, here, next});
    mesh.triangle.push_back({1, next, here});
  }
  return mesh;
}

inline ClosedMesh boxMesh() {
  ClosedMesh mesh;
  for (uint32_t i = 0; i < 8; ++i) {
    mesh.position.push_back({(i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1});
  }
  mesh.triangle = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                   {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

}  // namespace support
