// SPDX-License-Identifier: MIT
#include "engine/mesh.hpp"

#include <cmath>
#include <numbers>

namespace {

constexpr uint32_t TERRAIN_EDGE = 257;    // vertices
constexpr double TERRAIN_SIZE = 40000.0;  // m

// Altitude of the ground, m: a flat valley around the origin, hills up to 900 m around it.
double groundHeight(double x, double z) {
  const double far = std::hypot(x, z) / 6000.0;
  const double rise = far * far / (1.0 + far * far);
  double height = 0.0;
  double amplitude = 450.0;
  double frequency = 2.0 * std::numbers::pi / 9000.0;
  for (int octave = 0; octave < 5; ++octave) {
    const double turn = 0.7 * octave;  // no two octaves share their axes
    const double u = x * std::cos(turn) + z * std::sin(turn);
    const double v = z * std::cos(turn) - x * std::sin(turn);
    height += amplitude * (0.5 + 0.5 * std::sin(u * frequency + octave) * std::cos(v * frequency));
    amplitude *= 0.45;
    frequency *= 2.1;
  }
  return rise * height;
}

void addTerrain(Mesh& mesh) {
  const auto first = static_cast<uint32_t>(mesh.vertices.size());
  const double cell = TERRAIN_SIZE / (TERRAIN_EDGE - 1);
  for (uint32_t j = 0; j < TERRAIN_EDGE; ++j) {
    for (uint32_t i = 0; i < TERRAIN_EDGE; ++i) {
      const double x = i * cell - 0.5 * TERRAIN_SIZE;
      const double z = j * cell - 0.5 * TERRAIN_SIZE;
      const double height = groundHeight(x, z);
      const glm::dvec3 normal(groundHeight(x - cell, z) - groundHeight(x + cell, z), 2.0 * cell,
                              groundHeight(x, z - cell) - groundHeight(x, z + cell));
      const double stone = glm::smoothstep(300.0, 700.0, height);
      const glm::dvec3 albedo =
          glm::mix(glm::dvec3(0.07, 0.11, 0.04), glm::dvec3(0.22, 0.20, 0.18), stone);
      mesh.vertices.push_back(
          {glm::vec3(x, height, z), glm::vec3(glm::normalize(normal)), glm::vec3(albedo)});
      if (i + 1 < TERRAIN_EDGE && j + 1 < TERRAIN_EDGE) {
        const uint32_t a = first + j * TERRAIN_EDGE + i;
        const uint32_t b = a + TERRAIN_EDGE;
        mesh.indices.insert(mesh.indices.end(), {a, b, a + 1, a + 1, b, b + 1});
      }
    }
  }
}

void addSphere(Mesh& mesh, const glm::dvec3& centre, double radius, const glm::vec3& albedo) {
  constexpr uint32_t RINGS = 24;
  constexpr uint32_t SEGMENTS = 48;
  const auto first = static_cast<uint32_t>(mesh.vertices.size());
  for (uint32_t j = 0; j <= RINGS; ++j) {
    for (uint32_t i = 0; i <= SEGMENTS; ++i) {
      const double polar = std::numbers::pi * j / RINGS;
      const double around = 2.0 * std::numbers::pi * i / SEGMENTS;
      const glm::dvec3 normal(std::sin(polar) * std::cos(around), std::cos(polar),
                              std::sin(polar) * std::sin(around));
      mesh.vertices.push_back({glm::vec3(centre + radius * normal), glm::vec3(normal), albedo});
      if (i < SEGMENTS && j < RINGS) {
        const uint32_t a = first + j * (SEGMENTS + 1) + i;
        const uint32_t b = a + SEGMENTS + 1;
        mesh.indices.insert(mesh.indices.end(), {a, a + 1, b, a + 1, b + 1, b});
      }
    }
  }
}

}  // namespace

Mesh makeWorld() {
  Mesh mesh;
  addTerrain(mesh);
  for (int i = 0; i < 7; ++i) {
    const double distance = 60.0 * std::pow(2.0, i);
    const double radius = 0.12 * distance;
    const double x = (0.14 * ((3 * i) % 7) - 0.42) * distance;  // side by side in the picture
    addSphere(mesh, {x, groundHeight(x, -distance) + radius, -distance}, radius,
              glm::vec3(0.6f, 0.6f - 0.07f * static_cast<float>(i), 0.2f));
  }
  return mesh;
}
