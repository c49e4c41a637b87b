// SPDX-License-Identifier: MIT
// A ray through air and fog in steps, and the frame of the moments along it. m.
#pragma once

#include <memory_resource>

#include "tables/sky_table.hpp"

namespace welkin {

// Where a ray through the layers is sampled, and what scattered light from there counts.
struct SkyStep {
  float distance;
  float radius;
  double altitude;
  SkyNode high;
  Lanes air;  // scattering optical depth of the step, attenuated
  Lanes fog;
};

struct SkyRay {
  std::pmr::vector<SkyStep> steps;
  double ground = -1;  // distance
  Lanes atGround{};    // transmittance to there
};

// Through `air` from an altitude, seen under the cosine viewMu to the up, over at most `distance`.
// Allocates nothing if `plan.steps` has room for `count`.
void planRay(const AirInput& air, const SkyAxes& axes, double altitude, double viewMu,
             double distance, int count, SkyRay& plan);

// A ray at its origin, as far as it does not depend on the place.
struct SkyAim {
  float radius;  // of the origin, m
  float viewMu;
  float sunMu;
  float viewSun;
};

// The frame of the moments at a distance along a ray.
struct SkyPlace {
  float sunMu;
  SkyDirection view;
};

SkyPlace placeAt(const SkyAim& aim, const SkyStep& step);

}  // namespace welkin
