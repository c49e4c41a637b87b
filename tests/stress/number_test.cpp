// SPDX-License-Identifier: MIT
// Every float and double that goes in: NaN, infinities, the largest and smallest numbers, -1, 0.
// A value is either refused, naming the field and changing nothing, or the picture stays finite.
#include <algorithm>
#include <cmath>
#include <limits>

#include "stress/abuse.hpp"

namespace welkin::test {
namespace {

struct NumberField {
  const char* name;
  size_t offset;
  uint32_t count;
  bool isDouble;
};

#define FLOATS(type, field, count) \
  { #field, offsetof(type, field), count, false }
#define DOUBLES(type, field, count) \
  { #field, offsetof(type, field), count, true }

const std::vector<double>& poisons(bool isDouble) {
  using F = std::numeric_limits<float>;
  using D = std::numeric_limits<double>;
  static const std::vector<double> floats{
      F::quiet_NaN(),   F::infinity(), -F::infinity(), F::max(), -F::max(), -1.0, F::denorm_min(),
      -F::denorm_min(), F::min(),      -0.0,           0.0,      1e-30,     1e30, 2.0};
  static const std::vector<double> doubles{
      D::quiet_NaN(),   D::infinity(), -D::infinity(), D::max(), -D::max(), -1.0,  D::denorm_min(),
      -D::denorm_min(), D::min(),      -0.0,           0.0,      1e-300,    1e300, 2.0};
  return isDouble ? doubles : floats;
}

template <typename T>
T poisoned(const T& valid, const NumberField& field, uint32_t index, double value) {
  T bad = valid;
  auto* bytes = reinterpret_cast<unsigned char*>(&bad) + field.offset;
  if (field.isDouble) {
    std::memcpy(bytes + index * sizeof(double), &value, sizeof value);
  } else {
    const auto narrow = static_cast<float>(value);
    std::memcpy(bytes + index * sizeof(float), &narrow, sizeof narrow);
  }
  return bad;
}

// `other` differs from the victim's scene in every field, so that a half-made change shows. `undo`
// takes back what VictimScene::restore does not know.
template <typename T>
void abuseNumbers(
    const T& other, const std::vector<NumberField>& fields,
    const std::function<WlkResult(const T&)>& call, const std::function<void()>& undo = [] {}) {
  VictimScene& victim = VictimScene::get();
  for (const NumberField& field : fields) {
    bool refused = false;
    for (uint32_t i = 0; i < field.count; ++i) {
      const std::vector<double>& values = poisons(field.isDouble);
      for (size_t k = 0; k < values.size(); ++k) {
        // All in a field's first number, which its others are checked like: those take turns.
        if (i > 0 && (k + i) % 3 != 0) {
          continue;
        }
        const double value = values[k];
        SCOPED_TRACE(std::string(field.name) + "[" + std::to_string(i) +
                     "] = " + std::to_string(value));
        const WlkResult result = call(poisoned(other, field, i, value));
        if (result == WLK_SUCCESS) {
          EXPECT_TRUE(std::isfinite(value)) << "a number that is not finite was accepted";
          ASSERT_EQ(wlkPrepare(victim.scene.context), WLK_SUCCESS);
          ASSERT_EQ(wlkRenderHeadless(victim.scene.context, victim.scene.view, nullptr),
                    WLK_SUCCESS);
          EXPECT_EQ(victim.scene.read(WLK_IMAGE_COLOR).badValues(), 0u);
          EXPECT_EQ(victim.scene.stats().nonFinitePixels, 0u);
          victim.restore();
          undo();
          continue;
        }
        refused = true;
        EXPECT_FAILS(result, WLK_ERROR_INVALID_ARGUMENT, field.name);
        EXPECT_EQ(lastError().structType, other.sType);
      }
    }
    EXPECT_TRUE(refused) << field.name << " was never checked";
  }
  victim.expectUnchanged();
}

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
      [&](const WlkAbsorber& p) { return wlkSetAbsorber(c, &p); },
      [&] {
        ASSERT_EQ(wlkSetAbsorber(c, nullptr), WLK_SUCCESS);
        ASSERT_EQ(wlkPrepare(c), WLK_SUCCESS);
      });
}

TEST(NumberFields, OfAmbientLightAreRefusedOrHarmless) {
  const WlkContext c = VictimScene::get().scene.context;
  auto ambient = make<WlkAmbient>();
  ambient.mode = WLK_AMBIENT_GIVEN;
  ambient.sky[2] = 0.5f;
  ambient.harmonics[4] = -0.1f;
  abuseNumbers<WlkAmbient>(
      ambient,
      {FLOATS(WlkAmbient, sky, 3), FLOATS(WlkAmbient, ground, 3),
       FLOATS(WlkAmbient, harmonics, WLK_AMBIENT_VALUES)},
      [&](const WlkAmbient& p) { return wlkSetAmbient(c, &p); },
      [&] {
        auto off = make<WlkAmbient>();
        off.mode = WLK_AMBIENT_OFF;
        ASSERT_EQ(wlkSetAmbient(c, &off), WLK_SUCCESS);
        ASSERT_EQ(wlkPrepare(c), WLK_SUCCESS);
      });
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
