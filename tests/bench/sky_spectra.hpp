// SPDX-License-Identifier: MIT
// Rays through several airs, each at many wavelengths: what welkin_sky_color compares.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "reference/spectrum.hpp"

namespace bench {

namespace rt = welkin::reference;

// What the library takes at its own wavelengths: [R04] Table 3, and 300 Dobson units of ozone.
constexpr rt::Rgb WELKIN_nm{680, 550, 440};
constexpr rt::Rgb WELKIN_AIR{5.8e-6, 1.35e-5, 3.31e-5};
constexpr rt::Rgb WELKIN_OZONE{6.5e-7, 1.881e-6, 8.5e-8};
// Ozone absorbs most at 600 nm, which none of the three wavelengths sees. These stand for what it
// takes from the colours: red and green have the least residual of the fit, within 0.1e-6.
constexpr rt::Rgb BAND_OZONE{2.7e-6, 1.7e-6, 8.5e-8};
constexpr double HAZE_G = 0.76;
constexpr double HAZE_ALBEDO = 0.95;

struct Atmosphere {
  const char* name;
  double ozone_DU;
  double hazeExtinction;  // 1/m at sea level, the same at all wavelengths
  double hazeHeight;
  double groundAlbedo;
  bool fitted;  // or for validation
};
std::span<const Atmosphere> atmospheres();

enum class Kind { Sky, Aerial, Sunlight, Seen };

struct Group {
  const char* name;
  Kind kind;
  double sunLow_deg;
  double sunHigh_deg;
  double lowest;  // altitude, m; half of the eyes stand there if it is 2
  double highest;
  size_t rays;
};
std::span<const Group> groups();

// The share of the Sun's light at each wavelength that a ray brings, per sr if it is scattered.
struct Sample {
  size_t group;
  const Atmosphere* atmosphere;
  rt::Spectrum share;
  rt::Rgb stated;  // the library's, with WELKIN_OZONE
  rt::Rgb banded;  // with BAND_OZONE
  rt::Rgb truth;   // linear sRGB, of luminance 1 for the Sun's light itself
};

// The rays of all groups, by the model in double precision, three wavelengths at a time.
void addSamples(const Atmosphere& atmosphere, uint64_t seed, std::vector<Sample>& samples);

// Bodhaine's cross-sections, times as many molecules as make the library's three coefficients
// nearest. 1/m.
double referenceScattering(double wavelength_nm);

}  // namespace bench
