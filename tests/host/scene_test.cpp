// SPDX-License-Identifier: MIT
// Scene files: what they mean and how their mistakes are named.
#include "common/scene.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "expect_input_error.hpp"
#include "temp_folder.hpp"

namespace {

using host_test::expectInputError;

host::Scene parse(const std::string& text, const std::vector<std::string>& assignments = {}) {
  const host_test::TempFolder folder;
  const std::string file = folder.write("s.json", text);
  return host::parseScene(host::readSceneJson(file, assignments), file);
}

void expectSceneError(const std::string& part, const std::string& text,
                      const std::vector<std::string>& assignments = {}) {
  expectInputError(part, [&] { parse(text, assignments); });
}

// Eight digits of a float direction.
constexpr double FLOAT_UNIT = 2.0 * 0x1p-24;

TEST(HostScene, StartsWithNothingButDefaults) {
  const host::Scene scene = parse("{}");
  EXPECT_FALSE(scene.sky.has_value());
  EXPECT_FALSE(scene.fog.has_value());
  EXPECT_TRUE(scene.lights.empty());
  EXPECT_EQ(scene.planet.up[1], 1.0f);
  EXPECT_EQ(scene.view.width, 1280u);
  EXPECT_EQ(scene.view.targetFormat, uint32_t{WLK_TARGET_RGBA32_FLOAT});
  EXPECT_EQ(scene.quality.level, uint32_t{WLK_QUALITY_HIGH});
}

TEST(HostScene, ReadsEverySection) {
  const host::Scene scene = parse(R"({
    // comments are allowed
    "planet": {"radius": 1e6, "groundAlbedo": 0.3},
    "sky": {}, "fog": {"model": "analytic", "dropletDiameter_um": 5, "extinction": 0.01,
            "scaleHeight": 50},
    "lights": [{"elevation_deg": 30, "azimuth_deg": 90, "irradiance": [1, 2, 3]}],
    "media": {"drop": {"particle": "henyey-greenstein", "asymmetry": 0.5}},
    "volumes": [{"source": {"type": "cumulus", "size": [8, 8, 8]},
                 "fields": [{"medium": "drop", "extinctionScale": 0.05, "diameters":
                   {"type": "gradient", "size": [8, 4, 8], "axis": "y", "from": 2, "to": 16}}],
                 "transform": {"min": [0, 1, 2], "size": [3, 4, 5]}}],
    "quality": {"level": "low", "slicing": "light-aligned", "scattering": "single",
                "noSkip": true},
    "view": {"size": [64, 32], "composite": "separate", "layers": ["sky", "fog"]},
    "camera": {"position": [1, 2, 3], "yaw_deg": 90, "verticalFov_deg": 50},
    "opaque": {"geometry": [{"type": "terrain"}, {"type": "sphere", "centre": [0, 0, 0]}]},
    "png": {"exposure_stops": 2, "toneMap": "linear"}})");
  EXPECT_EQ(scene.planet.radius, 1e6f);
  EXPECT_EQ(scene.planet.groundAlbedo[2], 0.3f);
  ASSERT_EQ(scene.lights.size(), 1u);
  // 30 degrees up in the east, which is +x.
  EXPECT_NEAR(scene.lights[0].direction[0], std::sqrt(0.75), FLOAT_UNIT);
  EXPECT_NEAR(scene.lights[0].direction[1], 0.5, FLOAT_UNIT);
  EXPECT_NEAR(scene.lights[0].direction[2], 0.0, FLOAT_UNIT);
  EXPECT_EQ(scene.lights[0].irradiance[2], 3.0f);
  EXPECT_EQ(scene.fog->dropletDiameter_um, 5.0f);
  EXPECT_EQ(scene.fog->phaseModel, uint32_t{WLK_PHASE_ANALYTIC});
  EXPECT_EQ(scene.media[0].info.particle, uint32_t{WLK_PARTICLE_HENYEY_GREENSTEIN});
  EXPECT_EQ(scene.media[0].info.asymmetry, 0.5f);
  EXPECT_EQ(scene.volumes[0].fields[0].extinctionScale, 0.05);
  ASSERT_TRUE(scene.volumes[0].fields[0].diameters);
  const host::Grid diameters = host::loadSource(*scene.volumes[0].fields[0].diameters);
  ASSERT_EQ(diameters.values.size(), 8u * 4 * 8);
  EXPECT_FLOAT_EQ(diameters.values[7], 2.0f);
  EXPECT_FLOAT_EQ(diameters.values[8], 4.0f);
  EXPECT_FLOAT_EQ(diameters.values.back(), 16.0f);
  EXPECT_TRUE(scene.volumes[0].placement.box);
  EXPECT_EQ(scene.quality.slicing, uint32_t{WLK_SLICING_LIGHT_ALIGNED});
  EXPECT_EQ(scene.quality.scattering, uint32_t{WLK_SCATTERING_SINGLE});
  EXPECT_EQ(scene.quality.flags, uint64_t{WLK_QUALITY_FLAG_NO_SKIP});
  EXPECT_EQ(scene.view.layers, uint64_t{WLK_LAYER_SKY | WLK_LAYER_FOG});
  EXPECT_EQ(scene.view.composite, uint32_t{WLK_COMPOSITE_SEPARATE});
  EXPECT_DOUBLE_EQ(scene.camera.forward.x, 1.0);
  EXPECT_TRUE(scene.geometry->terrain.has_value());
  EXPECT_EQ(scene.geometry->spheres.size(), 1u);
  EXPECT_EQ(scene.png.toneMap, host::ToneMap::Linear);
}

