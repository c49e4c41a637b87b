// SPDX-License-Identifier: MIT
// Colour of light by its whole spectrum: what wavelengths weigh for the eye, the Sun's spectrum,
// and how molecules and ozone act on it. 40 bins of 10 nm from 380 to 780 nm.
#pragma once

#include <array>
#include <cstddef>

#include "reference/vector.hpp"

namespace welkin::reference {

constexpr size_t SPECTRUM_BINS = 40;
constexpr double SPECTRUM_STEP_nm = 10;
// One value per bin.
using Spectrum = std::array<double, SPECTRUM_BINS>;
// Tristimulus values, CIE 1931, 2 degrees.
using Xyz = std::array<double, 3>;
// CIE 1976 L*, a*, b*.
using Lab = std::array<double, 3>;

struct SpectralBin {
  double wavelength_nm;  // of its centre
  double x, y, z;        // CIE 1931 colour matching functions of 2 degrees there
  double sun;            // mean irradiance outside the atmosphere at 1 au, W / (m^2 nm)
  double ozone;          // mean absorption cross-section at 233 K, m^2
};
extern const std::array<SpectralBin, SPECTRUM_BINS> SPECTRUM;

// Scattering cross-section of a molecule of air (360 ppm of CO2), m^2. Bodhaine et al. 1999, On
// Rayleigh optical depth calculations, Eq. 29: refractive index and depolarisation of air.
double rayleighCrossSection(double wavelength_nm);

// Of a power per nm. Times 683 lm/W it is photometric.
Xyz xyzOf(const Spectrum& power);
// Of sunlight of which `share` is left at each wavelength; 1 everywhere has Y = 1.
Xyz sunlightOf(const Spectrum& share);

// Rec. 709 primaries, white D65 (x 0.3127, y 0.3290); may be negative.
Rgb linearSrgbOf(const Xyz& xyz);
Xyz xyzOfLinearSrgb(const Rgb& rgb);

// Chromaticity x, y of CIE 1931 and u', v' of CIE 1976.
std::array<double, 2> chromaticityOf(const Xyz& xyz);
std::array<double, 2> uniformChromaticityOf(const Xyz& xyz);

// CIE 1976 L*a*b* beside a white.
Lab labOf(const Xyz& xyz, const Xyz& white);
// CIEDE2000 with all weights 1. Sharma, Wu and Dalal 2005.
double colorDifference(const Lab& one, const Lab& other);

}  // namespace welkin::reference
