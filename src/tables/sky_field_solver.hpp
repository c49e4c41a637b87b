// SPDX-License-Identifier: MIT
// Solves a SkyField a few rows at a time, so that an engine whose atmosphere changes can spread the
// work over frames. A row is one altitude of one order of scattering, for all suns and directions;
// rows of the first order take some 2.7 times as long as the others, the constructor as one. With
// fog, FogLightSolver::STEPS more rows follow, which take about as long.
#pragma once

#include <memory>

#include "tables/sky_field.hpp"

namespace welkin {

class SkyFieldSolver {
 public:
  // Allocates all memory that is needed.
  explicit SkyFieldSolver(const SkyFieldInput& input, const SkyFieldSteps& steps = {});
  SkyFieldSolver(SkyFieldSolver&&) noexcept;
  SkyFieldSolver& operator=(SkyFieldSolver&&) noexcept;
  ~SkyFieldSolver();

  // Does up to `rows` rows without allocating; true when done. How many it takes is known only
  // when the light of further orders no longer counts: SkyField::ALTITUDES for each order, 6 orders
  // in clear air, 28 in fog of 5 optical depths over snow.
  bool advance(size_t rows);
  bool done() const;
  // Done so far.
  size_t rows() const;
  const SkyFieldInput& input() const;
  // Once, when done.
  SkyField take();

 private:
  struct State;
  void finishOrder();

  std::unique_ptr<State> state_;
};

}  // namespace welkin