TEST(HostScene, StartsFromAnAtmosphereThatSectionsChange) {
  const host::Scene mars = parse(R"({"atmosphere": "mars", "lights": [{}]})");
  EXPECT_EQ(mars.planet.radius, 3.3895e6f);
  EXPECT_LT(mars.sky->rayleighScattering[2], 1e-6f);
  EXPECT_EQ(mars.absorber->absorption[1], 0.0f);
  EXPECT_EQ(mars.fog->scaleHeight, 11000.0f);
  EXPECT_EQ(mars.fogMedium->info.particle, uint32_t{WLK_PARTICLE_HENYEY_GREENSTEIN});
  EXPECT_LT(mars.lights[0].irradiance[0], 0.5f);
  EXPECT_GT(mars.lights[0].limbDarkening[0], 0.3f);
  const host::Scene changed = parse(R"({"atmosphere": "earth-hazy", "planet": {"radius": 7e6},
    "sky": {"scaleHeight": 9000}, "absorber": null, "fog": {"extinction": 0.5}})");
  EXPECT_EQ(changed.planet.radius, 7e6f);
  EXPECT_EQ(changed.sky->scaleHeight, 9000.0f);
  EXPECT_EQ(changed.sky->rayleighScattering[0], 5.8e-6f);
  EXPECT_FALSE(changed.absorber.has_value());
  EXPECT_EQ(changed.fog->extinction, 0.5f);
  EXPECT_EQ(changed.fog->scaleHeight, 1500.0f);
  EXPECT_EQ(changed.fogMedium->info.particle, uint32_t{WLK_PARTICLE_HAZE});
  const host::Scene bare = parse(R"({"atmosphere": "earth-clear"})", {"fog=null", "sky=null"});
  EXPECT_FALSE(bare.fog || bare.fogMedium || bare.sky);
  EXPECT_TRUE(bare.absorber.has_value());
  // Droplets of the user's own are droplets.
  const host::Scene droplets =
      parse(R"({"atmosphere": "earth-hazy", "fog": {"dropletDiameter_um": 5}})");
  EXPECT_FALSE(droplets.fogMedium.has_value());
  EXPECT_EQ(droplets.fog->dropletDiameter_um, 5.0f);
  expectSceneError("atmosphere: expected one of earth-clear, earth-hazy, earth-polluted, mars",
                   R"({"atmosphere": "venus"})");
}

