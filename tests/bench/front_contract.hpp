// SPDX-License-Identifier: MIT
// What each quality level promises in each case: errors (no unit) and counts of one frame.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "bench/front_errors.hpp"
#include "bench/front_world.hpp"

namespace bench {

/// Errors may grow by this factor over the contract: a figure of another machine's floating-point
/// rounding stays within 1 %, the rest is room for changes that trade a little error for time.
constexpr double ERROR_TOLERANCE = 1.10;
/// Counts are exact; this is for a volume's cover that moves by a pixel.
constexpr double COUNT_TOLERANCE = 1.02;

struct Measured {
  /// {case, level, counts, errors}, as in the contract.
  Ordered row;
  /// Of the levels' own scattering; the others are the levels with forward scattering, whose slabs
  /// have a limit.
  bool isLevel = true;
  /// Relative RMS errors: against all orders, the reference's noise taken off, and against ever
  /// thinner slabs. No unit; NaN without such a reference.
  double truth = NAN;
  double slabs = NAN;
  WlkErrorEstimate estimate{};
};

/// A case's levels, rendered once each; without `ultra` that level is left out where it has light
/// of all orders to find.
std::vector<Measured> measureLevels(const Case& one, const References& references,
                                    bool ultra = true);

/// Level high without the light of sky and ground.
Measured measureBare(const Case& one, const References& references);

/// The picture that the levels converge to.
host::Image convergedPicture(const Case& one);

/// One sentence per figure of `measured` that is worse than `contract`, naming case, level and
/// figure. `contract` null: there is none for this row.
std::vector<std::string> violations(const Ordered& measured, const Ordered& contract);

/// Reads what welkin_front --write-contract wrote. Throws InputError.
Ordered readContract(const std::string& file);

/// The contract's row for the case and level of `measured`, or null.
Ordered findRow(const Ordered& contract, const Ordered& measured);

}  // namespace bench
