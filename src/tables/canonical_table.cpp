// SPDX-License-Identifier: MIT
#include "tables/canonical_table.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "model/model.hpp"

namespace welkin {
namespace {

using namespace model::f64;

constexpr size_t FINE = 2;  // vectors v_k in 16 bits
// Of light of many orders: depth behind a face at which a thick slab's light would vanish.
constexpr double EXTRAPOLATION = 0.71;

// Four nodes and their weights along one axis.
struct Stencil {
  std::array<size_t, 4> node;
  std::array<double, 4> weight;
};

Stencil stencilAt(double coordinate, size_t count) {
  const double x = std::clamp(coordinate, 0.0, 1.0) * static_cast<double>(count - 1);
  const size_t first = std::min(static_cast<size_t>(std::max(std::floor(x) - 1, 0.0)), count - 4);
  const vec4 w = canonicalCubic(x - static_cast<double>(first) - 1);
  return {{first, first + 1, first + 2, first + 3}, {w.x, w.y, w.z, w.w}};
}

// Azimuths 0 .. pi, mirrored at both ends with this sign.
Stencil azimuthAt(double phi, size_t count, double sign) {
  const double turn = std::abs(std::remainder(phi, 2 * std::numbers::pi)) / std::numbers::pi;
  const double x = std::min(turn, 1.0) * static_cast<double>(count - 1);
  const double low = std::min(std::floor(x), static_cast<double>(count - 2));
  const vec4 w = canonicalCubic(x - low);
  Stencil result = {{}, {w.x, w.y, w.z, w.w}};
  const auto last = static_cast<int>(count) - 1;
  for (int i = 0; i < 4; ++i) {
    int node = static_cast<int>(low) + i - 1;
    const auto k = static_cast<size_t>(i);
    if (node < 0 || node > last) {
      node = node < 0 ? -node : 2 * last - node;
      result.weight[k] *= sign;
    }
    result.node[k] = static_cast<size_t>(node);
  }
  return result;
}

double interpolate(const CanonicalMatrix& matrix, const CanonicalGrid& grid,
                   const CanonicalPoint& at, double sign) {
  const Stencil mu = stencilAt(canonicalCosine(std::abs(at.mu)), grid.mu);
  const Stencil phi = azimuthAt(at.phi, grid.phi, sign);
  const Stencil t = stencilAt(canonicalThickness(at.thickness), grid.thickness);
  const Stencil d = stencilAt(canonicalDepth(at.depth, at.thickness), grid.depth);
  const Stencil light = stencilAt(canonicalCosine(at.muLight), grid.light);
  double value = 0;
  for (size_t k = 0; k < matrix.column.size(); ++k) {
    double row = 0;
    for (size_t i = 0; i < 16; ++i) {
      const double w = mu.weight[i / 4] * phi.weight[i % 4];
      row += w * (k == 0 ? 1
                         : static_cast<double>(
                               matrix.row[k - 1][mu.node[i / 4] * grid.phi + phi.node[i % 4]]));
    }
    double column = 0;
    for (size_t i = 0; i < 16; ++i) {
      const double w = t.weight[i / 4] * d.weight[i % 4];
      const float* const v =
          &matrix.column[k][(t.node[i / 4] * grid.depth + d.node[i % 4]) * grid.light];
      for (size_t j = 0; j < 4; ++j) {
        column += w * light.weight[j] * static_cast<double>(v[light.node[j]]);
      }
    }
    value += row * column;
  }
  return value;
}

class Writer {
 public:
  std::vector<uint32_t> words;
  void put(uint32_t value, unsigned bits) {
    if (free_ < bits) {
      words.push_back(0);
      free_ = 32;
    }
    free_ -= bits;
    words.back() |= (value & (bits < 32 ? (1U << bits) - 1 : ~0U)) << free_;
  }
  void align() { free_ = 0; }

 private:
  unsigned free_ = 0;
};

class Reader {
 public:
  explicit Reader(std::span<const uint32_t> words) : words_(words) {}
  uint32_t get(unsigned bits) {
    if (free_ < bits) {
      word_ = words_[next_++];
      free_ = 32;
    }
    free_ -= bits;
    return word_ >> free_ & (bits < 32 ? (1U << bits) - 1 : ~0U);
  }
  void align() { free_ = 0; }

