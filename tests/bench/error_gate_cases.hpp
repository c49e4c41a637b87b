// SPDX-License-Identifier: MIT
// The benchmark's cases with what the levels' pictures of them are worth: measured once, for the
// tests of the contract and of the error estimate.
#pragma once

#include <vector>

#include "bench/front_contract.hpp"

namespace bench {

struct GateCase {
  References references;
  std::vector<Measured> levels;
};

std::vector<Case> gateCases();

/// Renders when first asked for; without level ultra where the case is left out of it.
const GateCase& gateCase(const Case& one);

}  // namespace bench
