// SPDX-License-Identifier: MIT
// The reference's planets and rays as arguments of the model text, in float and in double, and the
// error of a radiance. Dimensionless.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "model/model.hpp"
#include "reference/planet.hpp"
#include "support/tolerance.hpp"

namespace {

template <typename A, typename V, typename T>
A airOf(const welkin::reference::Planet& planet) {
  A air;
  air.planetRadius = static_cast<T>(planet.radius);
  air.airScattering =
      V(static_cast<T>(planet.airScattering[0]), static_cast<T>(planet.airScattering[1]),
        static_cast<T>(planet.airScattering[2]));
  air.airScaleHeight = static_cast<T>(planet.airScaleHeight);
  air.fogExtinction = static_cast<T>(planet.fogExtinction);
  air.fogBaseAltitude = static_cast<T>(planet.fogBaseAltitude);
  air.fogScaleHeight = static_cast<T>(planet.fogScaleHeight);
  air.fogAlbedo = V(static_cast<T>(planet.fogAlbedo[0]), static_cast<T>(planet.fogAlbedo[1]),
                    static_cast<T>(planet.fogAlbedo[2]));
  air.absorption = V(static_cast<T>(planet.absorption[0]), static_cast<T>(planet.absorption[1]),
                     static_cast<T>(planet.absorption[2]));
  air.absorberPeak = static_cast<T>(planet.absorberPeak);
  air.absorberWidth = static_cast<T>(planet.absorberWidth);
  return air;
}

inline welkin::model::f64::Air air64(const welkin::reference::Planet& planet) {
  namespace f64 = welkin::model::f64;
  return airOf<f64::Air, f64::vec3, double>(planet);
}
inline welkin::model::f32::Air air32(const welkin::reference::Planet& planet) {
  namespace f32 = welkin::model::f32;
  return airOf<f32::Air, f32::vec3, float>(planet);
}

inline welkin::model::f64::AirRay ray64(const welkin::reference::PlanetRay& ray) {
  welkin::model::f64::AirRay r;
  r.altitude = ray.altitude;
  r.viewMu = ray.viewMu;
  r.sunMu = ray.lightMu;
  r.viewSun = ray.viewLight;
  return r;
}

inline welkin::model::f32::AirRay ray32(const welkin::reference::PlanetRay& ray) {
  welkin::model::f32::AirRay r;
  r.altitude = static_cast<float>(ray.altitude);
  r.viewMu = static_cast<float>(ray.viewMu);
  r.sunMu = static_cast<float>(ray.lightMu);
  r.viewSun = static_cast<float>(ray.viewLight);
  return r;
}

// Rayleigh's phase function without depolarisation, 1/sr.
inline double airPhase(const welkin::reference::PlanetRay& ray) {
  return 3.0 / (16.0 * 3.14159265358979323846) * (1.0 + ray.viewLight * ray.viewLight);
}

// Largest relative error of a channel that exceeds `dark`, 0 if none does.
inline double radianceError(const welkin::model::f64::vec3& value,
                            const std::array<double, 3>& truth, double dark) {
  double error = 0.0;
  for (int i = 0; i < 3; ++i) {
    const double t = truth[static_cast<std::size_t>(i)];
    error = t > dark ? std::fmax(error, welkin::test::relativeError(value[i], t)) : error;
  }
  return error;
}

}  // namespace
