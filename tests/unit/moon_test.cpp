// SPDX-License-Identifier: MIT
// wlkInitMoon against published tables of the moon's light.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <string>

#include "welkin/welkin.hpp"

namespace {

using welkin::check;
using welkin::make;
using Vector = std::array<float, 3>;

constexpr double DEGREE = std::numbers::pi / 180;
constexpr Vector WHITE{1, 1, 1};
constexpr Vector TO_MOON{0.6f, 0, -0.8f};

// Towards a sun that makes the phase angle at the moon.
Vector sunAt(double phase_deg) {
  const double c = -std::cos(phase_deg * DEGREE);
  const double s = std::sin(phase_deg * DEGREE);
  return {static_cast<float>(0.6 * c), static_cast<float>(s), static_cast<float>(-0.8 * c)};
}

WlkLight moonAt(double phase_deg, const Vector& sunlight = WHITE) {
  auto moon = make<WlkLight>();
  check(wlkInitMoon(sunAt(phase_deg).data(), TO_MOON.data(), sunlight.data(), &moon));
  return moon;
}

double green(double phase_deg) {
  return static_cast<double>(moonAt(phase_deg).irradiance[1]);
}

// Allen 1973, Astrophysical Quantities, section 66: magnitudes below full moon.
constexpr double ALLEN[][2] = {{5, 0.08},   {10, 0.23},  {20, 0.51},  {30, 0.79},
                               {40, 1.06},  {50, 1.35},  {60, 1.62},  {70, 1.91},
                               {80, 2.24},  {90, 2.63},  {100, 3.04}, {110, 3.48},
                               {120, 3.93}, {130, 4.44}, {140, 5.07}, {150, 5.9}};

TEST(Moon, FadesWithThePhaseAsPublished) {
  // The formula against the table it stands for, mag: bright moons and thin ones.
  constexpr double BRIGHT = 0.055;
  constexpr double THIN = 0.11;
  const double full = green(0);
  double worst = 0;
  for (const auto& [phase, magnitude] : ALLEN) {
    const double value = -2.5 * std::log10(green(phase) / full);
    worst = std::max(worst, std::abs(value - magnitude));
    EXPECT_NEAR(value, magnitude, phase <= 120 ? BRIGHT : THIN) << phase;
  }
  std::printf("moon's magnitude within %.3f of the table\n", worst);
  // Sun -26.74, full moon -12.73.
  EXPECT_NEAR(full, 2.49e-6, 0.01e-6);
  EXPECT_NEAR(green(90) / full, 0.091, 0.001);
}

// Kieffer and Stone 2005, Table 4 and Eq. 10 without libration, at 441.6, 549.1 and, linear between
// 665.1 and 693.1, 680 nm: a0 to a3, d1 to d3.
double rolo(const double (&k)[7], double phase_deg) {
  const double g = phase_deg * DEGREE;
  return std::exp(k[0] + g * (k[1] + g * (k[2] + g * k[3])) +
                  k[4] * std::exp(-phase_deg / 4.06054) + k[5] * std::exp(-phase_deg / 12.8802) +
                  k[6] * std::cos((phase_deg + 30.5858) / 16.7498));
}
std::array<double, 3> reflectance(double phase_deg) {
  constexpr double BLUE[7] = {-2.31964, -1.72114, 0.37286, -0.19304, 0.37935, -0.09562, 0.00970};
  constexpr double GREEN[7] = {-2.10782, -1.66736, 0.41697, -0.22026, 0.36814, -0.09815, 0};
  constexpr double RED[7] = {-1.88914, -1.58096, 0.30477, -0.17908, 0.37141, -0.13514, 0.01248};
  constexpr double DEEP[7] = {-1.89410, -1.58509, 0.28080, -0.16427, 0.39109, -0.17048, 0.01754};
  const double share = (680 - 665.1) / (693.1 - 665.1);
  return {(1 - share) * rolo(RED, phase_deg) + share * rolo(DEEP, phase_deg),
          rolo(GREEN, phase_deg), rolo(BLUE, phase_deg)};
}

TEST(Moon, FollowsTheMeasuredReflectanceOfItsDisk) {
  constexpr double SOLID_ANGLE = 6.4177e-5;  // sr, at the mean distance
  constexpr double LAWS = 0.1;               // two photometries of the whole disk
  constexpr double COLOUR = 0.07;            // grows redder with the phase angle
  double worst = 0;
  double worstColour = 0;
  for (double phase = 5; phase <= 97; phase += 4) {
    const WlkLight moon = moonAt(phase);
    const std::array<double, 3> truth = reflectance(phase);
    const double g = static_cast<double>(moon.irradiance[1]);
    const double expected = truth[1] * SOLID_ANGLE / std::numbers::pi;
    worst = std::max(worst, std::abs(g / expected - 1));
    EXPECT_NEAR(g / expected, 1, LAWS) << phase;
    for (const size_t c : {0u, 2u}) {
      const double colour = static_cast<double>(moon.irradiance[c]) / g / (truth[c] / truth[1]);
      worstColour = std::max(worstColour, std::abs(colour - 1));
      EXPECT_NEAR(colour, 1, COLOUR) << phase;
    }
  }
  std::printf("moon against ROLO: green within %.1f %%, colour within %.1f %%\n", 100 * worst,
              100 * worstColour);
}

TEST(Moon, FadesSmoothlyToNothingAtNewMoon) {
  EXPECT_EQ(green(180), 0.0);
  double before = green(140);
  for (double phase = 140.25; phase < 180; phase += 0.25) {
    const double now = green(phase);
    EXPECT_LT(now, before) << phase;
    if (phase < 170) {
      EXPECT_GT(now, 0.9 * before) << phase;
    }
    before = now;
  }
  // Allen's last value, 7.5 mag at 160 degrees, is an extrapolation.
  EXPECT_NEAR(-2.5 * std::log10(green(160) / green(0)), 7.5, 0.35);
}

TEST(Moon, FillsALightThatMayBeSet) {
  auto moon = make<WlkLight>();
  std::fill_n(moon.limbDarkening, 3, 1.0f);
  const Vector sunlight{2, 0, 1e6f};
  const Vector toSun = sunAt(60);
  check(wlkInitMoon(toSun.data(), TO_MOON.data(), sunlight.data(), &moon));
  EXPECT_EQ(moon.sType, static_cast<uint32_t>(WLK_STRUCT_LIGHT));
  EXPECT_EQ(moon.structSize, sizeof moon);
  EXPECT_EQ(moon.next, nullptr);
  EXPECT_NEAR(static_cast<double>(moon.angularDiameter), 0.5180 * DEGREE, 1e-5);
  const WlkLight white = moonAt(60);
  for (size_t c = 0; c < 3; ++c) {
    constexpr double ROUNDINGS = 3 * 0x1p-24;
    EXPECT_NEAR(static_cast<double>(moon.direction[c]), static_cast<double>(TO_MOON[c]), ROUNDINGS);
    EXPECT_NEAR(static_cast<double>(moon.litFrom[c]), static_cast<double>(toSun[c]), ROUNDINGS);
    EXPECT_EQ(moon.limbDarkening[c], 0.0f);
    EXPECT_FLOAT_EQ(moon.irradiance[c], sunlight[c] * white.irradiance[c]);
  }
  const welkin::Context context(make<WlkContextInfo>());
  for (const double phase : {0.0, 1e-4, 90.0, 179.9, 180.0}) {
    const WlkLight one = moonAt(phase);
    EXPECT_EQ(wlkSetLights(context, 1, sizeof one, &one), WLK_SUCCESS) << phase;
  }
}

std::string lastField() {
  auto info = make<WlkErrorInfo>();
  check(wlkGetLastError(&info));
  return info.field;
}

TEST(Moon, RefusesWhatIsNoDirectionOrIrradiance) {
  constexpr float NOT_A_NUMBER = std::numeric_limits<float>::quiet_NaN();
  const Vector good = sunAt(70);
  const Vector bad[] = {{0, 0, 0}, {1, 1, 0}, {NOT_A_NUMBER, 0, 1}, {INFINITY, 0, 0}};
  auto moon = make<WlkLight>();
  const WlkLight before = moon;
  for (const Vector& v : bad) {
    EXPECT_EQ(wlkInitMoon(v.data(), good.data(), WHITE.data(), &moon), WLK_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(lastField(), "toSun");
    EXPECT_EQ(wlkInitMoon(good.data(), v.data(), WHITE.data(), &moon), WLK_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(lastField(), "toMoon");
  }
  for (const float x : {-1.0f, NOT_A_NUMBER, INFINITY, 2e6f}) {
    const Vector v{1, x, 1};
    EXPECT_EQ(wlkInitMoon(good.data(), good.data(), v.data(), &moon), WLK_ERROR_INVALID_ARGUMENT);
    EXPECT_EQ(lastField(), "sunIrradiance");
  }
  EXPECT_EQ(wlkInitMoon(nullptr, good.data(), WHITE.data(), &moon), WLK_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(lastField(), "toSun");
  EXPECT_EQ(wlkInitMoon(good.data(), nullptr, WHITE.data(), &moon), WLK_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(lastField(), "toMoon");
  EXPECT_EQ(wlkInitMoon(good.data(), good.data(), nullptr, &moon), WLK_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(lastField(), "sunIrradiance");
  EXPECT_EQ(wlkInitMoon(good.data(), good.data(), WHITE.data(), nullptr),
            WLK_ERROR_INVALID_ARGUMENT);
  moon.structSize = 24;
  EXPECT_EQ(wlkInitMoon(good.data(), good.data(), WHITE.data(), &moon), WLK_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(lastField(), "structSize");
  moon = before;
  moon.sType = WLK_STRUCT_SKY;
  EXPECT_EQ(wlkInitMoon(good.data(), good.data(), WHITE.data(), &moon), WLK_ERROR_UNKNOWN_STRUCT);
  // Nothing was written.
  EXPECT_EQ(moon.irradiance[0], before.irradiance[0]);
  EXPECT_EQ(moon.direction[1], before.direction[1]);
}

}  // namespace