TEST(HostScene, ReadsAbsorberFogMediumAndMoon) {
  const host::Scene scene = parse(R"({"absorber": {"peakAltitude": 20000},
    "media": {"dust": {"particle": "henyey-greenstein", "asymmetry": 0.7}},
    "fog": {"medium": "dust", "extinction": 1e-4, "singleScatteringAlbedo": 0.9},
    "lights": [{"elevation_deg": -20, "limbDarkening": "sun", "irradiance": [1, 2, 3]},
               {"moon": true, "elevation_deg": 40, "limbDarkening": 0.25},
               {"litFrom": [0, 0, -2], "limbDarkening": [0, 1, 2]}]})");
  EXPECT_EQ(scene.absorber->peakAltitude, 20000.0f);
  EXPECT_EQ(scene.absorber->halfWidth, 15000.0f);
  EXPECT_EQ(scene.fogMedium->info.asymmetry, 0.7f);
  EXPECT_EQ(scene.fog->singleScatteringAlbedo[1], 0.9f);
  EXPECT_EQ(scene.fog->medium.id, 0u);
  ASSERT_EQ(scene.lights.size(), 3u);
  EXPECT_GT(scene.lights[0].limbDarkening[2], scene.lights[0].limbDarkening[0]);
  const WlkLight& moon = scene.lights[1];
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(moon.litFrom[i], scene.lights[0].direction[i], FLOAT_UNIT);
  }
  EXPECT_NEAR(moon.direction[1], std::sin(40.0 * host::RADIANS_PER_DEGREE), FLOAT_UNIT);
  EXPECT_LT(moon.irradiance[0], 1e-4f);
  EXPECT_EQ(moon.limbDarkening[0], 0.25f);
  EXPECT_EQ(scene.lights[2].litFrom[2], -1.0f);
  EXPECT_EQ(scene.lights[2].limbDarkening[2], 2.0f);
  expectSceneError("fog.medium: expected the name of one of media, got \"dust\"",
                   R"({"fog": {"medium": "dust"}})");
  expectSceneError("fog: expected medium, or model and dropletDiameter_um, not both",
                   R"({"media": {"d": {}}, "fog": {"medium": "d", "model": "table"}})");
  expectSceneError("lights.0.moon: expected a light before the moon",
                   R"({"lights": [{"moon": true}]})");
  expectSceneError("lights.0.limbDarkening: expected one of sun",
                   R"({"lights": [{"limbDarkening": "moon"}]})");
  expectSceneError("lights.0.litFrom: expected a vector that is not 0",
                   R"({"lights": [{"litFrom": [0, 0, 0]}]})");
  expectSceneError("absorber.extinktion: unknown key", R"({"absorber": {"extinktion": 1}})");
}

TEST(HostScene, NamesTheKeyAndTheExpectedValue) {
  expectSceneError("s.json: fgo: unknown key; expected one of", R"({"fgo": {}})");
  expectSceneError("fog.extinktion: unknown key", R"({"fog": {"extinktion": 1}})");
  expectSceneError("fog.extinction: expected a number, got \"x\"",
                   R"({"fog": {"extinction": "x"}})");
  expectSceneError("fog: expected an object, got 3", R"({"fog": 3})");
  expectSceneError("lights: expected an array", R"({"lights": {}})");
  expectSceneError("lights.1.irradiance: expected a number or [r, g, b]",
                   R"({"lights": [{}, {"irradiance": [1, 2]}]})");
  expectSceneError("lights.0.elevation_deg: expected a number in [-90, 90]",
                   R"({"lights": [{"elevation_deg": 91}]})");
  expectSceneError("lights.0.direction: expected a vector that is not 0",
                   R"({"lights": [{"direction": [0, 0, 0]}]})");
  expectSceneError("view.size.0: expected a whole number in [1, 16384], got 0",
                   R"({"view": {"size": [0, 5]}})");
  expectSceneError("view.size: expected [width, height]", R"({"view": {"size": [4]}})");
  expectSceneError("quality.level: expected one of low, medium, high, ultra, got \"best\"",
                   R"({"quality": {"level": "best"}})");
  expectSceneError("camera.target: expected a point away",
                   R"({"camera": {"position": [1, 1, 1], "target": [1, 1, 1]}})");
  expectSceneError("camera.verticalFov_deg: expected a number in [0.1, 170]",
                   R"({"camera": {"verticalFov_deg": 180}})");
}

