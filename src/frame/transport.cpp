// SPDX-License-Identifier: MIT
#include "frame/transport.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "frame/transport_layer.hpp"
#include "frame/transport_rays.hpp"
#include "tables/transport_phase.hpp"

namespace welkin {
namespace {

using interface_::TransportUniforms;

constexpr int LEVELS = interface_::TRANSPORT_LEVELS;
constexpr int DIRECTIONS = interface_::TRANSPORT_DIRECTIONS;
constexpr int TERMS = interface_::TRANSPORT_TERMS;

constexpr int COARSE = interface_::TRANSPORT_COARSE_DIRECTIONS;
// Grids of more cells take all directions on the two finest levels. With 26 a cube of optical depth
// 4 gives back 1.057 of its light, with 50 1.021, with 150 1.018 (double prototype, 16^3 cells).
constexpr uint32_t FINE_CELLS = 20 * 20 * 20;

// Shares of the fields in the volume's extinction; all 0 where there is none.
std::array<double, WLK_MAX_FIELDS> fieldShares(const VolumeState& volume) {
  std::array<double, WLK_MAX_FIELDS> shares{};
  double sum = 0;
  for (uint32_t i = 0; i < volume.fieldCount; ++i) {
    const FieldState& field = volume.fields[i];
    const double mean = field.external ? 1.0 : field.mean;
    shares[i] = field.extinctionScale * field.medium.extinctionFactor() * mean;
    sum += shares[i];
  }
  for (double& share : shares) {
    share = sum > 0 ? share / sum : 0.0;
  }
  return shares;
}

// The same with sum 1: fields count alike while nothing is there.
std::vector<double> fieldWeights(const VolumeState& volume,
                                 const std::array<double, WLK_MAX_FIELDS>& shares) {
  std::vector<double> weights(shares.begin(), shares.begin() + volume.fieldCount);
  if (std::all_of(weights.begin(), weights.end(), [](double weight) { return weight == 0; })) {
    weights.assign(volume.fieldCount, 1.0 / volume.fieldCount);
  }
  return weights;
}

// Rows of TransportUniforms::directed for direction w.
void fillDirected(const TransportMedia& media, const glm::dvec3& w, const glm::dvec3& x,
                  const glm::dvec3& y, const glm::dvec3& travel, glm::vec4* rows) {
  const double angle = std::acos(std::clamp(glm::dot(w, travel), -1.0, 1.0));
  const double azimuth = std::atan2(glm::dot(w, y), glm::dot(w, x));
  std::array<double, 6> f{};
  for (size_t i = 0; i < f.size(); ++i) {
    f[i] = transportPair(media, i, angle);
  }
  const double cos1 = std::cos(azimuth);
  const double sin1 = std::sin(azimuth);
  const double cos2 = std::cos(2 * azimuth);
  const double sin2 = std::sin(2 * azimuth);
  rows[0] = glm::vec4(glm::dvec4(f[0], f[2] * sin1, f[1], f[2] * cos1));
  rows[1] = glm::vec4(glm::dvec4(f[5] * sin2, f[4] * sin1, f[3], f[4] * cos1));
  rows[2] = glm::vec4(glm::dvec4(f[5] * cos2, 0, 0, 1 / std::max(f[0], 1e-6)));
}

// Directions of a grid, and their weights; of the first 26 alone, too.
struct TransportFan {
  std::array<glm::dvec3, DIRECTIONS> direction{};
  std::array<double, DIRECTIONS> fine{};
  std::array<double, TransportQuadrature::COARSE> coarse{};
};

void fillHarmonics(const glm::dvec3& local, glm::vec4* rows) {
  const auto terms = transportHarmonics(local);
  for (size_t term = 0; term < TERMS; ++term) {
    rows[term / 4][static_cast<int>(term % 4)] = static_cast<float>(terms[term]);
  }
}

// Harmonics around the light, tied to the box's axis that is farthest from it.
TransportFan cubeFan(const TransportMedia& media, const glm::dmat3& box,
                     const TransportShape& shape, const glm::dvec3& travel,
                     TransportUniforms& out) {
  const glm::dmat3 turn = transportTurn(box);
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
  out.travel = {0, 0, 1, 0};
  const TransportQuadrature q = transportQuadrature();
  const TransportFan fan{transportDirectionsIn(box, shape), q.fine, q.coarse};
  for (size_t d = 0; d < DIRECTIONS; ++d) {
    const glm::dvec3 w = fan.direction[d];
    fillHarmonics({glm::dot(w, x), glm::dot(w, y), std::clamp(glm::dot(w, travel), -1.0, 1.0)},
                  &out.rows[d * 4]);
    fillDirected(media, w, x, y, travel, &out.rows[interface_::FIRST_ROWS + d * 3]);
  }
  return fan;
}

// Harmonics around a layer's normal, and its own terms.
TransportFan layerFan(const TransportMedia& media, const glm::dmat3& box,
                      const TransportShape& shape, const glm::dvec3& travel,
                      TransportUniforms& out) {
  const TransportLayer layer = transportLayer(box, shape.thinAxis, travel);
  TransportFan fan;
  std::array<double, TransportLayer::COUNT> twice;
  for (size_t d = 0; d < TransportLayer::COUNT; ++d) {
    fan.direction[d] = layer.direction[d];
    fan.fine[d] = layer.weight[d];
    fillHarmonics(layer.local[d], &out.rows[d * 4]);
    const std::array<double, 3> fourth = layerFourth(layer.local[d]);
    for (size_t m = 0; m < fourth.size(); ++m) {
      const size_t term = interface_::LAYER_FOURTH + m;
      out.rows[d * 4 + term / 4][static_cast<int>(term % 4)] = static_cast<float>(fourth[m]);
    }
    const double cosine = std::clamp(glm::dot(layer.local[d], layer.travel), -1.0, 1.0);
    twice[d] = std::max(transportPair(media, 0, std::acos(cosine)), 1e-6);
  }
  for (size_t i = 0; i < 3; ++i) {
    out.lightFrame[i] = glm::vec4(glm::vec3(layer.frame[i]), 0);
  }
  out.travel = glm::vec4(glm::vec3(layer.travel), 1);
  fillLayerRows(layer, twice, out.rows);
  return fan;
}

bool isEmpty(const VolumeState& volume) {
  return std::none_of(volume.fields.begin(), volume.fields.begin() + volume.fieldCount,
                      [](const FieldState& field) { return field.external || field.mean > 0; });
}

// Of the turns by its own peak that an endless medium of this field alone, white, would add between
// two others: what the peak of all media and their absorption, `peak`, leave of them in the mean.
double turnedOf(double turned, double own, double peak) {
  if (!(own > 0) || own >= 1) {
    return turned;
  }
  return turned * std::min(peak / (1 - peak) * (1 - own) / own, 1.0);
}

// Media differ by steps of it: voxels that hardly change leave them as they are.
double stepOfTurned(double share) {
  return std::round(share * TURNED_STEPS) / TURNED_STEPS;
}

}  // namespace

double transportPair(const TransportMedia& media, size_t function, double angle) {
  constexpr size_t LAST = interface_::PAIR_TABLE_NODES - 1;
  const double at = angle / std::numbers::pi * static_cast<double>(LAST);
  const size_t node = std::min(static_cast<size_t>(at), LAST - 1);
  const double part = at - static_cast<double>(node);
  const float* row = &media.response[(function * (LAST + 1) + node) * 4];
  double sum = 0;
  for (size_t c = 0; c < RGB; ++c) {
    sum += (1 - part) * static_cast<double>(row[c]) + part * static_cast<double>(row[4 + c]);
  }
  return sum / RGB;
}

uint32_t transportDirections(uint32_t level, const TransportShape& shape) {
  if (shape.layer) {
    return TransportLayer::COUNT;
  }
  const std::array<uint32_t, 3>& cells = shape.cells;
  // Light is extrapolated over the two finest levels, which have to see the same directions.
  return level < 2 && cells[0] * cells[1] * cells[2] > FINE_CELLS ? DIRECTIONS : COARSE;
}

TransportSizes transportSizes(const std::array<uint32_t, 3>& cells) {
  TransportSizes sizes;
  VkDeviceSize total = 0;
  for (uint32_t level = 0; level < LEVELS; ++level) {
    sizes.cells[level] = (cells[0] >> level) * (cells[1] >> level) * (cells[2] >> level);
    total += sizes.cells[level];
  }
  const VkDeviceSize finest = sizes.cells[0];
  constexpr VkDeviceSize TWO = 2;
  constexpr VkDeviceSize FIRST = interface_::FIRST_TERMS;
  constexpr VkDeviceSize RESPONSES =
      VkDeviceSize{interface_::RESPONSE_ZENITHS} * interface_::RESPONSE_AZIMUTHS +
      TransportLayer::COUNT + TERMS;
  sizes.workBytes = sizeof(float) * (TWO * TERMS * total + VkDeviceSize{DIRECTIONS} * finest);
  sizes.sweptBytes = sizeof(float) * VkDeviceSize{DIRECTIONS} * finest;
  sizes.keptBytes =
      sizeof(float) * (VkDeviceSize{7 + TERMS} * total + TWO * FIRST * finest +
                       (TWO * FIRST + TERMS) * sizes.cells[1] + TWO * FIRST * RESPONSES);
  return sizes;
}

static void fillFineKernel(const VolumeState& volume,
                           const std::vector<const TransportPhase*>& phases,
                           const std::vector<double>& weights, TransportMedia& media) {
  for (uint32_t i = 0; i < volume.fieldCount; ++i) {
    const TransportPhase& phase = *phases[i];
    const std::array<double, RGB> albedo = volume.fields[i].medium.scaledAlbedo();
    size_t at = 0;
    for (size_t n = 0; n < FINE_NODES; ++n) {
      const double half = static_cast<double>(n) / (FINE_NODES - 1);
      const double y = 2 * half * half;
      while (at + 2 < phase.y.size() && phase.y[at + 1] < y) {
        ++at;
      }
      const double step = phase.y[at + 1] - phase.y[at];
      const double part = step > 0 ? std::clamp((y - phase.y[at]) / step, 0.0, 1.0) : 0.0;
      for (size_t c = 0; c < RGB; ++c) {
        const double rest = phase.rest[c][at] + part * (phase.rest[c][at + 1] - phase.rest[c][at]);
        const double scale = albedo[c] * (1 - phase.peak) / (1 - media.peak);
        media.fineKernel[n][static_cast<int>(c)] += weights[i] * scale * rest;
      }
    }
  }
  removeLowDegrees(media.fineKernel);
}

TransportMedia transportMedia(const VolumeState& volume) {
  TransportMedia media;
  media.shares = fieldShares(volume);
  media.turned = stepOfTurned(turnedShare(volume));
  const std::vector<double> weights = fieldWeights(volume, media.shares);
  std::vector<const TransportPhase*> phases;
  for (uint32_t i = 0; i < volume.fieldCount; ++i) {
    const FieldState& field = volume.fields[i];
    phases.push_back(&field.tables->own.transport(*field.medium.particle));
    media.peak += weights[i] * meanAlbedo(field) * phases[i]->peak;
  }
  // Of a phase function that is all peak something is left to divide by.
  media.peak = std::min(media.peak, 0.99);
  std::vector<const TransportPhase*> mixed;  // of `parts` each
  std::vector<double> parts;
  for (uint32_t i = 0; i < volume.fieldCount; ++i) {
    const FieldState& field = volume.fields[i];
    const double turned = stepOfTurned(turnedOf(media.turned, phases[i]->peak, media.peak));
    mixed.insert(mixed.end(), {phases[i], &field.tables->own.turned(*field.medium.particle)});
    parts.insert(parts.end(), {weights[i] * (1 - turned), weights[i] * turned});
  }
  for (uint32_t i = 0; i < volume.fieldCount; ++i) {
    const double f = phases[i]->peak;
    const TransportPhase& many = *mixed[2 * i + 1];
    const double turned = weights[i] > 0 ? parts[2 * i + 1] / weights[i] : media.turned;
    const double albedo = meanAlbedo(volume.fields[i]);
    const double fourth = std::lerp(phases[i]->fourth, many.fourth, turned);
    media.fieldFourth[static_cast<int>(i)] =
        static_cast<float>((albedo * (f + (1 - f) * fourth) - media.peak) / (1 - media.peak));
    for (int l = 0; l < TRANSPORT_MOMENTS; ++l) {
      const auto degree = static_cast<size_t>(l);
      const double rest = std::lerp(phases[i]->moments[degree], many.moments[degree], turned);
      const double moment = f + (1 - f) * rest;
      media.fieldMoments[i][l] =
          static_cast<float>((albedo * moment - media.peak) / (1 - media.peak));
      for (int c = 0; c < 3; ++c) {
        const double own = volume.fields[i].medium.scaledAlbedo()[static_cast<size_t>(c)];
        media.colorMoments[i][static_cast<size_t>(l)][c] =
            static_cast<float>((own * moment - media.peak) / (1 - media.peak));
      }
    }
  }
  fillFineKernel(volume, phases, weights, media);
  const bool alone = volume.fieldCount == 1;
  const TransportPairs several = alone ? TransportPairs{} : transportPairs(mixed, parts);
  const FieldState& first = volume.fields[0];
  const TransportPairs& pairs =
      alone ? first.tables->own.pairs(*first.medium.particle, parts[1]) : several;
  for (size_t l = 0; l < TRANSPORT_MOMENTS; ++l) {
    for (size_t k = 0; k < TRANSPORT_FIRST; ++k) {
      const auto& once = pairs.first[l][k];
      const auto& twice = pairs.second[l][k];
      media.products[l * TRANSPORT_FIRST + k] = {once[0], once[1], once[2], 0};
      media.products[12 + l * TRANSPORT_FIRST + k] = {twice[0], twice[1], twice[2], 0};
    }
  }
  media.response = pairs.response;
  media.response.insert(media.response.end(), pairs.once.begin(), pairs.once.end());
  return media;
}

double mediaChange(const VolumeState& volume) {
  const TransportMedia& media = *volume.transport;
  const double turned = turnedShare(volume);
  // Of one in which nothing is any more the media stay.
  const bool same = stepOfTurned(turned) == media.turned || isEmpty(volume);
  double most = same ? 0.0 : std::abs(turned - media.turned);
  if (volume.fieldCount == 1) {
    return most;
  }
  const std::array<double, WLK_MAX_FIELDS> now = fieldShares(volume);
  for (uint32_t i = 0; i < volume.fieldCount; ++i) {
    most = std::max(most, std::abs(now[i] - media.shares[i]));
  }
  return most;
}

float extinctionAtOne(const FieldState& field) {
  const bool present = field.external.has_value() || field.image;
  return present ? field.extinctionScale * static_cast<float>(field.medium.extinctionFactor())
                 : 0.0f;
}

float transportTaps(const VolumeState& volume, const TransportShape& shape) {
  double voxels = 1;
  for (int i = 0; i < 3; ++i) {
    const auto axis = static_cast<size_t>(i);
    voxels = std::max(voxels, volume.size[axis] * shape.size[i] / (2.0 * shape.cells[axis]));
  }
  return static_cast<float>(std::clamp(std::ceil(voxels - 0.01), 1.0, 4.0));
}

void fillTransport(const VolumeState& volume, const glm::dvec3& toLight,
                   const TransportShape& shape, TransportUniforms& out) {
  out = {};
  const glm::dmat3 box(volume.worldFromBox);
  const glm::dmat3 boxFromWorld = glm::inverse(box);
  const TransportSizes sizes = transportSizes(shape.cells);
  const glm::dvec3 travel = -toLight;
  TransportFan fan;
  if (shape.layer) {
    fan = layerFan(*volume.transport, box, shape, travel, out);
  } else {
    fan = cubeFan(*volume.transport, box, shape, travel, out);
  }
  int place = 0;
  for (int level = 0; level < LEVELS; ++level) {
    const int count = static_cast<int>(sizes.cells[static_cast<size_t>(level)]);
    for (int i = 0; i < 3; ++i) {
      out.size[level][i] = static_cast<int>(shape.cells[static_cast<size_t>(i)] >> level);
    }
    out.size[level].w = count;
    const uint32_t directions = transportDirections(static_cast<uint32_t>(level), shape);
    out.place[level] = {place, static_cast<int>(directions), 0, 0};
    place += count;
    for (size_t d = 0; d < directions; ++d) {
      out.directions[static_cast<size_t>(level) * DIRECTIONS + d] = transportDirection(
          transportCellsFromWorld(boxFromWorld, shape, 1.0 / (1 << level)), fan.direction[d],
          directions == TransportQuadrature::COARSE ? fan.coarse[d] : fan.fine[d]);
    }
  }
  out.light = transportDirection(transportCellsFromWorld(boxFromWorld, shape, 2.0), travel, 1);
  const TransportMedia& media = *volume.transport;
  std::copy(media.products.begin(), media.products.end(), out.products);
  for (int i = 0; i < 3; ++i) {
    out.worldFromBox[i] = glm::vec4(glm::vec3(box[i]), 0);
  }
  for (uint32_t i = 0; i < volume.fieldCount; ++i) {
    out.extinctionScale[static_cast<int>(i)] = extinctionAtOne(volume.fields[i]);
    out.fieldMoments[i] = media.fieldMoments[i];
  }
  out.fieldFourth = media.fieldFourth;
  out.gridOrigin = glm::vec4(glm::vec3(shape.origin), 0);
  out.gridSize = glm::vec4(glm::vec3(shape.size), 0);
  out.peak = {static_cast<float>(1 - media.peak), transportTaps(volume, shape), 0, 0};
  fillBricks(volume, out);
}

}  // namespace welkin
