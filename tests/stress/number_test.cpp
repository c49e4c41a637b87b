// SPDX-License-Identifier: MIT
// Numbers of the scene, the camera, media and volumes (number_abuse.hpp).
#include "stress/number_abuse.hpp"

namespace welkin::test {
namespace {

TEST(NumberFields, OfPlanetAndSkyAreRefusedOrHarmless) {
  const WlkContext c = VictimScene::get().scene.context;
  auto planet = make<WlkPlanet>();
  planet.radius = 3e6f;
  planet.groundAlbedo[0] = 0.5f;
  planet.seaLevelPoint[1] = -30;
  abuseNumbers<WlkPlanet>(planet,
                          {DOUBLES(WlkPlanet, seaLevelPoint, 3), FLOATS(WlkPlanet, up, 3),
                           FLOATS(WlkPlanet, radius, 1), FLOATS(WlkPlanet, groundAlbedo, 3)},
                          [&](const WlkPlanet& p) { return wlkSetPlanet(c, &p); });
  auto sky = make<WlkSky>();
  sky.scaleHeight = 5000.0f;
  sky.rayleighScattering[0] = 1e-4f;
  abuseNumbers<WlkSky>(sky, {FLOATS(WlkSky, rayleighScattering, 3), FLOATS(WlkSky, scaleHeight, 1)},
                       [&](const WlkSky& p) { return wlkSetSky(c, &p); });
}

TEST(NumberFields, OfAbsorbersAreRefusedOrHarmless) {
  const WlkContext c = VictimScene::get().scene.context;
  auto absorber = make<WlkAbsorber>();
  absorber.peakAltitude = 15000.0f;
  absorber.absorption[1] = 1e-4f;
  abuseNumbers<WlkAbsorber>(
      absorber,
      {FLOATS(WlkAbsorber, absorption, 3), FLOATS(WlkAbsorber, peakAltitude, 1),
       FLOATS(WlkAbsorber, halfWidth, 1)},
      [&](const WlkAbsorber& p) { return wlkSetAbsorber(c, &p); });
}

TEST(NumberFields, OfAmbientLightAreRefusedOrHarmless) {
  const WlkContext c = VictimScene::get().scene.context;
  auto ambient = make<WlkAmbient>();
  ambient.mode = WLK_AMBIENT_GIVEN;
  ambient.sky[2] = 0.5f;
  ambient.harmonics[4] = -0.1f;
  abuseNumbers<WlkAmbient>(ambient,
                           {FLOATS(WlkAmbient, sky, 3), FLOATS(WlkAmbient, ground, 3),
                            FLOATS(WlkAmbient, harmonics, WLK_AMBIENT_VALUES)},
                           [&](const WlkAmbient& p) { return wlkSetAmbient(c, &p); });
}

TEST(NumberFields, OfLightAndFogAreRefusedOrHarmless) {
  const WlkContext c = VictimScene::get().scene.context;
  auto light = make<WlkLight>();
  light.direction[0] = 0.8f;
  light.direction[1] = 0.6f;
  light.irradiance[2] = 3.0f;
  light.limbDarkening[0] = 0.5f;
  light.litFrom[1] = 0.6f;
  light.litFrom[2] = -0.8f;
  abuseNumbers<WlkLight>(light,
                         {FLOATS(WlkLight, direction, 3), FLOATS(WlkLight, angularDiameter, 1),
                          FLOATS(WlkLight, irradiance, 3), FLOATS(WlkLight, limbDarkening, 3),
                          FLOATS(WlkLight, litFrom, 3)},
                         [&](const WlkLight& p) { return wlkSetLights(c, 1, sizeof p, &p); });
  auto fog = make<WlkFog>();
  fog.extinction = 0.01f;
  abuseNumbers<WlkFog>(fog,
                       {FLOATS(WlkFog, dropletDiameter_um, 1), FLOATS(WlkFog, extinction, 1),
                        FLOATS(WlkFog, baseAltitude, 1), FLOATS(WlkFog, scaleHeight, 1),
                        FLOATS(WlkFog, singleScatteringAlbedo, 3)},
                       [&](const WlkFog& p) { return wlkSetFog(c, &p); });
}

TEST(NumberFields, OfTheCameraAreRefusedOrHarmless) {
  const HeadlessScene& scene = VictimScene::get().scene;
  auto camera = make<WlkCamera>();
  camera.position[0] = 100;
  camera.preExposure = 2.0f;
  abuseNumbers<WlkCamera>(
      camera,
      {DOUBLES(WlkCamera, position, 3), FLOATS(WlkCamera, viewFromWorld, 9),
       FLOATS(WlkCamera, preExposure, 1), FLOATS(WlkCamera, clipFromView, 16)},
      [&](const WlkCamera& p) { return wlkSetCamera(scene.context, scene.view, &p); });
}

TEST(NumberFields, OfMediaAreRefusedOrMakeAFiniteVolume) {
  VictimScene& victim = VictimScene::get();
  const WlkContext c = victim.scene.context;
  for (const uint32_t particle : {WLK_PARTICLE_CLOUD, WLK_PARTICLE_RAIN, WLK_PARTICLE_SNOW,
                                  WLK_PARTICLE_AIR, WLK_PARTICLE_HENYEY_GREENSTEIN}) {
    auto info = make<WlkMediumInfo>();
    info.particle = particle;
    std::vector<NumberField> fields;
    if (particle == WLK_PARTICLE_CLOUD) {
      fields = {FLOATS(WlkMediumInfo, singleScatteringAlbedo, 3),
                FLOATS(WlkMediumInfo, wavelength_um, 1)};
    }
    if (particle == WLK_PARTICLE_CLOUD || particle == WLK_PARTICLE_RAIN) {
      fields.push_back(FLOATS(WlkMediumInfo, diameter_um, 1));
      fields.push_back(FLOATS(WlkMediumInfo, spread, 1));
    } else if (particle == WLK_PARTICLE_SNOW) {
      fields.push_back(FLOATS(WlkMediumInfo, roughness, 1));
    } else if (particle == WLK_PARTICLE_HENYEY_GREENSTEIN) {
      fields.push_back(FLOATS(WlkMediumInfo, asymmetry, 1));
    } else {
      fields.push_back(FLOATS(WlkMediumInfo, singleScatteringAlbedo, 3));
    }
    abuseNumbers<WlkMediumInfo>(info, fields, [&](const WlkMediumInfo& p) {
      WlkMedium medium{};
      const WlkResult result = wlkCreateMedium(c, &p, &medium);
      EXPECT_EQ(result == WLK_SUCCESS, medium.id != 0);
      if (medium.id != 0) {
        // The medium's phase function over the whole sphere, then away with it.
        const double angles[4] = {0.0, 1e-3, 1.6, 3.1415926535897931};
        double values[12];
        std::fill_n(values, 12, -1.0);
        auto query = make<WlkPhaseQuery>();
        query.medium = medium;
        query.count = 4;
        query.scatteringAngle = angles;
        EXPECT_EQ(wlkEvalPhase(c, &query, values), WLK_SUCCESS);
        for (const double value : values) {
          EXPECT_TRUE(std::isfinite(value) && value >= 0) << value;
        }
        EXPECT_EQ(wlkDestroyMedium(c, medium), WLK_SUCCESS);
      }
      return result;
    });
  }
}

TEST(NumberFields, OfVolumeTransformsAreRefusedOrHarmless) {
  VictimScene& victim = VictimScene::get();
  const WlkContext c = victim.scene.context;
  auto info = make<WlkVolumeInfo>();
  const auto transform = boxTransform({-100, 10, -700}, {200, 300, 400});
  std::memcpy(info.worldFromVolume, transform.data(), sizeof info.worldFromVolume);
  abuseNumbers<WlkVolumeInfo>(info, {DOUBLES(WlkVolumeInfo, worldFromVolume, 12)},
                              [&](const WlkVolumeInfo& p) {
                                return wlkSetVolumeTransform(c, victim.volume, p.worldFromVolume);
                              });
}

TEST(NumberFields, OfNewVolumesAreRefusedBeforeAnythingIsMade) {
  VictimScene& victim = VictimScene::get();
  for (const double value : poisons(false)) {
    WlkVolumeField field{};
    field.medium = victim.medium;
    field.extinctionScale = static_cast<float>(value);
    auto info = make<WlkVolumeInfo>();
    info.fieldCount = 1;
    info.fields = &field;
    WlkVolume volume{};
    const WlkResult result = wlkCreateVolume(victim.scene.context, &info, &volume);
    if (value >= 0 && value <= 1e6) {
      EXPECT_EQ(result, WLK_SUCCESS) << value;
      EXPECT_EQ(wlkDestroyVolume(victim.scene.context, volume), WLK_SUCCESS);
    } else {
      EXPECT_FAILS(result, WLK_ERROR_INVALID_ARGUMENT, "extinctionScale") << value;
      EXPECT_EQ(volume.id, 0u);
    }
  }
  ASSERT_EQ(wlkPrepare(victim.scene.context), WLK_SUCCESS);
  victim.expectUnchanged();
}

}  // namespace
}  // namespace welkin::test