TEST(HostScene, ReadsEveryKeyOfMediaInTheOrderOfTheApi) {
  const host::Scene scene = parse(R"({"media": {
    "a": {}, "b": {"particle": "cloud", "model": "table", "diameter_um": 7, "spread": 0.1,
                   "wavelength_um": 0.5, "singleScatteringAlbedo": [0.1, 0.2, 0.3]},
    "c": {"particle": "snow", "roughness": 0.4}}})");
  ASSERT_EQ(scene.media.size(), 3u);
  EXPECT_EQ(scene.media[0].info.particle, uint32_t{WLK_PARTICLE_CLOUD});
  EXPECT_EQ(scene.media[0].info.phaseModel, uint32_t{WLK_PHASE_DEFAULT});
  EXPECT_EQ(scene.media[0].info.diameter_um, 0.0f);
  const WlkMediumInfo& b = scene.media[1].info;
  EXPECT_EQ(b.phaseModel, uint32_t{WLK_PHASE_TABLE});
  EXPECT_EQ(b.diameter_um, 7.0f);
  EXPECT_EQ(b.spread, 0.1f);
  EXPECT_EQ(b.wavelength_um, 0.5f);
  EXPECT_EQ(b.singleScatteringAlbedo[1], 0.2f);
  EXPECT_EQ(scene.media[2].info.roughness, 0.4f);
  const std::vector<std::pair<std::string, uint32_t>> words = {
      {"cloud", WLK_PARTICLE_CLOUD},
      {"fog", WLK_PARTICLE_FOG},
      {"haze", WLK_PARTICLE_HAZE},
      {"rain", WLK_PARTICLE_RAIN},
      {"ice-column", WLK_PARTICLE_ICE_COLUMN},
      {"ice-plate", WLK_PARTICLE_ICE_PLATE},
      {"snow", WLK_PARTICLE_SNOW},
      {"air", WLK_PARTICLE_AIR},
      {"henyey-greenstein", WLK_PARTICLE_HENYEY_GREENSTEIN}};
  for (const auto& [word, value] : words) {
    const host::Scene one = parse(R"({"media": {"m": {"particle": ")" + word + "\"}}}");
    EXPECT_EQ(one.media[0].info.particle, value) << word;
  }
  const host::Scene whole = parse(R"({"quality": {"scattering": "forward-integer"}})");
  EXPECT_EQ(whole.quality.scattering, uint32_t{WLK_SCATTERING_FORWARD_INTEGER});
}

TEST(HostScene, ReadsTheTableOfAUserMedium) {
  const host_test::TempFolder folder;
  static_cast<void>(
      folder.write("p.csv", "angle_deg,red,green,blue\n0,3,2,1\n90,1,1,1\n180,0,4,5\n"));
  const std::string file =
      folder.write("s.json", R"({"media": {"m": {"particle": "user", "file": "p.csv"}}})");
  const host::Scene scene = host::parseScene(host::readSceneJson(file, {}), file);
  // A copy has pointers of its own.
  const host::Scene copy = scene;
  const WlkMediumInfo info = host::mediumInfo(copy.media[0]);
  ASSERT_EQ(info.userCount, 3u);
  EXPECT_EQ(info.userAngle, copy.media[0].userAngle.data());
  EXPECT_EQ(info.userAngle[0], 0.0);
  EXPECT_EQ(info.userAngle[2], host::PI);
  EXPECT_EQ(info.userPhase[2], 1.0);
  EXPECT_EQ(info.userPhase[8], 5.0);
}

