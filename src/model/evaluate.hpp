// SPDX-License-Identifier: MIT
// The sky model on the CPU in double precision, for the queries of the C API. Lengths in m.
#pragma once

namespace welkin {

// Air, fog layer and absorber; the fields of Air in shaders/model/sky/air.glsl. Zero scattering,
// extinction or absorption means that the species is absent; scale heights and widths are > 0 in
// any case.
struct AirInput {
  double planetRadius = 6.371e6;
  double airScattering[3] = {0, 0, 0};
  double airScaleHeight = 8000;
  double fogExtinction = 0;
  double fogBaseAltitude = 0;
  double fogScaleHeight = 100;
  double fogAlbedo[3] = {1, 1, 1};
  double absorption[3] = {0, 0, 0};
  double absorberPeak = 25000;
  double absorberWidth = 15000;

  bool absorbs() const { return absorption[0] > 0 || absorption[1] > 0 || absorption[2] > 0; }
  bool operator==(const AirInput&) const = default;
};

// Once-scattered radiance per unit irradiance of the light, and optical depth, along a ray of
// `distance` m (may be infinite; ends at the caller's surface). viewMu and sunMu are the cosines of
// view and light with the up at the origin, viewSun that between them, fogPhase RGB in 1/sr.
void evalAirRay(const AirInput& air, double altitude, double viewMu, double sunMu, double viewSun,
                double distance, const double fogPhase[3], double angularRadius, double radiance[3],
                double opticalDepth[3]);

// Optical depth along a ray of `distance` m (may be infinite); the planet is transparent.
void evalAirDepth(const AirInput& air, double altitude, double viewMu, double distance,
                  double opticalDepth[3]);

// Optical depth from a point to the light, and the fraction of the light's disk (half angle
// angularRadius, rad) that the planet leaves visible.
void evalLightDepth(const AirInput& air, double altitude, double lightMu, double angularRadius,
                    double opticalDepth[3], double* visibility);

// Distance to the sea-level sphere, -1 if the ray misses it.
double evalGroundDistance(double altitude, double viewMu, double planetRadius);

// Rayleigh phase function, 1/sr, at y = 1 - cos of the scattering angle.
double evalRayleigh(double y);

}  // namespace welkin
