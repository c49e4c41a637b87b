// SPDX-License-Identifier: MIT
// The engine's world: hills and a few spheres, in one vertex and one index list.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

struct Vertex {
  glm::vec3 position;  // m
  glm::vec3 normal;
  glm::vec3 albedo;
};

struct Mesh {
  std::vector<Vertex> vertices;
  std::vector<uint32_t> indices;
};

Mesh makeWorld();
