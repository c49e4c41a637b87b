// SPDX-License-Identifier: MIT
// Makes the shipped table of canonical slab transport from the solver. No Vulkan. Not part of the
// library: the program welkin_canonical writes src/tables/canonical from it, and a test recomputes
// some of it.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "tables/canonical_phase.hpp"
#include "tables/canonical_table.hpp"

namespace welkin {

constexpr size_t CANONICAL_TERMS = 64;  // Legendre terms of the solution

// What the matrices of one part hold, [set][up][row][column], before they are compressed.
struct CanonicalDraft {
  std::array<std::vector<float>, CANONICAL_PARTS> value;
  std::vector<float> weight;  // [set][up][column] of the radiance: largest over the rows
};
CanonicalDraft emptyCanonicalDraft();

// Nodes of the radiance's grid; the collector's are every second.
double canonicalNodeThickness(size_t i);
double canonicalNodeDepth(size_t i, double thickness);
double canonicalNodeCosine(size_t i, size_t count);

// ln P of each set: the phase function of its lowest order, light scattered that often in no slab.
void canonicalPhaseCurves(const std::vector<double>& moments, CanonicalTable& table);

// Solves one thickness into the draft; `table` has the phase curves. 2 to 6 s.
void computeCanonical(size_t thickness, const std::vector<double>& moments,
                      const CanonicalTable& table, CanonicalDraft& draft);

// Ranks are as low as the error allows, at most this.
constexpr size_t CANONICAL_MOST = 28;
void compressCanonical(const CanonicalDraft& draft, CanonicalTable& table);

}  // namespace welkin
