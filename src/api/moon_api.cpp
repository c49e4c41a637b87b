// SPDX-License-Identifier: MIT
// The Earth's moon as a light: irradiance by phase angle from that of the sun, dimensionless ratio.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "api/error.hpp"
#include "api/validate.hpp"

namespace {

using namespace welkin;

struct Vec3 {
  double x, y, z;
};

Vec3 checkedUnit(const float v[3], const char* argument) {
  checkPointer(v, argument);
  const Vec3 d{static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
  const double length = std::hypot(d.x, d.y, d.z);
  if (!(std::abs(length - 1) <= 1e-3)) {
    fail(WLK_ERROR_INVALID_ARGUMENT, 0, argument, "%s has the length %g, expected 1", argument,
         length);
  }
  return {d.x / length, d.y / length, d.z / length};
}

void checkIrradiance(const float irradiance[3]) {
  checkPointer(irradiance, "sunIrradiance");
  for (int i = 0; i < 3; ++i) {
    if (!(irradiance[i] >= 0 && irradiance[i] <= 1e6f)) {
      fail(WLK_ERROR_INVALID_ARGUMENT, 0, "sunIrradiance",
           "sunIrradiance holds %g, expected [0, 1e+06]", static_cast<double>(irradiance[i]));
    }
  }
}

// Angle at the moon between sun and eye, degrees, 0 at full moon. From the distances of the unit
// vectors, so that full and new moon keep their digits; the sun is infinitely far (0.15 degrees).
double phaseAngle(const Vec3& sun, const Vec3& moon) {
  const double along = std::hypot(sun.x + moon.x, sun.y + moon.y, sun.z + moon.z);
  const double across = std::hypot(sun.x - moon.x, sun.y - moon.y, sun.z - moon.z);
  return 2 * std::atan2(along, across) * 180 / std::numbers::pi;
}

// Visual magnitudes at mean distances; the moon's law is that of Allen 1973, section 66, as
// Krisciunas and Schaefer 1991 (PASP 103, 1033), Eq. 9, write it. Within 0.05 mag of his table to
// 120 degrees, 0.11 to 150; within 9 % of Kieffer and Stone from 5 to 97 degrees. The opposition
// surge, 25 % within 2 degrees of full moon, is left out.
constexpr double SUN_MAGNITUDE = -26.74;
constexpr double FULL_MOON_MAGNITUDE = -12.73;
// Where measurements end: the light then falls as the cube of the elongation from the sun (Russell
// 1916, ApJ 43, 114), to none.
constexpr double LAST_MEASURED = 150;

double moonOverSun(double phase) {
  const double x = std::min(phase, LAST_MEASURED);
  const double magnitude = FULL_MOON_MAGNITUDE + 0.026 * x + 4e-9 * x * x * x * x;
  const double elongation = (180 - std::max(phase, LAST_MEASURED)) / (180 - LAST_MEASURED);
  return std::pow(10, 0.4 * (SUN_MAGNITUDE - magnitude)) * elongation * elongation * elongation;
}

// Albedo at 680, 550 and 440 nm over that in the visual band: the disk's reflectance at a phase
// angle of 45 degrees by Kieffer and Stone 2005 (AJ 129, 2887). Within 7 % from 5 to 97 degrees:
// the moon reddens with the phase angle.
constexpr double RED[3] = {1.28, 1, 0.78};

// rad, at 384 400 km.
constexpr float DIAMETER = 0.00904f;

}  // namespace

WlkResult wlkInitMoon(const float toSun[3], const float toMoon[3], const float sunIrradiance[3],
                      WlkLight* moon) {
  return guarded([&] {
    const Vec3 sun = checkedUnit(toSun, "toSun");
    const Vec3 to = checkedUnit(toMoon, "toMoon");
    checkIrradiance(sunIrradiance);
    WlkLight value = startOutput(moon, WLK_STRUCT_LIGHT);
    const double ratio = moonOverSun(phaseAngle(sun, to));
    const double direction[3] = {to.x, to.y, to.z};
    const double litFrom[3] = {sun.x, sun.y, sun.z};
    for (int i = 0; i < 3; ++i) {
      value.direction[i] = static_cast<float>(direction[i]);
      value.irradiance[i] =
          static_cast<float>(static_cast<double>(sunIrradiance[i]) * ratio * RED[i]);
      value.limbDarkening[i] = 0;
      value.litFrom[i] = static_cast<float>(litFrom[i]);
    }
    value.angularDiameter = DIAMETER;
    value.reserved0 = 0;
    finishOutput(value, moon);
    return WLK_SUCCESS;
  });
}
