// SPDX-License-Identifier: MIT
#include "particles/refractive_index.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace welkin {
namespace {

// Warren and Brandt 2008, 0.38 to 0.76 um in steps of 10 nm; 0.38 lies on the line between the
// table's 0.35 (1.3249) and 0.39 (1.3203).
constexpr double ICE_FIRST_UM = 0.38;
constexpr double ICE_STEP_UM = 0.01;
constexpr std::array ICE = {1.32145, 1.3203, 1.3194, 1.3185, 1.3177, 1.3170, 1.3163, 1.3157,
                            1.3151,  1.3145, 1.3140, 1.3135, 1.3130, 1.3126, 1.3121, 1.3117,
                            1.3114,  1.3110, 1.3106, 1.3103, 1.3100, 1.3097, 1.3094, 1.3091,
                            1.3088,  1.3085, 1.3083, 1.3080, 1.3078, 1.3076, 1.3073, 1.3071,
                            1.3069,  1.3067, 1.3065, 1.3062, 1.3060, 1.3059, 1.3057};

}  // namespace

double waterDensity(double temperature_C) {
  const double t = std::clamp(temperature_C, 0.0, 40.0);
  const double warm = t - 3.983035;
  return 999.97495 * (1 - warm * warm * (t + 301.797) / (522528.9 * (t + 69.34881)));
}

double waterIndexInVacuum(double wavelength_um, double temperature_C) {
  const double density = waterDensity(temperature_C) / 1000;
  const double heat = (std::clamp(temperature_C, 0.0, 40.0) + 273.15) / 273.15;
  const double wave = wavelength_um / 0.589;
  const double square = wave * wave;
  constexpr double ULTRAVIOLET = 0.2292020 * 0.2292020;
  constexpr double INFRARED = 5.432937 * 5.432937;
  // Molar refraction (n^2 - 1) / (n^2 + 2) over the reduced density.
  const double perDensity = 0.244257733 + 9.74634476e-3 * density - 3.73234996e-3 * heat +
                            2.68678472e-4 * square * heat + 1.58920570e-3 / square +
                            2.45934259e-3 / (square - ULTRAVIOLET) +
                            0.900704920 / (square - INFRARED) - 1.66626219e-2 * density * density;
  const double refraction = perDensity * density;
  return std::sqrt((1 + 2 * refraction) / (1 - refraction));
}

double waterIndex(double wavelength_um, double temperature_C) {
  return waterIndexInVacuum(wavelength_um, temperature_C) / AIR_INDEX;
}

double iceIndex(double wavelength_um) {
  const double last = static_cast<double>(ICE.size() - 1);
  const double place = std::clamp((wavelength_um - ICE_FIRST_UM) / ICE_STEP_UM, 0.0, last);
  const size_t below = std::min(static_cast<size_t>(place), ICE.size() - 2);
  return std::lerp(ICE[below], ICE[below + 1], place - static_cast<double>(below));
}

}  // namespace welkin
