// SPDX-License-Identifier: MIT
#include "frame/transport.hpp"

#include <algorithm>
#include <cmath>

#include "tables/transport_phase.hpp"

namespace welkin {
namespace {

using interface_::TransportDirection;
using interface_::TransportUniforms;

constexpr int LEVELS = interface_::TRANSPORT_LEVELS;
constexpr int DIRECTIONS = interface_::TRANSPORT_DIRECTIONS;
constexpr int TERMS = interface_::TRANSPORT_TERMS;

struct Quadrature {
  std::array<glm::dvec3, DIRECTIONS> direction;
  std::array<double, DIRECTIONS> weight;
};

// Lebedev 1976, 26 points: faces, edges and corners of a cube; exact to degree 7, which products of
// two harmonics of degree 3 do not exceed.
Quadrature quadrature() {
  Quadrature q{};
  size_t next = 0;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        const int parts = x * x + y * y + z * z;
        if (parts > 0) {
          q.direction[next] = glm::normalize(glm::dvec3(x, y, z));
          q.weight[next++] = parts == 1 ? 1.0 / 21 : parts == 2 ? 4.0 / 105 : 9.0 / 280;
        }
      }
    }
  }
  return q;
}

// Degree < 4, numbered l l + l + m, mean square 1; m > 0 with cos(m azimuth).
std::array<double, TERMS> harmonics(const glm::dvec3& v) {
  const double x = v.x;
  const double y = v.y;
  const double z = v.z;
  const double squares = x * x - y * y;
  return {1.0,
          std::sqrt(3.0) * y,
          std::sqrt(3.0) * z,
          std::sqrt(3.0) * x,
          std::sqrt(15.0) * x * y,
          std::sqrt(15.0) * y * z,
          std::sqrt(5.0) / 2 * (3 * z * z - 1),
          std::sqrt(15.0) * x * z,
          std::sqrt(15.0) / 2 * squares,
          std::sqrt(35.0 / 8) * y * (3 * x * x - y * y),
          std::sqrt(105.0) * x * y * z,
          std::sqrt(21.0 / 8) * y * (5 * z * z - 1),
          std::sqrt(7.0) / 2 * z * (5 * z * z - 3),
          std::sqrt(21.0 / 8) * x * (5 * z * z - 1),
          std::sqrt(105.0) / 2 * z * squares,
          std::sqrt(35.0 / 8) * x * (x * x - 3 * y * y)};
}

// How rays of a direction meet slices; `cellsFromWorld` counts cells along the box's axes.
TransportDirection directionThrough(const glm::dmat3& cellsFromWorld, const glm::dvec3& direction,
                                    double weight) {
  const glm::dvec3 speed = cellsFromWorld * direction;  // cells per m
  int main = 0;
  for (int axis = 1; axis < 3; ++axis) {
    // The margin keeps the choice from hanging on rounding.
    if (std::abs(speed[axis]) > std::abs(speed[main]) * (1 + 1e-9)) {
      main = axis;
    }
  }
  const int u = (main + 1) % 3;
  const int v = (main + 2) % 3;
  const double path = 1 / std::abs(speed[main]);
  TransportDirection out;
  out.step_ = glm::vec4(glm::dvec4(speed[u] * path, speed[v] * path, path, weight));
  out.axes = {main, u, v, speed[main] > 0 ? 1 : -1};
  return out;
}

glm::dmat3 cellsFromWorld(const glm::dmat3& boxFromWorld, double cells) {
  return cells * boxFromWorld;
}

double meanAlbedo(const FieldState& field) {
  const std::array<double, RGB> albedo = field.medium.scaledAlbedo();
  return (albedo[0] + albedo[1] + albedo[2]) / 3;
}

// Shares of the fields in the volume's extinction.
std::vector<double> fieldWeights(const VolumeState& volume) {
  std::vector<double> weights(volume.fieldCount);
  double sum = 0;
  for (uint32_t i = 0; i < volume.fieldCount; ++i) {
    const FieldState& field = volume.fields[i];
    const double mean = field.external ? 1.0 : field.mean;
    weights[i] = field.extinctionScale * field.medium.extinctionFactor() * mean;
    sum += weights[i];
  }
  for (double& weight : weights) {
    weight = sum > 0 ? weight / sum : 1.0 / volume.fieldCount;
  }
  return weights;
}

}  // namespace

TransportSizes transportSizes(uint32_t cells) {
  TransportSizes sizes;
  VkDeviceSize total = 0;
  for (uint32_t level = 0; level < LEVELS; ++level) {
    const uint32_t edge = cells >> level;
    sizes.cells[level] = edge * edge * edge;
    total += sizes.cells[level];
  }
  const VkDeviceSize finest = sizes.cells[0];
  sizes.workBytes = sizeof(float) * (2 * TERMS * total + 2 * DIRECTIONS * finest);
  sizes.keptBytes =
      sizeof(float) * ((6 + TERMS) * total + interface_::FIRST_TERMS * finest);
  return sizes;
}

