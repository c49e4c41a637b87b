// SPDX-License-Identifier: MIT
// Procedural clouds: a few rounded heaps with flat bases, eroded by fractal noise.
#include "engine/cloud.hpp"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace {

// A number in [0, 1) for a lattice point: C. Wellons' "lowbias32" integer hash.
double hash(const glm::ivec3& p) {
  uint32_t x = static_cast<uint32_t>(p.x) * 73856093u ^ static_cast<uint32_t>(p.y) * 19349663u ^
               static_cast<uint32_t>(p.z) * 83492791u;
  x = (x ^ x >> 16) * 0x7feb352du;
  x = (x ^ x >> 15) * 0x846ca68bu;
  return (x ^ x >> 16) / 4294967296.0;
}

// Trilinear value noise with smooth derivatives.
double noise(const glm::dvec3& p) {
  const glm::ivec3 cell(glm::floor(p));
  const glm::dvec3 f = p - glm::floor(p);
  const glm::dvec3 w = f * f * (3.0 - 2.0 * f);
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::ivec3 o(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
    const glm::dvec3 part = glm::mix(1.0 - w, w, glm::dvec3(o));
    sum += part.x * part.y * part.z * hash(cell + o);
  }
  return sum;
}

double fractalNoise(glm::dvec3 p) {
  double sum = 0.0;
  double amplitude = 0.5;
  for (int octave = 0; octave < 4; ++octave) {
    sum += amplitude * noise(p);
    amplitude *= 0.5;
    p = p * 2.03 + 7.1;
  }
  return sum / 0.9375;
}

}  // namespace

CloudField makeCloudField() {
  struct Heap {
    double x, z, radius, top;
  };
  constexpr std::array heaps{Heap{0.30, 0.62, 0.22, 0.9}, Heap{0.68, 0.40, 0.26, 1.0},
                             Heap{0.40, 0.22, 0.17, 0.6}, Heap{0.80, 0.78, 0.15, 0.5}};
  CloudField field{{96, 40, 96}, {}};
  field.values.reserve(size_t{field.size[0]} * field.size[1] * field.size[2]);
  for (uint32_t k = 0; k < field.size[2]; ++k) {
    for (uint32_t j = 0; j < field.size[1]; ++j) {
      for (uint32_t i = 0; i < field.size[0]; ++i) {
        const glm::dvec3 p =
            (glm::dvec3(i, j, k) + 0.5) / glm::dvec3(field.size[0], field.size[1], field.size[2]);
        double inside = -1.0;  // 0 on a heap's surface, 1 in its middle
        for (const Heap& heap : heaps) {
          const double up = (p.y - 0.08) / (0.9 * heap.top);
          const double across = std::hypot(p.x - heap.x, p.z - heap.z) / heap.radius;
          const double base = up < 0.0 ? 40.0 * up * up : up * up;
          inside = std::max(inside, 1.0 - across * across - base);
        }
        const double eroded = inside - 1.3 * (fractalNoise(p * glm::dvec3(22, 9, 22)) - 0.35);
        field.values.push_back(static_cast<float>(glm::smoothstep(0.0, 0.25, eroded)));
      }
    }
  }
  return field;
}
