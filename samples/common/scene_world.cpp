// SPDX-License-Identifier: MIT
// The sections atmosphere, planet, sky, absorber, lights, fog.
#include <algorithm>

#include "common/api.hpp"
#include "common/scene.hpp"

namespace host {
namespace {

// What a scene starts from.
struct Initial {
  WlkPlanet planet = make<WlkPlanet>();
  WlkSky sky = make<WlkSky>();
  WlkAbsorber absorber = make<WlkAbsorber>();
  WlkFog haze = make<WlkFog>();
  WlkLight sun = make<WlkLight>();
};

Initial presetOf(uint32_t which) {
  return {makePreset<WlkPlanet>(which), makePreset<WlkSky>(which), makePreset<WlkAbsorber>(which),
          makePreset<WlkFog>(which), makePreset<WlkLight>(which)};
}

void storeVector(const Vec3& v, float (&out)[3]) {
  out[0] = static_cast<float>(v.x);
  out[1] = static_cast<float>(v.y);
  out[2] = static_cast<float>(v.z);
}

// A vector of any length but 0.
Vec3 parseDirection(const JsonNode& node) {
  const Vec3 direction = node.vec3();
  if (!(length(direction) > 0.0)) {
    node.fail("expected a vector that is not 0");
  }
  return normalize(direction);
}

// Each section starts from `initial`: the library's defaults or those of an atmosphere.
WlkPlanet parsePlanet(const JsonNode& node, const WlkPlanet& initial) {
  node.onlyKeys({"seaLevelPoint", "up", "radius", "groundAlbedo"});
  WlkPlanet planet = initial;
  Vec3 point{planet.seaLevelPoint[0], planet.seaLevelPoint[1], planet.seaLevelPoint[2]};
  node.optional("seaLevelPoint", point);
  planet.seaLevelPoint[0] = point.x;
  planet.seaLevelPoint[1] = point.y;
  planet.seaLevelPoint[2] = point.z;
  if (node.has("up")) {
    storeVector(parseDirection(node.at("up")), planet.up);
  }
  node.optional("radius", planet.radius);
  node.optional("groundAlbedo", planet.groundAlbedo);
  return planet;
}

WlkSky parseSky(const JsonNode& node, const WlkSky& initial) {
  node.onlyKeys({"rayleighScattering", "scaleHeight"});
  WlkSky sky = initial;
  node.optional("rayleighScattering", sky.rayleighScattering);
  node.optional("scaleHeight", sky.scaleHeight);
  return sky;
}

WlkAbsorber parseAbsorber(const JsonNode& node, const WlkAbsorber& initial) {
  node.onlyKeys({"extinction", "peakAltitude", "halfWidth"});
  WlkAbsorber absorber = initial;
  node.optional("extinction", absorber.absorption);
  node.optional("peakAltitude", absorber.peakAltitude);
  node.optional("halfWidth", absorber.halfWidth);
  return absorber;
}

WlkAmbient parseAmbient(const JsonNode& node) {
  auto ambient = make<WlkAmbient>();
  if (node.isText()) {
    ambient.mode = static_cast<uint32_t>(node.word({"off", "automatic"}));
    return ambient;
  }
  node.onlyKeys({"sky", "ground", "harmonics"});
  ambient.mode = WLK_AMBIENT_GIVEN;
  node.optional("sky", ambient.sky);
  node.optional("ground", ambient.ground);
  if (node.has("harmonics")) {
    const std::vector<JsonNode> values = node.at("harmonics").elements();
    if (values.size() != WLK_AMBIENT_VALUES) {
      node.at("harmonics").fail("expected 27 numbers: 9 coefficients of 3 colours");
    }
    for (size_t i = 0; i < values.size(); ++i) {
      ambient.harmonics[i] = static_cast<float>(values[i].number());
    }
  }
  return ambient;
}

Vec3 parseLightDirection(const JsonNode& node) {
  if (node.has("direction")) {
    if (node.has("elevation_deg") || node.has("azimuth_deg")) {
      node.fail("expected direction, or elevation_deg and azimuth_deg, not both");
    }
    return parseDirection(node.at("direction"));
  }
  if (node.has("elevation_deg") || node.has("azimuth_deg")) {
    const double azimuth = node.has("azimuth_deg") ? node.at("azimuth_deg").number() : 0.0;
    return directionFromAngles(node.at("elevation_deg").number(-90.0, 90.0), azimuth);
  }
  return {0.0, 1.0, 0.0};
}

// The Moon, lit by the first light.
WlkLight parseMoon(const JsonNode& node, const Scene& scene, const float (&direction)[3]) {
  if (scene.lights.empty()) {
    node.at("moon").fail("expected a light before the moon: what lights it");
  }
  const WlkLight& sun = scene.lights.front();
  auto moon = make<WlkLight>();
  check(wlkInitMoon(sun.direction, direction, sun.irradiance, &moon), node.file(), node.path());
  return moon;
}

WlkLight parseLight(const JsonNode& node, const Scene& scene, const WlkLight& sun) {
  node.onlyKeys({"direction", "elevation_deg", "azimuth_deg", "angularDiameter_deg", "irradiance",
                 "limbDarkening", "litFrom", "moon"});
  float direction[3];
  storeVector(parseLightDirection(node), direction);
  const bool moon = node.has("moon") && node.at("moon").boolean();
  WlkLight light = moon ? parseMoon(node, scene, direction) : sun;
  std::copy_n(direction, 3, light.direction);
  if (node.has("angularDiameter_deg")) {
    light.angularDiameter =
        static_cast<float>(node.at("angularDiameter_deg").number() * RADIANS_PER_DEGREE);
  }
  node.optional("irradiance", light.irradiance);
  if (node.has("limbDarkening") && node.at("limbDarkening").isText()) {
    static_cast<void>(node.at("limbDarkening").word({"sun"}));
    std::copy_n(presetOf(WLK_ATMOSPHERE_EARTH_CLEAR).sun.limbDarkening, 3, light.limbDarkening);
  } else {
    node.optional("limbDarkening", light.limbDarkening);
  }
  if (node.has("litFrom")) {
    storeVector(parseDirection(node.at("litFrom")), light.litFrom);
  }
  return light;
}

const MediumDesc& mediumNamed(const JsonNode& node, const Scene& scene) {
  const std::string name = node.text();
  const auto found = std::find_if(scene.media.begin(), scene.media.end(),
                                  [&](const MediumDesc& medium) { return medium.name == name; });
  if (found == scene.media.end()) {
    node.fail("expected the name of one of media");
  }
  return *found;
}

void parseFog(const JsonNode& node, const WlkFog& initial, Scene& scene) {
  node.onlyKeys({"model", "dropletDiameter_um", "medium", "extinction", "baseAltitude",
                 "scaleHeight", "singleScatteringAlbedo"});
  WlkFog fog = initial;
  const bool droplets = node.has("model") || node.has("dropletDiameter_um");
  if (node.has("medium")) {
    if (droplets) {
      node.fail("expected medium, or model and dropletDiameter_um, not both");
    }
    scene.fogMedium = mediumNamed(node.at("medium"), scene);
  } else if (droplets) {
    scene.fogMedium.reset();
  }
  if (node.has("model")) {
    fog.phaseModel = parsePhaseModel(node.at("model"));
  }
  node.optional("dropletDiameter_um", fog.dropletDiameter_um);
  node.optional("extinction", fog.extinction);
  node.optional("baseAltitude", fog.baseAltitude);
  node.optional("scaleHeight", fog.scaleHeight);
  node.optional("singleScatteringAlbedo", fog.singleScatteringAlbedo);
  scene.fog = fog;
}

}  // namespace

void parseWorld(const JsonNode& root, Scene& scene) {
  Initial initial;
  if (root.has("atmosphere")) {
    const uint32_t which =
        root.at("atmosphere").word({"earth-clear", "earth-hazy", "earth-polluted", "mars"});
    initial = presetOf(which);
    scene.sky = initial.sky;
    scene.absorber = initial.absorber;
    scene.fog = initial.haze;
    scene.fogMedium = MediumDesc{"of the atmosphere", makePreset<WlkMediumInfo>(which), {}, {}};
  }
  scene.planet =
      root.has("planet") ? parsePlanet(root.at("planet"), initial.planet) : initial.planet;
  if (root.has("sky")) {
    scene.sky = parseSky(root.at("sky"), initial.sky);
  } else if (root.isNull("sky")) {
    scene.sky.reset();
  }
  if (root.has("absorber")) {
    scene.absorber = parseAbsorber(root.at("absorber"), initial.absorber);
  } else if (root.isNull("absorber")) {
    scene.absorber.reset();
  }
  scene.ambient = root.has("ambient") ? parseAmbient(root.at("ambient")) : make<WlkAmbient>();
  if (root.has("lights")) {
    for (const JsonNode& node : root.at("lights").elements()) {
      scene.lights.push_back(parseLight(node, scene, initial.sun));
    }
  }
  if (root.has("fog")) {
    parseFog(root.at("fog"), initial.haze, scene);
  } else if (root.isNull("fog")) {
    scene.fog.reset();
    scene.fogMedium.reset();
  }
}

}  // namespace host
