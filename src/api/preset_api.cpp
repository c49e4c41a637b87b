// SPDX-License-Identifier: MIT
// Atmospheres to start from: vertical optical depths and where they are from. Lengths in m, RGB at
// 680, 550, 440 nm. docs/atmospheres.md has the same numbers as a table.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "api/context.hpp"

namespace {

using namespace welkin;

template <size_t N>
void assign(float (&to)[N], const float (&from)[N]) {
  std::copy_n(from, N, to);
}

struct Preset {
  WlkPlanet planet;
  WlkSky sky;
  WlkAbsorber absorber;
  WlkFog haze;
  WlkMediumInfo hazeMedium;
  WlkLight sun;
};

Preset defaults() {
  Preset p;
  wlkInitStruct(WLK_STRUCT_PLANET, sizeof p.planet, &p.planet);
  wlkInitStruct(WLK_STRUCT_SKY, sizeof p.sky, &p.sky);
  wlkInitStruct(WLK_STRUCT_ABSORBER, sizeof p.absorber, &p.absorber);
  wlkInitStruct(WLK_STRUCT_FOG, sizeof p.haze, &p.haze);
  wlkInitStruct(WLK_STRUCT_MEDIUM_INFO, sizeof p.hazeMedium, &p.hazeMedium);
  wlkInitStruct(WLK_STRUCT_LIGHT, sizeof p.sun, &p.sun);
  // Exponents of the Sun's limb: Hestroffer and Magnan 1998.
  assign(p.sun.limbDarkening, {0.36f, 0.47f, 0.62f});
  return p;
}

// An exponential layer over altitude 0 with this vertical optical depth.
void setHaze(WlkFog& haze, double opticalDepth, double scaleHeight) {
  haze.extinction = static_cast<float>(opticalDepth / scaleHeight);
  haze.baseAltitude = 0;
  haze.scaleHeight = static_cast<float>(scaleHeight);
}

// Air and ozone of the defaults. Particles of the accumulation mode, 0.35 um: mean cosine 0.72 at
// 550 nm; continental aerosol has 0.70 to 0.71 (OPAC, Hess et al. 1998).
Preset earth(double opticalDepth, double scaleHeight, const float (&albedo)[3]) {
  Preset p = defaults();
  p.hazeMedium.particle = WLK_PARTICLE_HAZE;
  p.hazeMedium.diameter_um = 0.35f;
  assign(p.hazeMedium.singleScatteringAlbedo, albedo);
  assign(p.haze.singleScatteringAlbedo, albedo);
  setHaze(p.haze, opticalDepth, scaleHeight);
  return p;
}

// Molecules of CO2: cross-section 24 pi^3 / (lambda^4 N^2) ((n^2 - 1) / (n^2 + 2))^2 F, with n of
// Bideau-Mehu et al. 1973 at 0 C and 1 atm, and King's factor F of Sneep and Ubachs 2005:
// 4.88e-31, 1.161e-30, 2.920e-30 m^2. At the mean radius 636 Pa and 210 K (NASA's fact sheet).
double carbonDioxideScattering(double wavelength_um) {
  constexpr double BOLTZMANN = 1.380649e-23;
  constexpr double STANDARD = 101325 / (BOLTZMANN * 273.15);
  constexpr double MARS = 636 / (BOLTZMANN * 210);
  constexpr double PI = 3.14159265358979324;
  const double s = 1 / (wavelength_um * wavelength_um);
  const double n = 1 + 6.99100e-2 / (166.175 - s) + 1.44720e-3 / (79.609 - s) +
                   6.42941e-5 / (56.3064 - s) + 5.21306e-5 / (46.0196 - s) +
                   1.46847e-6 / (0.0584738 - s);
  const double king = 1.1364 + 25.3e-4 * s;
  const double lorentz = (n * n - 1) / (n * n + 2) / STANDARD;
  const double wavelength = wavelength_um * 1e-6;
  const double crossSection =
      24 * std::pow(PI, 3) / std::pow(wavelength, 4) * lorentz * lorentz * king;
  return MARS * crossSection;
}

// Dust: optical depth 0.5 as at the landing sites outside the storms (Smith et al. 1997), mixed
// with the gas; albedo rising from 0.73 at 388 nm to 0.97 at 650 nm (Wolff et al. 2009) and 0.76 at
// 444 nm (Tomasko et al. 1999); mean cosine 0.69 (Chen-Chen et al. 2019). The sun: at 1.5237 au.
Preset mars() {
  constexpr double DISTANCE = 1.5237;
  constexpr double SCALE_HEIGHT = 11000;
  Preset p = defaults();
  p.planet.radius = 3.3895e6f;
  assign(p.planet.groundAlbedo, {0.25f, 0.13f, 0.06f});  // rounded, between bright and dark regions
  const double wavelengths_um[3] = {0.68, 0.55, 0.44};
  for (int c = 0; c < 3; ++c) {
    p.sky.rayleighScattering[c] = static_cast<float>(carbonDioxideScattering(wavelengths_um[c]));
    p.sun.irradiance[c] = static_cast<float>(1 / (DISTANCE * DISTANCE));
  }
  p.sky.scaleHeight = static_cast<float>(SCALE_HEIGHT);
  assign(p.absorber.absorption, {0, 0, 0});
  p.hazeMedium.particle = WLK_PARTICLE_HENYEY_GREENSTEIN;
  p.hazeMedium.asymmetry = 0.69f;
  const float albedo[3] = {0.97f, 0.92f, 0.77f};
  assign(p.hazeMedium.singleScatteringAlbedo, albedo);
  assign(p.haze.singleScatteringAlbedo, albedo);
  setHaze(p.haze, 0.5, SCALE_HEIGHT);
  p.sun.angularDiameter = static_cast<float>(0.0093 / DISTANCE);
  return p;
}

Preset presetOf(uint32_t preset) {
  switch (preset) {
    // Clean continental air: albedo 0.972 at 550 nm (OPAC). Scale height: Elterman 1968.
    case WLK_ATMOSPHERE_EARTH_CLEAR:
      return earth(0.05, 1200, {0.97f, 0.97f, 0.97f});
    // Greenbelt in summer: 0.98 at 440 nm, 0.97 at 670 nm (Dubovik et al. 2002, Table 1).
    case WLK_ATMOSPHERE_EARTH_HAZY:
      return earth(0.25, 1500, {0.97f, 0.975f, 0.98f});
    // Mexico City: 0.90 and 0.88 (the same); OPAC's polluted continent has 0.893 at 550 nm.
    case WLK_ATMOSPHERE_EARTH_POLLUTED:
      return earth(0.7, 1000, {0.88f, 0.89f, 0.90f});
    case WLK_ATMOSPHERE_MARS:
      return mars();
    default:
      fail(WLK_ERROR_INVALID_ARGUMENT, 0, "preset", "preset is %u, expected [0, %d]", preset,
           int{WLK_ATMOSPHERE_MARS});
  }
}

// All but what wlkInitStruct has written of the header, as far as the caller's structure goes.
template <typename T>
void overwrite(const T& value, uint32_t structSize, void* structure) {
  constexpr size_t HEADER = sizeof(WlkPlanet::sType) + sizeof(WlkPlanet::structSize);
  const auto* from = reinterpret_cast<const char*>(&value);
  std::memcpy(static_cast<char*>(structure) + HEADER, from + HEADER,
              std::min<size_t>(structSize, sizeof value) - HEADER);
}

}  // namespace

