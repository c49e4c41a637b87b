// SPDX-License-Identifier: MIT
// The model's air of an AirInput. Include after model/model.hpp, from .cpp files only.
#pragma once

#include "model/evaluate.hpp"

namespace welkin {
namespace {

inline model::f64::Air airFrom(const AirInput& input) {
  model::f64::Air air;
  air.planetRadius = input.planetRadius;
  air.airScattering =
      model::f64::vec3(input.airScattering[0], input.airScattering[1], input.airScattering[2]);
  air.airScaleHeight = input.airScaleHeight;
  air.fogExtinction = input.fogExtinction;
  air.fogBaseAltitude = input.fogBaseAltitude;
  air.fogScaleHeight = input.fogScaleHeight;
  air.fogAlbedo = model::f64::vec3(input.fogAlbedo[0], input.fogAlbedo[1], input.fogAlbedo[2]);
  return air;
}

}  // namespace
}  // namespace welkin
