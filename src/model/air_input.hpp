// SPDX-License-Identifier: MIT
// The model's air of an AirInput. From .cpp files only, like the model.
#pragma once

#include "model/evaluate.hpp"
#include "model/model.hpp"

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
  air.absorption = model::f64::vec3(input.absorption[0], input.absorption[1], input.absorption[2]);
  // A layer that is not there must not move the top of the air.
  air.absorberPeak = input.absorbs() ? input.absorberPeak : 0;
  air.absorberWidth = input.absorbs() ? input.absorberWidth : 1;
  return air;
}

}  // namespace
}  // namespace welkin
