// SPDX-License-Identifier: MIT
// Multiple scattering of sky light as game engines approximate it, for comparison only: S. Hillaire
// 2020, A Scalable and Production Ready Sky and Atmosphere Rendering Technique (EGSR). Every
// scattering but the last is isotropic and sees the same light everywhere, so that the orders are a
// geometric series of one transfer factor. Radiance per unit irradiance of the light, 1/sr.
//
// Its best case: double precision, optical depths of the light without a table, once-scattered
// light is the caller's and exact.
#pragma once

#include <vector>

#include "tables/sky_field.hpp"

namespace bench {

class IsotropicSky {
 public:
  // The published sizes.
  static constexpr int NODES = 32;  // altitudes, and cosines of the sun
  static constexpr int DIRECTIONS = 8;
  static constexpr int STEPS = 20;

  // Of the fog's moments only the first is used, see groundLight.
  explicit IsotropicSky(const welkin::SkyFieldInput& input);

  // Light scattered or reflected at least twice; as SkyField::radianceAlong.
  welkin::SkyColor radianceAlong(double altitude, double viewMu, double sunMu, double viewSun,
                                 double distance, int steps = 48) const;

 private:
  // Mean radiance at a point, over all directions, of light scattered or reflected at least once.
  welkin::SkyColor meanAt(double altitude, double sunMu) const;
  welkin::SkyColor solveNode(double altitude, double sunMu) const;
  welkin::SkyColor airLight(double altitude, double viewMu, double sunMu, double viewSun,
                            double distance, int steps, welkin::SkyColor& depth) const;
  welkin::SkyColor groundLight(double sunMu) const;

  welkin::SkyFieldInput input_;
  std::vector<welkin::SkyColor> table_;  // [altitude][sun]
};

}  // namespace bench
