// SPDX-License-Identifier: MIT
// Refractive indices in the visible, dimensionless, relative to air. No Vulkan.
#pragma once

namespace welkin {

// Density of air-free water at 1 atm in kg/m^3; temperature in C, clamped to [0, 40]. Tanaka et
// al. 2001, Metrologia 38, 301; uncertainty 1e-6.
double waterDensity(double temperature_C);

// Real index of liquid water relative to vacuum; wavelength in vacuum in um, [0.2, 1.1] stated by
// the source; temperature as above. IAPWS 1997 release (Harvey et al. 1998, J. Phys. Chem. Ref.
// Data 27, 761, Eq. 1), uncertainty 1.5e-5 in the visible. The imaginary part is taken as 0: it is
// below 1.6e-7 for 0.38-0.75 um, so a drop of 1 mm radius absorbs less than 5e-3 of the light.
double waterIndexInVacuum(double wavelength_um, double temperature_C);

// The same relative to air, whose index is AIR_INDEX for all wavelengths: dispersion in 0.38-0.75
// um, 0-40 C and 0.8-1 atm move it by less than 1e-4, a rainbow by less than 0.015 degrees.
double waterIndex(double wavelength_um, double temperature_C);
constexpr double AIR_INDEX = 1.000277;  // 15 C, 1 atm, 589 nm: Ciddor 1996, Appl. Opt. 35, 1566

// Real index of ice at -7 C, mean of both polarisations; wavelength in um, clamped to [0.38, 0.76].
// Warren and Brandt 2008, J. Geophys. Res. 113, D14220, table at 10 nm, linear between (error
// 5e-5, half a printed digit). Imaginary part below 7.1e-8: taken as 0.
double iceIndex(double wavelength_um);

}  // namespace welkin
