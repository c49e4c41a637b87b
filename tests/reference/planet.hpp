// SPDX-License-Identifier: MIT
// Once-scattered light and optical depth of two exponential layers and one that absorbs only around
// a sphere, by quadrature along straight lines with positions in long double and nothing but exp,
// sqrt and asin. Slow.
#pragma once

#include <array>

namespace welkin::reference {

// Lengths in m, extinctions in 1/m.
struct Planet {
  double radius = 6.371e6;
  std::array<double, 3> airScattering = {5.8e-6, 1.35e-5, 3.31e-5};
  double airScaleHeight = 8000.0;
  double fogExtinction = 0.0;
  double fogBaseAltitude = 0.0;
  double fogScaleHeight = 100.0;
  std::array<double, 3> fogAlbedo = {1.0, 1.0, 1.0};
  // Scatters nothing. Density rises linearly from 0 at peak - width to 1 at the peak, falls
  // linearly to 0 at peak + width, and is 0 below sea level.
  std::array<double, 3> absorption = {0.0, 0.0, 0.0};  // at the peak
  double absorberPeak = 25000.0;
  double absorberWidth = 15000.0;
};

// A ray at its origin: cosines of view and light with the local up and with each other.
struct PlanetRay {
  double altitude;
  double viewMu;
  double lightMu;
  double viewLight;
  double length;  // may be infinite
};

// Depth per unit extinction at altitude 0 (air), at the base (fog) and at the peak (absorber). m.
struct Columns {
  double air;
  double fog;
  double absorber;
};

// Integral of the densities along a ray; the planet is transparent. Relative error <= 1e-8; of the
// absorber 1e-12 of the ray's length in it (AbsorberReference.ColumnIsItsClosedForm).
Columns columns(const Planet& planet, double altitude, double mu, double length);

// Optical depth from columns. RGB.
std::array<double, 3> depthOf(const Planet& planet, const Columns& c);

// Fraction of a disk of half angle `angularRadius` (rad) above the geometric horizon.
double visibleFraction(const Planet& planet, double altitude, double lightMu, double angularRadius);

// Radiance per unit irradiance, once scattered, for phase values given. The light is attenuated as
// that of the disk's centre and weighted with visibleFraction. Adaptive, error <= tolerance times
// the largest channel (or 1e-6, if that is more).
std::array<double, 3> inscatter(const Planet& planet, const PlanetRay& ray, double airPhase,
                                double fogPhase, double angularRadius, double tolerance);

}  // namespace welkin::reference
