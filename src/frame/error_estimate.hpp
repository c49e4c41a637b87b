// SPDX-License-Identifier: MIT
// Estimate of a picture's relative radiance error from the scene and the quality: rules fitted to
// pictures of the Monte Carlo reference (docs/accuracy-and-performance.md). No Vulkan.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>

#include "frame/plan.hpp"
#include "model/evaluate.hpp"
#include "particles/catalogue.hpp"

namespace welkin {

// A volume as one body: of a box filled to the part `fill` (rest empty), all of one extinction.
struct ErrorVolume {
  glm::dmat4x3 worldFromBox{1.0};
  std::array<double, 3> voxels{1, 1, 1};
  double extinction = 0;  // of the body, 1/m, without the part of the light that goes straight on
  double fill = 1;        // (0, 1]
  double gap = 1;         // 1 - mean cosine of its phase function
  double albedo = 1;
};

struct ErrorInput {
  WlkPlanet planet{};
  AirInput air;          // what the view draws of it; 0 where it does not
  double fogGap = 1;     // 1 - mean cosine
  bool light = false;    // nothing is wrong in the dark
  bool ambient = false;  // volumes have light of sky and ground, or there is none
  glm::dvec3 toLight{0, 1, 0};
  double lightAngularRadius = 0;
  glm::dvec3 eye{0};
  glm::dmat4 eyeFromNdc{1.0};  // as ViewState
  SliceQuality quality{};
  std::span<const ErrorVolume> volumes;  // nearest first
};

// Parts by WLK_APPROXIMATION_*, in [0, 1]; their squares add up to that of the whole.
using ErrorParts = std::array<double, WLK_MAX_APPROXIMATIONS>;
ErrorParts estimateError(const ErrorInput& input);

// The whole error, in [0, 1], for each of `slabs` in place of the quality's; allocates nothing.
void estimateErrors(const ErrorInput& input, std::span<const uint32_t> slabs,
                    std::span<double> errors);

}  // namespace welkin