TransportMedia transportMedia(const VolumeState& volume) {
  TransportMedia media;
  const std::vector<double> weights = fieldWeights(volume);
  std::vector<TransportPhase> phases;
  std::vector<const TransportPhase*> list;
  for (uint32_t i = 0; i < volume.fieldCount; ++i) {
    phases.push_back(transportPhase(volume.fields[i].medium.particle->curve));
  }
  for (uint32_t i = 0; i < volume.fieldCount; ++i) {
    list.push_back(&phases[i]);
    media.peak += weights[i] * meanAlbedo(volume.fields[i]) * phases[i].peak;
  }
  for (uint32_t i = 0; i < volume.fieldCount; ++i) {
    const double f = phases[i].peak;
    const double albedo = meanAlbedo(volume.fields[i]);
    for (int l = 0; l < TRANSPORT_MOMENTS; ++l) {
      const double moment = f + (1 - f) * phases[i].moments[static_cast<size_t>(l)];
      media.fieldMoments[i][l] =
          static_cast<float>((albedo * moment - media.peak) / (1 - media.peak));
    }
  }
  const TransportPairs pairs = transportPairs(list, weights);
  for (size_t l = 0; l < TRANSPORT_MOMENTS; ++l) {
    for (size_t k = 0; k < TRANSPORT_FIRST; ++k) {
      const auto& row = pairs.first[l][k];
      media.first[l * TRANSPORT_FIRST + k] = {row[0], row[1], row[2], 0};
    }
  }
  media.response = pairs.response;
  return media;
}

void fillTransport(const VolumeState& volume, const glm::dvec3& toLight, uint32_t cells,
                   TransportUniforms& out) {
  out = {};
  const glm::dmat3 box(volume.worldFromBox);
  const glm::dmat3 boxFromWorld = glm::inverse(box);
  const TransportSizes sizes = transportSizes(cells);
  // Directions turn with the box.
  const glm::dvec3 a = glm::normalize(box[0]);
  const glm::dvec3 b = glm::normalize(box[1] - a * glm::dot(a, glm::dvec3(box[1])));
  const glm::dmat3 turn(a, b, glm::cross(a, b));
  // Around the light, tied to the box's axis that is farthest from it.
  const glm::dvec3 travel = -toLight;
  glm::dvec3 side = turn[0];
  for (int i = 1; i < 3; ++i) {
    const glm::dvec3 other = turn[i];
    side = std::abs(glm::dot(other, travel)) < std::abs(glm::dot(side, travel)) ? other : side;
  }
  const glm::dvec3 x = glm::normalize(side - travel * glm::dot(side, travel));
  const glm::dvec3 y = glm::cross(travel, x);
  out.lightFrame[0] = glm::vec4(glm::vec3(x), 0);
  out.lightFrame[1] = glm::vec4(glm::vec3(y), 0);
  out.lightFrame[2] = glm::vec4(glm::vec3(travel), 0);

  const Quadrature q = quadrature();
  int place = 0;
  for (int level = 0; level < LEVELS; ++level) {
    const int edge = static_cast<int>(cells >> level);
    const int count = static_cast<int>(sizes.cells[static_cast<size_t>(level)]);
    out.size[level] = {edge, edge, edge, count};
    out.place[level] = {place, 0, 0, 0};
    place += count;
    for (size_t d = 0; d < DIRECTIONS; ++d) {
      out.directions[static_cast<size_t>(level) * DIRECTIONS + d] = directionThrough(
          cellsFromWorld(boxFromWorld, edge), turn * q.direction[d], q.weight[d]);
    }
  }
  for (size_t d = 0; d < DIRECTIONS; ++d) {
    const glm::dvec3 w = turn * q.direction[d];
    const auto terms =
        harmonics({glm::dot(w, x), glm::dot(w, y), std::clamp(glm::dot(w, travel), -1.0, 1.0)});
    for (size_t term = 0; term < TERMS; ++term) {
      out.harmonics[d * 4 + term / 4][static_cast<int>(term % 4)] = static_cast<float>(terms[term]);
    }
  }
  out.light = directionThrough(cellsFromWorld(boxFromWorld, 2.0 * cells), travel, 1);
  const TransportMedia& media = *volume.transport;
  std::copy(media.first.begin(), media.first.end(), out.first);
  for (int i = 0; i < 3; ++i) {
    out.worldFromBox[i] = glm::vec4(glm::vec3(box[i]), 0);
  }
  uint32_t voxels = 1;
  for (uint32_t i = 0; i < volume.fieldCount; ++i) {
    const FieldState& field = volume.fields[i];
    const bool present = field.external.has_value() || field.image;
    out.extinctionScale[static_cast<int>(i)] =
        present ? field.extinctionScale * static_cast<float>(field.medium.extinctionFactor())
                : 0.0f;
    out.fieldMoments[i] = media.fieldMoments[i];
  }
  for (const uint32_t n : volume.size) {
    voxels = std::max(voxels, n);
  }
  const uint32_t taps = std::clamp((voxels + 2 * cells - 1) / (2 * cells), 1U, 4U);
  out.peak = {static_cast<float>(1 - media.peak), static_cast<float>(taps), 0, 0};
}

}  // namespace welkin