TEST(HostScene, NamesMistakesInMedia) {
  expectSceneError("media.m.particle: expected one of cloud, fog, haze, rain",
                   R"({"media": {"m": {"particle": "mist"}}})");
  expectSceneError("media.m.model: expected one of default, analytic, table, got \"mie\"",
                   R"({"media": {"m": {"model": "mie"}}})");
  expectSceneError("fog.model: expected one of default, analytic, table",
                   R"({"fog": {"model": "x"}})");
  expectSceneError("media.m.phase: unknown key", R"({"media": {"m": {"phase": "hg"}}})");
  expectSceneError("media.m.spread: expected a number", R"({"media": {"m": {"spread": "x"}}})");
  expectSceneError("media.m: expected file", R"({"media": {"m": {"particle": "user"}}})");
  const host_test::TempFolder folder;
  const auto expectTableError = [&](const std::string& part, const std::string& table,
                                    const std::string& particle = "user") {
    static_cast<void>(folder.write("p.csv", table));
    const std::string file = folder.write(
        "s.json", R"({"media": {"m": {"file": "p.csv", "particle": ")" + particle + "\"}}}");
    expectInputError(part, [&] { host::parseScene(host::readSceneJson(file, {}), file); });
  };
  const std::string good = "0,1,1,1\n180,1,1,1\n";
  expectTableError("media.m.file: expected only with particle user", good, "cloud");
  expectTableError("p.csv: line 1: expected the columns", "angle,red,green,blue\n" + good);
  expectTableError("p.csv: line 1: expected the columns", "0,1\n180,1\n");
  expectTableError("p.csv: expected 2 to 65536 rows, got 1", "0,1,1,1\n");
  expectTableError("line 1, column angle_deg: expected 0 degrees", "1,1,1,1\n180,1,1,1\n");
  expectTableError("line 2, column angle_deg: expected 180 degrees", "0,1,1,1\n179,1,1,1\n");
  expectTableError("line 3, column angle_deg: expected more",
                   "0,1,1,1\n90,1,1,1\n90,1,1,1\n180,1,1,1\n");
  expectTableError("line 2, column green: expected a finite", "0,1,1,1\n180,1,-1,1\n");
  expectTableError("line 1, column blue: expected a finite", "0,1,1,inf\n180,1,1,1\n");
  expectTableError("line 1, column red: expected a number", "0,nan,1,1\n180,1,1,1\n");
}

TEST(HostScene, NamesMistakesInVolumes) {
  const std::string field = R"("fields": [{"medium": "m"}])";
  const auto volume = [](const std::string& text) {
    return R"({"media": {"m": {}}, "volumes": [{)" + text + "}]}";
  };
  expectSceneError("volumes.0.fields: expected a value, got none", volume(""));
  expectSceneError("volumes.0.fields.0: expected a source", volume(field));
  expectSceneError("volumes.0.fields.0.medium: expected the name of one of media",
                   volume(R"("fields": [{"medium": "fog"}])"));
  expectSceneError(
      "volumes.0.source.type: expected one of raw, les, vdb, cumulus, slab, gradient, got \"obj\"",
      volume(R"("source": {"type": "obj"}, )" + field));
  expectSceneError("volumes.0.source.file: expected a value, got none",
                   volume(R"("source": {"type": "vdb"}, )" + field));
  expectSceneError("volumes.0.source.size.1: expected a whole number",
                   volume(R"("source": {"type": "cumulus", "size": [4, 0, 4]}, )" + field));
  expectSceneError("volumes.0.source.edge: expected three lengths >= 0",
                   volume(R"("source": {"type": "slab", "edge": [0, -1, 0]}, )" + field));
  expectSceneError(
      "volumes.0.source.from: expected a number in",
      volume(R"("source": {"type": "gradient", "size": [1, 1, 1], "from": 0}, )" + field));
  expectSceneError("volumes.0.source.noise: expected a number in [0, 1]",
                   volume(R"("source": {"type": "slab", "noise": 1.5}, )" + field));
  expectSceneError("volumes.0.transform: expected min and size, or",
                   volume(R"("source": {"type": "cumulus"}, "transform": {"min": [0, 0, 0],
                             "size": [1, 1, 1], "scale": 2}, )" +
                          field));
  expectSceneError("volumes.0.transform.size: expected three positive",
                   volume(R"("source": {"type": "cumulus"}, "transform": {"min": [0, 0, 0],
                             "size": [1, -1, 1]}, )" +
                          field));
}