 private:
  std::span<const uint32_t> words_;
  size_t next_ = 0;
  uint32_t word_ = 0;
  unsigned free_ = 0;
};

void putVector(const std::vector<float>& values, unsigned bits, Writer& out) {
  float largest = 0;
  for (const float value : values) {
    largest = std::max(largest, std::abs(value));
  }
  const auto most = static_cast<float>((1U << (bits - 1)) - 1);
  const float step = largest > 0 ? largest / most : 1;
  out.align();
  out.put(std::bit_cast<uint32_t>(step), 32);
  for (const float value : values) {
    out.put(static_cast<uint32_t>(static_cast<int32_t>(std::lround(value / step))), bits);
  }
  out.align();
}

std::vector<float> getVector(size_t count, unsigned bits, Reader& in) {
  in.align();
  const float step = std::bit_cast<float>(in.get(32));
  std::vector<float> values(count);
  for (float& value : values) {
    const auto code = static_cast<int32_t>(in.get(bits) << (32 - bits)) >> (32 - bits);
    value = static_cast<float>(code) * step;
  }
  in.align();
  return values;
}

const CanonicalGrid& gridOf(size_t matrix) {
  return matrix < CANONICAL_SETS * 2 ? RADIANCE_GRID : COLLECTOR_GRID;
}

}  // namespace

double canonicalLogPhase(const CanonicalTable& table, size_t set, double angle) {
  const Stencil at = stencilAt(angle / std::numbers::pi, CANONICAL_ANGLES);
  double value = 0;
  for (size_t i = 0; i < 4; ++i) {
    value += at.weight[i] * static_cast<double>(table.logPhase[set][at.node[i]]);
  }
  return value;
}

CanonicalTransport CanonicalTable::transport(size_t set, const CanonicalPoint& point) const {
  const bool up = point.mu < 0;
  const double depth = std::clamp(point.depth, 0.0, point.thickness);
  CanonicalPoint inside = point;
  const vec2 slab = canonicalInside(point.thickness, depth);
  inside.thickness = slab.x;
  inside.depth = std::clamp(slab.y, 0.0, slab.x);

  const double sines =
      std::sqrt((1 - point.mu) * (1 + point.mu) * (1 - point.muLight) * (1 + point.muLight));
  const double cosine =
      std::clamp(point.mu * point.muLight + sines * std::cos(point.phi), -1.0, 1.0);
  double logSource = interpolate(at(CanonicalPart::Radiance, set, up), RADIANCE_GRID, inside, 1) +
                     canonicalLogPhase(*this, set, std::acos(cosine));
  const double width =
      std::exp(interpolate(at(CanonicalPart::Width, set, up), COLLECTOR_GRID, inside, 1));
  double length = canonicalLength(depth, point.thickness, up ? -1.0 : 1.0);
  length /= std::max(std::abs(point.mu), 1e-6);
  double scale = 1;
  const bool diffuse = set + 1 == CANONICAL_SETS;
  if (point.thickness < inside.thickness) {
    // Each scattering but the first needs as much of the slab's depth.
    constexpr std::array<int, CANONICAL_SETS> FIRST = {2, 3, 5, 7, 9, 13, 19, 31};
    scale = point.thickness / inside.thickness;
    logSource += (FIRST[set] - 1) * std::log(scale);
  } else if (point.thickness > inside.thickness && diffuse) {
    // Light of many orders falls linearly to nothing behind the far face.
    const double behind = EXTRAPOLATION / (1 - asymmetry);
    const auto left = [&](double t, double d) { return (t - d + behind) / (t + 2 * behind); };
    logSource += std::log(left(point.thickness, depth) / left(inside.thickness, inside.depth));
    scale =
        std::clamp(depth / std::max(inside.depth, 1e-9), 1.0, point.thickness / inside.thickness);
  }
  CanonicalTransport result{};
  result.radiance = canonicalRadiance(logSource, 1.0, point.muLight, length);
  result.width = width * scale;
  result.x = result.width * interpolate(at(CanonicalPart::X, set, up), COLLECTOR_GRID, inside, 1);
  result.y = result.width * interpolate(at(CanonicalPart::Y, set, up), COLLECTOR_GRID, inside, -1);
  if (std::remainder(point.phi, 2 * std::numbers::pi) < 0) {
    result.y = -result.y;
  }
  return result;
}

std::vector<uint32_t> encodeCanonical(const CanonicalTable& table) {
  Writer out;
  out.put(std::bit_cast<uint32_t>(static_cast<float>(table.asymmetry)), 32);
  for (const auto& curve : table.logPhase) {
    putVector({curve.begin(), curve.end()}, 16, out);
  }
  for (const CanonicalMatrix& matrix : table.matrix) {
    out.align();
    out.put(static_cast<uint32_t>(matrix.row.size()), 32);
    for (const std::vector<float>& row : matrix.row) {
      putVector(row, 16, out);
    }
    for (size_t k = 0; k < matrix.column.size(); ++k) {
      putVector(matrix.column[k], k < FINE ? 16 : 8, out);
    }
  }
  return out.words;
}

CanonicalTable decodeCanonical(std::span<const uint32_t> words) {
  CanonicalTable table;
  Reader in(words);
  table.asymmetry = static_cast<double>(std::bit_cast<float>(in.get(32)));
  for (auto& curve : table.logPhase) {
    const std::vector<float> values = getVector(curve.size(), 16, in);
    std::copy(values.begin(), values.end(), curve.begin());
  }
  for (size_t i = 0; i < table.matrix.size(); ++i) {
    CanonicalMatrix& matrix = table.matrix[i];
    in.align();
    const uint32_t rank = in.get(32);
    for (uint32_t k = 0; k < rank; ++k) {
      matrix.row.push_back(getVector(gridOf(i).rows(), 16, in));
    }
    for (uint32_t k = 0; k <= rank; ++k) {
      matrix.column.push_back(getVector(gridOf(i).columns(), k < FINE ? 16 : 8, in));
    }
  }
  return table;
}

}  // namespace welkin
