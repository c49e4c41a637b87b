// SPDX-License-Identifier: MIT
#include "bench/error_gate_cases.hpp"

#include <map>

namespace bench {

std::vector<Case> gateCases() {
  return readCases(WELKIN_BENCH_FOLDER "/front_cases.json");
}

const GateCase& gateCase(const Case& one) {
  static std::map<std::string, GateCase> cases;
  const auto [found, isNew] = cases.try_emplace(one.name);
  GateCase& gate = found->second;
  if (isNew) {
    gate.references = readReferences(WELKIN_BENCH_FOLDER "/reference", one);
    gate.levels = measureLevels(one, gate.references, one.ultraInTests);
  }
  return gate;
}

}  // namespace bench
