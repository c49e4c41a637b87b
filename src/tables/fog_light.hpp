// SPDX-License-Identifier: MIT
// What fog scatters of light that was scattered or reflected before, per unit irradiance of the
// light: the integral of its phase function, without the eye's part of its peak, times radiance,
// 1/sr. By altitude, sun and direction, for every camera; from FogSlab, as if the planet were flat
// but for the light's own way. No Vulkan.
#pragma once

#include <array>
#include <vector>

#include "model/evaluate.hpp"
#include "tables/fog_slab.hpp"

namespace welkin {

struct FogLightInput {
  // As the eye sees it: without the share of the 16th Legendre moment of the fog's scattering.
  AirInput air;
  // The fog's moments 0 to 15 without that share, RGB.
  std::array<FogTermsOf, 3> terms{};
  std::array<double, 3> groundAlbedo{};
  double lightAngularRadius = 0.00466;
};

class FogLight {
 public:
  // Between nodes the table is linear, divided by lobe(): that leaves 2 % about the sun.
  static constexpr size_t SUNS = 21;  // times heights: an image's depth is at most 256 everywhere
  static constexpr size_t HEIGHTS = 12;
  static constexpr size_t AZIMUTHS = 16;
  static constexpr size_t VIEWS = 32;
  static constexpr size_t LANES = 4;  // RGB and nothing, as images have them
  static constexpr size_t VALUES = SUNS * HEIGHTS * AZIMUTHS * VIEWS * LANES;

  // A direction that is looked at, from some altitude, m: by its cosine with the up, that of its
  // azimuth against the light's, and its cosine with the light. Suns below the horizon: as on it.
  struct Direction {
    double viewMu;
    double azimuth;
    double viewSun;
  };
  std::array<double, 3> sourceAt(double altitude, double sunMu, const Direction& view) const;

  // Coordinates of the table, 0 to 1: of altitudes by the fog above, of suns dense at the horizon,
  // of azimuths at the light's.
  double heightCoordinate(double altitude) const;
  static double sunCoordinate(double mu);
  static double viewCoordinate(double mu);
  static double azimuthCoordinate(double cosine);
  // The light's own direction is brighter by about this much.
  double lobe(double viewSun) const;
  // Of the fog, vertically; what lobe() is made of.
  double depth() const { return depth_; }
  double asymmetry() const { return asymmetry_; }
  // Where its nodes are: cosines of the sun and of the view with the up, and the azimuth.
  static double sunAt(size_t sun);
  static double viewAt(size_t view);
  static double azimuthAt(size_t azimuth);
  // [sun][height][azimuth][view][lane], over lobe().
  const std::vector<float>& table() const { return table_; }

 private:
  friend class FogLightSolver;

  double asymmetry_ = 0;
  double scaleHeight_ = 1;
  double depth_ = 0;
  std::vector<float> table_;  // empty without fog
};

}  // namespace welkin
