// SPDX-License-Identifier: MIT
#include "frame/ambient.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "frame/transport_rays.hpp"

namespace welkin {
namespace {

constexpr size_t DIRECTIONS = interface_::AMBIENT_DIRECTIONS;
static_assert(interface_::FINE_ZENITHS * interface_::FINE_AZIMUTHS == 256);
static_assert(DIRECTIONS == AMBIENT_LIGHT_DIRECTIONS);
constexpr size_t TERMS = interface_::TRANSPORT_TERMS;
constexpr int LEVELS = interface_::TRANSPORT_LEVELS;
// A direction stands for what comes from around it, e^(SHARPNESS (cos - 1)): half of it within 20
// degrees, as the directions lie 45 degrees apart.
constexpr double SHARPNESS = 12;

using Moments = std::array<glm::dvec3, TERMS>;

void addTo(Moments& moments, const glm::dvec3& direction, const glm::dvec3& value) {
  const auto harmonics = transportHarmonics(direction);
  for (size_t term = 0; term < TERMS; ++term) {
    moments[term] += harmonics[term] * value;
  }
}

}  // namespace

AmbientLight ambientThrough(const glm::dmat3& box, const TransportShape& shape,
                            std::span<const AmbientSample> samples) {
  const auto travels = transportDirectionsIn(box, shape);
  const TransportQuadrature q = transportQuadrature();
  std::array<glm::dvec3, DIRECTIONS> light;
  glm::dvec3 mean(0);
  double whole = 0;
  for (const AmbientSample& sample : samples) {
    mean += sample.solidAngle * sample.radiance;
    whole += sample.solidAngle;
  }
  mean /= std::max(whole, 1e-30);
  // Of what differs from the mean, so that what is the same everywhere stays so.
  Moments missing{};
  for (const AmbientSample& sample : samples) {
    addTo(missing, -sample.from, sample.solidAngle / whole * (sample.radiance - mean));
  }
  for (size_t d = 0; d < DIRECTIONS; ++d) {
    glm::dvec3 sum(0);
    double weights = 0;
    for (const AmbientSample& sample : samples) {
      const double apart = -glm::dot(sample.from, travels[d]) - 1;
      const double weight = sample.solidAngle * std::exp(SHARPNESS * apart);
      sum += weight * sample.radiance;
      weights += weight;
    }
    light[d] = weights > 0 ? sum / weights : glm::dvec3(0);
    addTo(missing, travels[d], -q.coarse[d] * (light[d] - mean));
  }
  // The quadrature is exact for products of two harmonics: this restores all moments at once.
  glm::dvec3 kept(0);
  for (size_t d = 0; d < DIRECTIONS; ++d) {
    const auto harmonics = transportHarmonics(travels[d]);
    for (size_t term = 0; term < TERMS; ++term) {
      light[d] += harmonics[term] * missing[term];
    }
    light[d] = glm::max(light[d], glm::dvec3(0));
    kept += q.coarse[d] * light[d];
  }
  AmbientLight result{};
  for (size_t d = 0; d < DIRECTIONS; ++d) {
    for (int c = 0; c < 3; ++c) {
      const double scale = kept[c] > 0 ? std::max(mean[c], 0.0) / kept[c] : 0.0;
      result[d][c] = static_cast<float>(light[d][c] * scale);
    }
  }
  return result;
}

AmbientFine ambientFine(const TransportMedia& media, std::span<const AmbientSample> samples,
                        bool whole) {
  std::array<glm::dvec3, FINE_NODES> kernel{};
  double whole_sr = 0;
  glm::dvec3 mean(0);
  for (const AmbientSample& sample : samples) {
    mean += sample.solidAngle * sample.radiance;
    whole_sr += sample.solidAngle;
  }
  mean /= std::max(whole_sr, 1e-30);
  if (whole) {
    // e^(k (cos - 1)) over its integral 2 pi / k.
    for (size_t n = 0; n < FINE_NODES; ++n) {
      const double half = static_cast<double>(n) / (FINE_NODES - 1);
      kernel[n] =
          glm::dvec3(SHARPNESS / (2 * std::numbers::pi) * std::exp(-2 * SHARPNESS * half * half));
    }
    removeLowDegrees(kernel);
  }
  for (size_t n = 0; n < FINE_NODES; ++n) {
    kernel[n] = whole ? media.peak * kernel[n] + (1 - media.peak) * media.fineKernel[n]
                      : media.fineKernel[n];
  }
  AmbientFine fine{};
  for (int row = 0; row < interface_::FINE_ZENITHS; ++row) {
    const double zenith = (row + 0.5) / interface_::FINE_ZENITHS * std::numbers::pi;
    for (int column = 0; column < interface_::FINE_AZIMUTHS; ++column) {
      const double azimuth =
          (2 * column + 1.0) / interface_::FINE_AZIMUTHS * std::numbers::pi - std::numbers::pi;
      const glm::dvec3 v(std::sin(zenith) * std::cos(azimuth), std::cos(zenith),
                         std::sin(zenith) * std::sin(azimuth));
      glm::dvec3 sum(0);
      for (const AmbientSample& sample : samples) {
        // Light from there travels the other way.
        const double half = std::sqrt(std::clamp(0.5 + 0.5 * glm::dot(sample.from, v), 0.0, 1.0));
        const double at = half * (FINE_NODES - 1);
        const size_t node = std::min(static_cast<size_t>(at), FINE_NODES - 2);
        const double part = at - static_cast<double>(node);
        // Less the mean: what is the same everywhere stays so.
        sum += sample.solidAngle * (sample.radiance - mean) *
               glm::mix(kernel[node], kernel[node + 1], part);
      }
      fine[static_cast<size_t>(row) * interface_::FINE_AZIMUTHS + static_cast<size_t>(column)] =
          glm::vec4(glm::vec3(sum), 0);
    }
  }
  return fine;
}

bool dark(const AmbientLight& light) {
  return std::all_of(light.begin(), light.end(),
                     [](const glm::vec4& one) { return !(one.x > 0 || one.y > 0 || one.z > 0); });
}

AmbientSizes ambientSizes(const std::array<uint32_t, 3>& cells) {
  const TransportSizes sizes = transportSizes(cells);
  VkDeviceSize total = 0;
  for (const uint32_t level : sizes.cells) {
    total += level;
  }
  constexpr VkDeviceSize RGBA = 4 * sizeof(float);
  return {RGBA * (2 * TERMS * total + 2 * DIRECTIONS * VkDeviceSize{sizes.cells[0]}),
          RGBA * ((TRANSPORT_DEGREES + TERMS) * total + sizes.cells[0])};
}

void fillAmbient(const VolumeState& volume, const TransportShape& shape,
                 const VolumeAmbient& ambient, interface_::AmbientUniforms& out) {
  out = {};
  const glm::dmat3 box(volume.worldFromBox);
  const glm::dmat3 boxFromWorld = glm::inverse(box);
  const TransportSizes sizes = transportSizes(shape.cells);
  const TransportQuadrature q = transportQuadrature();
  const auto travels = transportDirectionsIn(box, shape);
  int place = 0;
  for (int level = 0; level < LEVELS; ++level) {
    const int count = static_cast<int>(sizes.cells[static_cast<size_t>(level)]);
    for (int i = 0; i < 3; ++i) {
      out.size[level][i] = static_cast<int>(shape.cells[static_cast<size_t>(i)] >> level);
    }
    out.size[level].w = count;
    out.place[level] = {place, 0, 0, 0};
    place += count;
    const glm::dmat3 cells = transportCellsFromWorld(boxFromWorld, shape, 1.0 / (1 << level));
    for (size_t d = 0; d < DIRECTIONS; ++d) {
      out.directions[static_cast<size_t>(level) * DIRECTIONS + d] =
          transportDirection(cells, travels[d], q.coarse[d]);
    }
  }
  for (size_t d = 0; d < DIRECTIONS; ++d) {
    const auto terms = transportHarmonics(travels[d]);
    for (size_t term = 0; term < TERMS; ++term) {
      out.harmonics[d * 4 + term / 4][static_cast<int>(term % 4)] = static_cast<float>(terms[term]);
    }
    out.incoming[d] = ambient.light[d];
  }
  std::copy(ambient.fine.begin(), ambient.fine.end(), out.fine);
  for (int i = 0; i < 3; ++i) {
    out.worldFromBox[i] = glm::vec4(glm::vec3(box[i]), 0);
  }
  out.gridOrigin = glm::vec4(glm::vec3(shape.origin), 0);
  out.gridSize = glm::vec4(glm::vec3(shape.size), 0);
  const TransportMedia& media = *volume.transport;
  for (uint32_t i = 0; i < volume.fieldCount; ++i) {
    out.extinctionScale[static_cast<int>(i)] = extinctionAtOne(volume.fields[i]);
    for (size_t l = 0; l < TRANSPORT_DEGREES; ++l) {
      out.moments[i * TRANSPORT_DEGREES + l] = media.colorMoments[i][l];
    }
  }
  out.peak = {static_cast<float>(1 - media.peak), transportTaps(volume, shape), 0, 0};
  fillBricks(volume, out);
}

}  // namespace welkin
