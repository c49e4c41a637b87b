// SPDX-License-Identifier: MIT
#include "frame/transport_layer.hpp"

#include <cmath>
#include <numbers>

namespace welkin {
namespace {

constexpr size_t RINGS = TransportLayer::RINGS;
constexpr size_t TURNS = TransportLayer::TURNS;
constexpr size_t COUNT = TransportLayer::COUNT;
constexpr size_t SIDE = interface_::LAYER_RINGS;

// Gauss-Legendre over (0, 1): light is discontinuous at the layer's plane, smooth on either side.
constexpr std::array<double, SIDE> HEIGHT = {0.0694318442029737, 0.3300094782075719,
                                             0.6699905217924281, 0.9305681557970263};
constexpr std::array<double, SIDE> SHARE = {0.1739274225687269, 0.3260725774312731,
                                            0.3260725774312731, 0.1739274225687269};

using Rows = std::array<std::array<double, interface_::FIRST_TERMS>, COUNT>;

// Terms of light that is `shape` times what is sought: in each ring their ratio, and on each side
// of the plane what is left over along x and y, by least squares.
Rows termsOf(const TransportLayer& layer, const std::array<double, COUNT>& shape) {
  Rows rows{};
  for (size_t side = 0; side < 2; ++side) {
    std::array<double, 2> square{};
    for (size_t d = side * COUNT / 2; d < (side + 1) * COUNT / 2; ++d) {
      for (size_t i = 0; i < 2; ++i) {
        const double along = layer.local[d][static_cast<int>(i)];
        square[i] += layer.weight[d] * shape[d] * along * along;
      }
    }
    for (size_t ring = side * SIDE; ring < (side + 1) * SIDE; ++ring) {
      double sum = 0;
      std::array<double, 2> first{};
      for (size_t d = ring * TURNS; d < (ring + 1) * TURNS; ++d) {
        sum += shape[d];
        for (size_t i = 0; i < 2; ++i) {
          first[i] += shape[d] * layer.local[d][static_cast<int>(i)];
        }
      }
      for (size_t d = ring * TURNS; d < (ring + 1) * TURNS; ++d) {
        rows[d][ring] = 1 / (sum * layer.weight[d]);
        for (size_t i = 0; i < 2; ++i) {
          const double along = layer.local[d][static_cast<int>(i)];
          rows[d][RINGS + 2 * side + i] = (along - first[i] / sum) / square[i];
        }
      }
    }
  }
  return rows;
}

}  // namespace

glm::dvec3 layerNormal(const glm::dmat3& box, int thinAxis) {
  const glm::dvec3 along = glm::normalize(box[(thinAxis + 1) % 3]);
  return glm::normalize(glm::cross(along, box[(thinAxis + 2) % 3]));
}

TransportLayer transportLayer(const glm::dmat3& box, int thinAxis, const glm::dvec3& travel) {
  TransportLayer layer;
  const glm::dvec3 along = glm::normalize(box[(thinAxis + 1) % 3]);
  const glm::dvec3 normal = layerNormal(box, thinAxis);
  const glm::dvec3 across = glm::cross(normal, along);
  // Which azimuth a light on the normal has does not matter.
  const double sine = std::hypot(glm::dot(travel, along), glm::dot(travel, across));
  const glm::dvec3 x = sine > 1e-9 ? (travel - normal * glm::dot(travel, normal)) / sine : along;
  layer.frame = {x, glm::cross(normal, x), normal};
  layer.travel = {sine, 0, glm::dot(travel, normal)};
  for (size_t ring = 0; ring < RINGS; ++ring) {
    const double z = ring < SIDE ? HEIGHT[ring] : -HEIGHT[ring - SIDE];
    // Rings are turned against each other: together they see all azimuths.
    const double begin = (static_cast<double>(ring * 3 % RINGS) + 0.5) / RINGS;
    for (size_t turn = 0; turn < TURNS; ++turn) {
      const double azimuth = 2 * std::numbers::pi / TURNS * (static_cast<double>(turn) + begin);
      const size_t d = ring * TURNS + turn;
      const double s = std::sqrt(1 - z * z);
      layer.direction[d] =
          along * (s * std::cos(azimuth)) + across * (s * std::sin(azimuth)) + normal * z;
      layer.weight[d] = SHARE[ring % SIDE] / (2 * TURNS);
      for (int i = 0; i < 3; ++i) {
        layer.local[d][i] = glm::dot(layer.frame[static_cast<size_t>(i)], layer.direction[d]);
      }
    }
  }
  return layer;
}

std::array<double, 3> layerFourth(const glm::dvec3& v) {
  const double square = v.z * v.z;
  return {0.375 * (square * (35 * square - 30) + 3),
          0.75 * std::sqrt(10.0) * v.x * v.z * (7 * square - 3),
          0.75 * std::sqrt(5.0) * (v.x * v.x - v.y * v.y) * (7 * square - 1)};
}

void fillLayerRows(const TransportLayer& layer, const std::array<double, COUNT>& twice,
                   glm::vec4* rows) {
  std::array<double, COUNT> even;
  even.fill(1);
  const std::array<Rows, 2> terms = {termsOf(layer, even), termsOf(layer, twice)};
  constexpr std::array<int, 2> BEGIN = {interface_::FIRST_ROWS, interface_::SECOND_ROWS};
  for (size_t order = 0; order < 2; ++order) {
    for (size_t d = 0; d < COUNT; ++d) {
      for (size_t term = 0; term < interface_::FIRST_TERMS; ++term) {
        rows[static_cast<size_t>(BEGIN[order]) + 3 * d + term / 4][static_cast<int>(term % 4)] =
            static_cast<float>(terms[order][d][term]);
      }
    }
  }
}

}  // namespace welkin
