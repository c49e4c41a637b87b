// SPDX-License-Identifier: MIT
#include "tables/surface_source.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/model.hpp"

namespace welkin {
namespace {

using namespace model::f64;

// Every how many nodes of the canonical table one is kept: all where its logarithm bends most.
constexpr size_t EVERY = 3;
constexpr size_t EVERY_AZIMUTH = 4;
// J / S of the table stays above 0 by its errors alone where S falls steeply along the ray.
constexpr double LEAST_CHANGE = 0.02;

constexpr auto DEPTHS = static_cast<size_t>(SOURCE_DEPTHS);
constexpr auto THICKNESSES = static_cast<size_t>(SOURCE_THICKNESSES);
constexpr auto LIGHTS = static_cast<size_t>(SOURCE_LIGHTS);
constexpr auto VIEWS = static_cast<size_t>(SOURCE_VIEWS);
constexpr auto AZIMUTHS = static_cast<size_t>(SOURCE_AZIMUTHS);

static_assert(DEPTHS == RADIANCE_GRID.depth);
static_assert(THICKNESSES == RADIANCE_GRID.thickness);
static_assert((LIGHTS - 1) * EVERY + 1 == RADIANCE_GRID.light);
static_assert((VIEWS - 1) * EVERY + 1 == RADIANCE_GRID.mu);
static_assert((AZIMUTHS - 1) * EVERY_AZIMUTH + 1 == RADIANCE_GRID.phi);

// A node of the image but for its depth, in nodes of the canonical table.
struct Node {
  size_t mu, phi, thickness, light;
};

double partOf(size_t node, size_t count) {
  return static_cast<double>(node) / static_cast<double>(count - 1);
}

// Inverse of canonicalDepth, by halving.
double depthAt(double coordinate, double thickness) {
  double low = 0;
  double high = thickness;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (canonicalDepth(middle, thickness) < coordinate ? low : high) = middle;
  }
  return (low + high) / 2;
}

// d(canonicalDepth)/d(depth).
double depthSlope(double depth, double thickness) {
  return 0.5 * (1 / (CANONICAL_FACE + depth) + 1 / (CANONICAL_FACE + thickness - depth)) /
         canonicalSpread(thickness);
}

// ln S at every depth of the canonical table.
std::array<double, RADIANCE_GRID.depth> logSources(const CanonicalMatrix& matrix,
                                                   const Node& node) {
  std::array<double, RADIANCE_GRID.depth> result{};
  const size_t row = node.mu * RADIANCE_GRID.phi + node.phi;
  for (size_t d = 0; d < RADIANCE_GRID.depth; ++d) {
    const size_t column =
        (node.thickness * RADIANCE_GRID.depth + d) * RADIANCE_GRID.light + node.light;
    double value = static_cast<double>(matrix.column[0][column]);
    for (size_t k = 0; k < matrix.row.size(); ++k) {
      value += static_cast<double>(matrix.row[k][row]) *
               static_cast<double>(matrix.column[k + 1][column]);
    }
    result[d] = value;
  }
  return result;
}

// Slope of even samples, of second order at the ends too; per node.
double slopeAt(const std::array<double, RADIANCE_GRID.depth>& f, size_t i) {
  if (i == 0) {
    return (-3 * f[0] + 4 * f[1] - f[2]) / 2;
  }
  const size_t last = f.size() - 1;
  return i == last ? (3 * f[last] - 4 * f[last - 1] + f[last - 2]) / 2 : (f[i + 1] - f[i - 1]) / 2;
}

// The depths of a thickness.
struct DepthNodes {
  double thickness = 0;
  std::array<double, DEPTHS> depth{};
  std::array<double, DEPTHS> perNode{};  // d(node)/d(depth)
};

std::vector<DepthNodes> depthNodes() {
  std::vector<DepthNodes> all(THICKNESSES);
  for (size_t t = 0; t < THICKNESSES; ++t) {
    DepthNodes& nodes = all[t];
    nodes.thickness = CANONICAL_THINNEST * std::pow(CANONICAL_THICKEST / CANONICAL_THINNEST,
                                                    partOf(t, RADIANCE_GRID.thickness));
    for (size_t d = 0; d < DEPTHS; ++d) {
      nodes.depth[d] = depthAt(partOf(d, RADIANCE_GRID.depth), nodes.thickness);
      nodes.perNode[d] = depthSlope(nodes.depth[d], nodes.thickness) * (RADIANCE_GRID.depth - 1);
    }
  }
  return all;
}

// J = S (1 + (1 - e^-length) d(ln S)/ds), since T = S (1 - e^-length) and J = T + dT/ds.
void writeColumn(const CanonicalMatrix& matrix, const Node& node, const DepthNodes& nodes, bool up,
                 float* out) {
  const double root = std::sqrt(CANONICAL_COSINE);
  const double cosine = root + partOf(node.mu, RADIANCE_GRID.mu) * (1 - root);
  const double mu = (up ? -1 : 1) * cosine * cosine;
  const std::array<double, RADIANCE_GRID.depth> logS = logSources(matrix, node);
  for (size_t d = 0; d < DEPTHS; ++d) {
    const double length = canonicalLength(nodes.depth[d], nodes.thickness, mu);
    const double change = 1 + oneMinusExp(length) * mu * nodes.perNode[d] * slopeAt(logS, d);
    out[d] = static_cast<float>(logS[d] + std::log(std::max(change, LEAST_CHANGE)));
  }
}

size_t placeOf(const std::array<size_t, 3>& size, size_t set, size_t view, size_t azimuth,
               size_t thickness, size_t light) {
  return ((set * LIGHTS + light) * size[1] + azimuth * THICKNESSES + thickness) * size[0] +
         view * DEPTHS;
}

// Two nodes around a coordinate, and the second one's weight.
struct Pair {
  size_t node;
  double weight;
};

Pair pairAt(double coordinate, size_t count) {
  const double low = std::clamp(std::floor(coordinate), 0.0, static_cast<double>(count - 2));
  return {static_cast<size_t>(low), coordinate - low};
}

}  // namespace

