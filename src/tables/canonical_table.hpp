// SPDX-License-Identifier: MIT
// The canonical transport of light in a slab ([B08] section 5) as a table: radiance per unit
// irradiance on a surface facing the sun and where it came in, by sets of scattering orders, of the
// cloud of canonical_phase.hpp. Lengths and depths are optical, those without the forward peak. No
// Vulkan.
//
// Each set, hemisphere and quantity is a matrix of low rank, rows being view directions and columns
// (thickness, depth, light): value = v_0(column) + sum over k of u_k(row) v_k(column). What is
// stored of the radiance is the logarithm of canonical_slab.glsl; of the collector x / width, y /
// width and ln width.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace welkin {

constexpr size_t CANONICAL_SETS = 8;  // orders from 2, 3, 5, 7, 9, 13, 19, 31
constexpr size_t CANONICAL_ANGLES = 181;
enum class CanonicalPart : uint32_t { Radiance, X, Y, Width };
constexpr size_t CANONICAL_PARTS = 4;

// Nodes of a matrix: |cosine| and azimuth of the view, thickness, depth, light's cosine.
struct CanonicalGrid {
  size_t mu, phi, thickness, depth, light;
  size_t rows() const { return mu * phi; }
  size_t columns() const { return thickness * depth * light; }
};
constexpr CanonicalGrid RADIANCE_GRID = {13, 13, 23, 21, 13};
constexpr CanonicalGrid COLLECTOR_GRID = {7, 7, 12, 11, 7};

// As solved: [row] vectors u_k, k >= 1, and [column] vectors v_k, k >= 0.
struct CanonicalMatrix {
  std::vector<std::vector<float>> row;
  std::vector<std::vector<float>> column;
};

struct CanonicalPoint {
  double thickness;  // > 0
  double depth;      // [0, thickness]
  double mu;         // of the direction of travel, > 0 downwards, [-1, 1]
  double phi;        // its azimuth against the light's
  double muLight;    // (0, 1]
};

struct CanonicalTransport {
  double radiance;  // [B08] T
  double x, y;      // [B08] c, x along the light's horizontal way, seen from the point
  double width;     // [B08] sigma
};

class CanonicalTable {
 public:
  // [part][set][up], and ln P of each set at 0, 1, .. 180 degrees.
  std::array<CanonicalMatrix, CANONICAL_PARTS * CANONICAL_SETS * 2> matrix;
  std::array<std::array<float, CANONICAL_ANGLES>, CANONICAL_SETS> logPhase{};
  double asymmetry = 0;  // mean cosine of the phase function

  CanonicalMatrix& at(CanonicalPart part, size_t set, bool up) {
    return matrix[(static_cast<size_t>(part) * CANONICAL_SETS + set) * 2 + (up ? 1 : 0)];
  }
  const CanonicalMatrix& at(CanonicalPart part, size_t set, bool up) const {
    return const_cast<CanonicalTable*>(this)->at(part, set, up);
  }

  // Finite for every point in the ranges above. Errors: docs/models.md.
  CanonicalTransport transport(size_t set, const CanonicalPoint& point) const;
};

// ln P of a set at a scattering angle, rad.
double canonicalLogPhase(const CanonicalTable& table, size_t set, double angle);

// To and from the words that are shipped: 16 bits for v_0, v_1 and rows, 8 for the rest.
std::vector<uint32_t> encodeCanonical(const CanonicalTable& table);
CanonicalTable decodeCanonical(std::span<const uint32_t> words);

// src/tables/canonical/slab.bin.
std::span<const uint32_t> shippedCanonical();

}  // namespace welkin
