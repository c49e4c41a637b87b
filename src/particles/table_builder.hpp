// SPDX-License-Identifier: MIT
// Makes the shipped phase tables from Mie theory and from ray-traced ice. No Vulkan. Not part of
// the library: the program welkin_tables writes src/particles/tables from it, and a test recomputes
// some of it.
#pragma once

#include <string>
#include <vector>

#include "particles/phase_table.hpp"

namespace welkin {

// What is tabulated, before it is rounded to 16 bits.
struct TableDraft {
  std::string name;
  Features features = Features::None;
  std::vector<double> knot;       // rad
  std::vector<double> axis;       // ln(diameter in um), or roughness
  std::vector<double> logPhase;   // [axis][channel][knot]
  std::vector<double> asymmetry;  // [axis][channel], as the next two
  std::vector<double> efficiency;
  std::vector<double> delta;
};

// Name, features, knots and axis of each shipped table; nothing computed yet.
enum class TableKind { Haze, Droplet, Rain, IceColumn, IcePlate, Snow };
constexpr TableKind TABLE_KINDS[] = {TableKind::Haze,      TableKind::Droplet,  TableKind::Rain,
                                     TableKind::IceColumn, TableKind::IcePlate, TableKind::Snow};
TableDraft emptyDraft(TableKind kind);

// Computes the channel of the columns [first, end) of the axis into the draft.
void computeColumns(TableKind kind, TableDraft& draft, size_t first, size_t end, size_t channel,
                    unsigned threads);

// A draft in 16 bits, with memory of its own.
struct StoredTable {
  std::string name;
  Features features = Features::None;
  std::vector<float> knot, axis, asymmetry, efficiency, delta;
  float logMin = 0;
  float logStep = 0;
  std::vector<uint16_t> code;
  PhaseTable view() const;
  size_t bytes() const;
};
StoredTable store(const TableDraft& draft);

}  // namespace welkin