SurfaceSource surfaceSource(const CanonicalTable& table) {
  SurfaceSource source;
  source.size = {DEPTHS * VIEWS * 2, THICKNESSES * AZIMUTHS, LIGHTS * CANONICAL_SETS};
  source.values.resize(source.size[0] * source.size[1] * source.size[2]);
  const std::vector<DepthNodes> nodes = depthNodes();
  for (size_t i = 0; i < source.values.size() / DEPTHS; ++i) {
    size_t rest = i;
    const auto take = [&rest](size_t count) {
      const size_t digit = rest % count;
      rest /= count;
      return digit;
    };
    const size_t view = take(VIEWS * 2);
    const size_t thickness = take(THICKNESSES);
    const size_t azimuth = take(AZIMUTHS);
    const size_t light = take(LIGHTS);
    const bool up = view >= VIEWS;
    writeColumn(table.at(CanonicalPart::Radiance, rest, up),
                {view % VIEWS * EVERY, azimuth * EVERY_AZIMUTH, thickness, light * EVERY},
                nodes[thickness], up, &source.values[i * DEPTHS]);
  }
  for (const auto& curve : table.logPhase) {
    source.logPhase.insert(source.logPhase.end(), curve.begin(), curve.end());
  }
  return source;
}

SurfaceSourceImage surfaceSourceImage(const SurfaceSource& source) {
  SurfaceSourceImage image;
  image.size = {static_cast<size_t>(SOURCE_SIZE.x), static_cast<size_t>(SOURCE_SIZE.y),
                static_cast<size_t>(SOURCE_SIZE.z)};
  image.values.reserve(4 * image.size[0] * image.size[1] * image.size[2]);
  for (size_t i = 0; i < image.size[0] * image.size[1] * image.size[2]; ++i) {
    const size_t x = i % image.size[0];
    const size_t y = i / image.size[0] % image.size[1];
    const size_t z = i / image.size[0] / image.size[1];
    const size_t side = x / DEPTHS;  // views of the lower hemisphere, then of the upper one
    const size_t view = side + side / (VIEWS - 1);
    for (size_t k = 0; k < 4; ++k) {
      const size_t row = placeOf(source.size, z / LIGHTS, view + k % 2, y / THICKNESSES + k / 2,
                                 y % THICKNESSES, z % LIGHTS);
      image.values.push_back(source.values[row + x % DEPTHS]);
    }
  }
  for (size_t i = 0; i < source.logPhase.size(); ++i) {
    const size_t set = i / (4 * CANONICAL_ANGLES) * 4 + i % 4;
    image.logPhase.push_back(source.logPhase[set * CANONICAL_ANGLES + i / 4 % CANONICAL_ANGLES]);
  }
  return image;
}

double surfaceSourceAt(const SurfaceSource& source, size_t set, const SurfaceSlabPoint& point) {
  const TangentSlab slab = {point.thickness, point.depth, point.muLight, point.muView, point.phi};
  const SourcePlace place = sourcePlace(static_cast<int>(set), slab);
  const std::array<Pair, 5> at = {pairAt(place.node.x, DEPTHS), pairAt(place.node.y, THICKNESSES),
                                  pairAt(place.node.z, LIGHTS), pairAt(place.view, VIEWS),
                                  pairAt(place.azimuth, AZIMUTHS)};
  double value = 0;
  for (unsigned corner = 0; corner < 32; ++corner) {
    std::array<size_t, 5> node{};
    double weight = 1;
    for (size_t k = 0; k < 5; ++k) {
      const bool second = (corner >> k & 1U) != 0;
      node[k] = at[k].node + (second ? 1 : 0);
      weight *= second ? at[k].weight : 1 - at[k].weight;
    }
    const size_t row =
        placeOf(source.size, set, node[3] + (place.up ? VIEWS : 0), node[4], node[1], node[2]);
    value += weight * static_cast<double>(source.values[row + node[0]]);
  }
  const double sines = std::sqrt((1 - point.muView) * (1 + point.muView) * (1 - point.muLight) *
                                 (1 + point.muLight));
  const double cosine =
      std::clamp(point.muView * point.muLight + sines * std::cos(point.phi), -1.0, 1.0);
  const Pair angle = pairAt(std::acos(cosine) * 180 / std::numbers::pi, CANONICAL_ANGLES);
  const float* const curve = &source.logPhase[set * CANONICAL_ANGLES + angle.node];
  const double logPhase = static_cast<double>(curve[0]) * (1 - angle.weight) +
                          static_cast<double>(curve[1]) * angle.weight;
  return sourceRadiance(value + place.outside, logPhase, slab.muLight, 1.0);
}

}  // namespace welkin
