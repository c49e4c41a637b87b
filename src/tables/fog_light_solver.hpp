// SPDX-License-Identifier: MIT
// Makes a FogLight a step at a time, so that an engine whose fog changes can spread the work over
// frames. No Vulkan.
#pragma once

#include <memory>

#include "tables/fog_light.hpp"

namespace welkin {

class FogLightSolver {
 public:
  // Allocates all memory that is needed; takes as long as some four steps.
  explicit FogLightSolver(const FogLightInput& input);
  FogLightSolver(FogLightSolver&&) noexcept;
  FogLightSolver& operator=(FogLightSolver&&) noexcept;
  ~FogLightSolver();

  // Of 0.5 to 2 ms each: an azimuth's equations of one colour, or that colour of one sun.
  static constexpr size_t STEPS = 3 * (FOG_TERMS + FogLight::SUNS);
  void advance();
  bool done() const;
  // Once, when done.
  FogLight take();

 private:
  class Maker;
  std::unique_ptr<Maker> maker_;
};

// Some 100 ms. Air without fog: nothing.
FogLight solveFogLight(const FogLightInput& input);

}  // namespace welkin