WlkResult wlkInitPresetStruct(uint32_t preset, uint32_t sType, uint32_t structSize,
                              void* structure) {
  return guarded([&] {
    const Preset value = presetOf(preset);
    switch (sType) {
      case WLK_STRUCT_PLANET:
      case WLK_STRUCT_SKY:
      case WLK_STRUCT_ABSORBER:
      case WLK_STRUCT_FOG:
      case WLK_STRUCT_MEDIUM_INFO:
      case WLK_STRUCT_LIGHT:
        break;
      default:
        fail(WLK_ERROR_UNKNOWN_STRUCT, sType, "sType", "sType %u is no part of an atmosphere",
             sType);
    }
    const WlkResult result = wlkInitStruct(sType, structSize, structure);
    if (result < 0) {
      return result;
    }
    switch (sType) {
      case WLK_STRUCT_PLANET:
        overwrite(value.planet, structSize, structure);
        break;
      case WLK_STRUCT_SKY:
        overwrite(value.sky, structSize, structure);
        break;
      case WLK_STRUCT_ABSORBER:
        overwrite(value.absorber, structSize, structure);
        break;
      case WLK_STRUCT_FOG:
        overwrite(value.haze, structSize, structure);
        break;
      case WLK_STRUCT_MEDIUM_INFO:
        overwrite(value.hazeMedium, structSize, structure);
        break;
      default:
        overwrite(value.sun, structSize, structure);
        break;
    }
    return WlkResult{WLK_SUCCESS};
  });
}