TEST(HostScene, RefusesTextThatIsNoJson) {
  expectSceneError("expected JSON: parse error at line 1", "{");
  expectSceneError("expected JSON: parse error", R"({"fog": {"extinction": NaN}})");
  expectSceneError("expected JSON", R"({"fog": {"extinction": 1e999}})");
  expectSceneError("expected JSON", "");
  expectSceneError("expected a JSON object", "[1]");
  expectSceneError("64 levels", std::string(100000, '['));
  expectSceneError("fog.extinction: expected a number", R"({"fog": {"extinction": 1e300}})");
  expectInputError("no such file", [] { host::readSceneJson("/nowhere/s.json", {}); });
}

TEST(HostScene, TakesAssignments) {
  const std::string text = R"({"lights": [{"irradiance": 1}], "fog": {"extinction": 1}})";
  const host::Scene scene = parse(
      text, {"lights.0.irradiance=[4,5,6]", "camera.near=2", "fog=null", "quality.level=ultra"});
  EXPECT_EQ(scene.lights[0].irradiance[1], 5.0f);
  EXPECT_EQ(scene.camera.nearPlane, 2.0);
  EXPECT_FALSE(scene.fog.has_value());
  EXPECT_EQ(scene.quality.level, uint32_t{WLK_QUALITY_ULTRA});
  expectSceneError("lights.1.irradiance: expected an index below 1", text,
                   {"lights.1.irradiance=3"});
  expectSceneError("fog.extinktion: unknown key", text, {"fog.extinktion=3"});
  expectSceneError("expected key.path=value", text, {"fog"});
  expectSceneError("inside a value", text, {"fog.extinction.x=3"});
  expectSceneError("single dots", text, {"fog..extinction=3"});
  expectSceneError("got \"nan\"", text, {"fog.extinction=nan"});
}

TEST(HostScene, MergesOverItsBase) {
  const host_test::TempFolder folder;
  static_cast<void>(folder.write("base.json", R"({"fog": {"extinction": 1, "scaleHeight": 7}})"));
  const std::string file =
      folder.write("s.json", R"({"base": "base.json", "fog": {"extinction": 2}})");
  const host::Scene scene = host::parseScene(host::readSceneJson(file, {}), file);
  EXPECT_EQ(scene.fog->extinction, 2.0f);
  EXPECT_EQ(scene.fog->scaleHeight, 7.0f);
  // A null takes a section away, whether the base or its atmosphere had it.
  static_cast<void>(folder.write("air.json", R"({"atmosphere": "mars"})"));
  const std::string clear = folder.write("clear.json", R"({"base": "air.json", "fog": null})");
  EXPECT_FALSE(host::parseScene(host::readSceneJson(clear, {}), clear).fog.has_value());
  const std::string loop = folder.write("loop.json", R"({"base": "loop.json"})");
  expectInputError("at most 8", [&] { host::readSceneJson(loop, {}); });
}

}  // namespace
