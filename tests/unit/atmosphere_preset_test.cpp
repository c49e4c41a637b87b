// SPDX-License-Identifier: MIT
// Presets of atmospheres, the absorbing gas and the medium of a fog layer, through the C API.
#include <gtest/gtest.h>

#include <cstring>

#include "unit/sky_scene.hpp"

namespace welkin::test {
namespace {

constexpr double TOP = 6e5;       // m: 54 scale heights of the thickest layer
constexpr double DEPTH = 2e-3;    // documented error of wlkEvalTransmittance's optical depth
constexpr double ROUNDED = 5e-3;  // of docs/atmospheres.md, three digits

struct Preset {
  WlkPlanet planet;
  WlkSky sky;
  WlkAbsorber absorber;
  WlkFog haze;
  WlkMediumInfo hazeMedium;
  WlkLight sun;
};

Preset presetOf(uint32_t which) {
  return {welkin::makePreset<WlkPlanet>(which),     welkin::makePreset<WlkSky>(which),
          welkin::makePreset<WlkAbsorber>(which),   welkin::makePreset<WlkFog>(which),
          welkin::makePreset<WlkMediumInfo>(which), welkin::makePreset<WlkLight>(which)};
}

// Optical depth straight up from an altitude.
Rgb depthAbove(const SkyScene& scene, double altitude) {
  Rgb depth = scene.transmittance({0, altitude, 0}, {0, TOP, 0});
  for (double& one : depth) {
    one = -std::log(one);
  }
  return depth;
}

struct Documented {
  uint32_t preset;
  Rgb molecules;
  Rgb absorber;
  double haze;
};

// docs/atmospheres.md. A vertical ray through an exponential layer crosses coefficient times scale
// height, through a whole triangle of absorber the coefficient at its peak times its half width.
constexpr Documented DOCUMENTED[] = {
    {WLK_ATMOSPHERE_EARTH_CLEAR, {0.0464, 0.108, 0.265}, {0.0405, 0.0255, 0.00128}, 0.05},
    {WLK_ATMOSPHERE_EARTH_HAZY, {0.0464, 0.108, 0.265}, {0.0405, 0.0255, 0.00128}, 0.25},
    {WLK_ATMOSPHERE_EARTH_POLLUTED, {0.0464, 0.108, 0.265}, {0.0405, 0.0255, 0.00128}, 0.7},
    {WLK_ATMOSPHERE_MARS, {0.00118, 0.00280, 0.00705}, {0, 0, 0}, 0.5}};

TEST(AtmospherePreset, HasItsDocumentedVerticalOpticalDepths) {
  for (const Documented& expected : DOCUMENTED) {
    SCOPED_TRACE(expected.preset);
    Preset p = presetOf(expected.preset);
    const SkyScene scene;
    check(wlkSetPlanet(scene.context, &p.planet));
    check(wlkSetSky(scene.context, &p.sky));
    const Rgb molecules = depthAbove(scene, 0);
    check(wlkSetAbsorber(scene.context, &p.absorber));
    const Rgb gases = depthAbove(scene, 0);
    const welkin::Medium medium(scene.context, p.hazeMedium);
    p.haze.medium = medium;
    check(wlkSetFog(scene.context, &p.haze));
    const Rgb all = depthAbove(scene, 0);
    for (size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(molecules[c], expected.molecules[c], (DEPTH + ROUNDED) * expected.molecules[c]);
      EXPECT_NEAR(gases[c] - molecules[c], expected.absorber[c],
                  DEPTH * gases[c] + ROUNDED * expected.absorber[c]);
      EXPECT_NEAR(all[c] - gases[c], expected.haze, DEPTH * all[c]);
    }
  }
}

// A column of CO2 weighs its pressure: p / (m g) molecules per m^2, 3.71 m/s^2. The preset's is its
// number density times 11 km instead, 1 % more; cross-sections of Sneep and Ubachs 2005 follow
// lambda^-4 but for the refractive index's 3 % between 680 and 440 nm, squared.
TEST(AtmospherePreset, MarsScattersLikeItsColumnOfCarbonDioxide) {
  const Preset p = presetOf(WLK_ATMOSPHERE_MARS);
  const double column = 636 / (44.01 * 1.66054e-27 * 3.71);
  const double green = static_cast<double>(p.sky.rayleighScattering[1]) * 11000 / column;
  EXPECT_NEAR(green, 1.16e-30, 0.03 * 1.16e-30);
  const double ratio = static_cast<double>(p.sky.rayleighScattering[2]) /
                       static_cast<double>(p.sky.rayleighScattering[0]);
  const double power = std::pow(680.0 / 440.0, 4);
  EXPECT_GT(ratio, power);
  EXPECT_LT(ratio, 1.08 * power);
}

TEST(AtmospherePreset, EveryPartIsWhatItsFunctionTakes) {
  for (uint32_t which = 0; which < 4; ++which) {
    Preset p = presetOf(which);
    const SkyScene scene;
    EXPECT_EQ(wlkSetPlanet(scene.context, &p.planet), WLK_SUCCESS);
    EXPECT_EQ(wlkSetSky(scene.context, &p.sky), WLK_SUCCESS);
    EXPECT_EQ(wlkSetAbsorber(scene.context, &p.absorber), WLK_SUCCESS);
    EXPECT_EQ(wlkCreateMedium(scene.context, &p.hazeMedium, &p.haze.medium), WLK_SUCCESS);
    EXPECT_EQ(wlkSetFog(scene.context, &p.haze), WLK_SUCCESS);
    EXPECT_EQ(wlkSetLights(scene.context, 1, sizeof p.sun, &p.sun), WLK_SUCCESS);
    EXPECT_EQ(p.sun.sType, uint32_t{WLK_STRUCT_LIGHT});
    EXPECT_EQ(p.sun.structSize, sizeof p.sun);
  }
}

TEST(AtmospherePreset, RefusesWhatIsNoPartOfAnAtmosphere) {
  WlkSky sky;
  std::memset(&sky, 0x5a, sizeof sky);
  const WlkSky before = sky;
  EXPECT_EQ(wlkInitPresetStruct(4, WLK_STRUCT_SKY, sizeof sky, &sky), WLK_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(wlkInitPresetStruct(0, WLK_STRUCT_SKY, sizeof sky, nullptr),
            WLK_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(wlkInitPresetStruct(0, WLK_STRUCT_SKY, sizeof sky - 8, &sky),
            WLK_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(wlkInitPresetStruct(0, WLK_STRUCT_VIEW_INFO, sizeof sky, &sky),
            WLK_ERROR_UNKNOWN_STRUCT);
  EXPECT_EQ(std::memcmp(&sky, &before, sizeof sky), 0) << "a failed call has changed something";
}

// A caller's header may be newer and the structure longer: the surplus is zero.
TEST(AtmospherePreset, FillsALongerStructureToItsEnd) {
  struct Longer {
    WlkSky sky;
    uint64_t more;
  };
  Longer longer;
  std::memset(&longer, 0x5a, sizeof longer);
  check(wlkInitPresetStruct(WLK_ATMOSPHERE_MARS, WLK_STRUCT_SKY, sizeof longer, &longer));
  const auto expected = welkin::makePreset<WlkSky>(WLK_ATMOSPHERE_MARS);
  EXPECT_EQ(longer.sky.structSize, sizeof longer);
  EXPECT_EQ(longer.sky.scaleHeight, expected.scaleHeight);
  EXPECT_EQ(longer.more, 0u);
}

TEST(Absorber, TakesItsTriangleOfLightAndNoMore) {
  const SkyScene scene;
  auto nothing = make<WlkSky>();
  std::fill_n(nothing.rayleighScattering, 3, 0.0F);
  check(wlkSetSky(scene.context, &nothing));
  auto ozone = make<WlkAbsorber>();
  check(wlkSetAbsorber(scene.context, &ozone));
  // The part of a triangle with peak 1 at 25 km and half width 15 km over an altitude, km.
  const auto over = [](double h) {
    const double t = std::clamp((h - 25) / 15, -1.0, 1.0);
    return 15 * (t < 0 ? 1 - (1 + t) * (1 + t) / 2 : (1 - t) * (1 - t) / 2);
  };
  for (const double h : {0.0, 10.0, 17.0, 25.0, 33.0, 39.0}) {
    const Rgb depth = depthAbove(scene, 1e3 * h);
    for (size_t c = 0; c < 3; ++c) {
      const double peak = static_cast<double>(ozone.absorption[c]);
      EXPECT_NEAR(depth[c], 1e3 * peak * over(h), DEPTH * 1e3 * peak * over(0)) << h;
    }
  }
  check(wlkSetAbsorber(scene.context, nullptr));
  EXPECT_EQ(scene.transmittance({0, 0, 0}, {0, TOP, 0}), (Rgb{1, 1, 1}));
}

WlkFog thinFog() {
  auto fog = make<WlkFog>();
  fog.extinction = 1e-9F;  // once-scattered light is proportional to the phase function
  fog.scaleHeight = 1000;
  return fog;
}

TEST(FogMedium, ScattersByItsPhaseFunction) {
  const SkyScene scene;
  scene.setSun(towards(30, 0));
  auto info = make<WlkMediumInfo>();
  info.particle = WLK_PARTICLE_HENYEY_GREENSTEIN;
  info.asymmetry = 0.6F;
  WlkFog fog = thinFog();
  {
    const welkin::Medium medium(scene.context, info);
    fog.medium = medium;
    check(wlkSetFog(scene.context, &fog));
  }  // destroyed: the layer keeps the phase function
  const auto henyey = [](double mu) {
    constexpr double G = 0.6F;
    return (1 - G * G) / std::pow(1 + G * G - 2 * G * mu, 1.5);
  };
  const Point sun = towards(30, 0);
  const auto at = [&](double azimuth) {
    const Point view = towards(5, azimuth);
    const double mu = view[0] * sun[0] + view[1] * sun[1] + view[2] * sun[2];
    return scene.radiance({0, 100, 0}, view, INF, 1)[1] / henyey(mu);
  };
  const double CURVE = 1e-6;  // phase functions in closed form, floats in the API
  for (const double azimuth : {30.0, 90.0, 180.0}) {
    EXPECT_NEAR(at(azimuth) / at(0), 1, CURVE) << azimuth;
  }
  EXPECT_EQ(wlkSetFog(scene.context, &fog), WLK_ERROR_INVALID_HANDLE);
}

TEST(FogMedium, OfTheSameDropletsIsTheSameFog) {
  const SkyScene scene;
  scene.setSun(towards(30, 0));
  auto info = make<WlkMediumInfo>();
  info.particle = WLK_PARTICLE_FOG;
  const welkin::Medium medium(scene.context, info);
  WlkFog fog = thinFog();
  check(wlkSetFog(scene.context, &fog));
  const Rgb droplets = scene.radiance({0, 100, 0}, towards(5, 20), INF, 1);
  fog.medium = medium;
  check(wlkSetFog(scene.context, &fog));
  EXPECT_EQ(scene.radiance({0, 100, 0}, towards(5, 20), INF, 1), droplets);
  // Another medium is another phase function, and 0 is the droplets again.
  info.particle = WLK_PARTICLE_AIR;
  const welkin::Medium air(scene.context, info);
  fog.medium = air;
  check(wlkSetFog(scene.context, &fog));
  EXPECT_NE(scene.radiance({0, 100, 0}, towards(5, 20), INF, 1), droplets);
  fog.medium = WlkMedium{0};
  check(wlkSetFog(scene.context, &fog));
  EXPECT_EQ(scene.radiance({0, 100, 0}, towards(5, 20), INF, 1), droplets);
}

// Light that goes straight on is neither scattered nor lost: extinction (1 - albedo f), with means
// over the colours as volumes have them.
TEST(FogMedium, LetsTheForwardPeakOfRainThrough) {
  const SkyScene scene;
  auto info = make<WlkMediumInfo>();
  info.particle = WLK_PARTICLE_RAIN;
  const welkin::Medium rain(scene.context, info);
  auto optics = make<WlkMediumOptics>();
  check(wlkGetMediumOptics(scene.context, rain, &optics));
  double straight = 0;
  for (const float f : optics.deltaFraction) {
    straight += static_cast<double>(f) / 3;
  }
  ASSERT_GT(straight, 0.3);  // diffraction is half of the extinction
  constexpr double ROUNDING = 4 * 0x1p-24;
  for (const double albedo : {1.0, 0.5}) {
    auto fog = make<WlkFog>();
    fog.extinction = 1e-3F;
    fog.scaleHeight = 1000;
    for (float& a : fog.singleScatteringAlbedo) {
      a = static_cast<float>(albedo);
    }
    fog.medium = rain;
    check(wlkSetFog(scene.context, &fog));
    const double depth = 1 - albedo * straight;
    EXPECT_NEAR(depthAbove(scene, 0)[1], depth, (DEPTH + ROUNDING) * depth);
  }
}

// Elements say how long they are: one does not fit a shorter stride.
TEST(Light, DoesNotFitAShorterStride) {
  const SkyScene scene;
  const auto light = make<WlkLight>();
  EXPECT_EQ(wlkSetLights(scene.context, 1, sizeof light - 8, &light), WLK_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(wlkSetLights(scene.context, 1, sizeof light, &light), WLK_SUCCESS);
}

TEST(Light, IsLitFromAUnitVectorOrShinesItself) {
  const SkyScene scene;
  auto moon = make<WlkLight>();
  const auto set = [&](float x, float y, float z) {
    const float from[3] = {x, y, z};
    std::copy_n(from, 3, moon.litFrom);
    return wlkSetLights(scene.context, 1, sizeof moon, &moon);
  };
  EXPECT_EQ(set(0, 0, 0), WLK_SUCCESS);
  EXPECT_EQ(set(0.6F, -0.8F, 0), WLK_SUCCESS);
  EXPECT_EQ(set(0, 0, 1.0009F), WLK_SUCCESS);
  EXPECT_EQ(set(0, 0, 1.002F), WLK_ERROR_INVALID_ARGUMENT);
  EXPECT_EQ(set(1e-20F, 0, 0), WLK_ERROR_INVALID_ARGUMENT);
}

}  // namespace
}  // namespace welkin::test
