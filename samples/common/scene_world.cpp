// SPDX-License-Identifier: MIT
// The sections planet, sky, lights, fog.
#include "common/api.hpp"
#include "common/scene.hpp"

namespace host {
namespace {

WlkPlanet parsePlanet(const JsonNode& node) {
  node.onlyKeys({"seaLevelPoint", "up", "radius", "groundAlbedo"});
  auto planet = make<WlkPlanet>();
  Vec3 point{planet.seaLevelPoint[0], planet.seaLevelPoint[1], planet.seaLevelPoint[2]};
  node.optional("seaLevelPoint", point);
  planet.seaLevelPoint[0] = point.x;
  planet.seaLevelPoint[1] = point.y;
  planet.seaLevelPoint[2] = point.z;
  if (node.has("up")) {
    const Vec3 up = node.at("up").vec3();
    if (!(length(up) > 0.0)) {
      node.at("up").fail("expected a vector that is not 0");
    }
    const Vec3 unit = normalize(up);
    planet.up[0] = static_cast<float>(unit.x);
    planet.up[1] = static_cast<float>(unit.y);
    planet.up[2] = static_cast<float>(unit.z);
  }
  node.optional("radius", planet.radius);
  node.optional("groundAlbedo", planet.groundAlbedo);
  return planet;
}

WlkSky parseSky(const JsonNode& node) {
  node.onlyKeys({"rayleighScattering", "scaleHeight"});
  auto sky = make<WlkSky>();
  node.optional("rayleighScattering", sky.rayleighScattering);
  node.optional("scaleHeight", sky.scaleHeight);
  return sky;
}

WlkLight parseLight(const JsonNode& node) {
  node.onlyKeys({"direction", "elevation_deg", "azimuth_deg", "angularDiameter_deg", "irradiance"});
  auto light = make<WlkLight>();
  Vec3 direction{0.0, 1.0, 0.0};
  if (node.has("direction")) {
    if (node.has("elevation_deg") || node.has("azimuth_deg")) {
      node.fail("expected direction, or elevation_deg and azimuth_deg, not both");
    }
    direction = node.at("direction").vec3();
    if (!(length(direction) > 0.0)) {
      node.at("direction").fail("expected a vector that is not 0");
    }
    direction = normalize(direction);
  } else if (node.has("elevation_deg") || node.has("azimuth_deg")) {
    const double azimuth = node.has("azimuth_deg") ? node.at("azimuth_deg").number() : 0.0;
    direction = directionFromAngles(node.at("elevation_deg").number(-90.0, 90.0), azimuth);
  }
  light.direction[0] = static_cast<float>(direction.x);
  light.direction[1] = static_cast<float>(direction.y);
  light.direction[2] = static_cast<float>(direction.z);
  if (node.has("angularDiameter_deg")) {
    light.angularDiameter =
        static_cast<float>(node.at("angularDiameter_deg").number() * RADIANS_PER_DEGREE);
  }
  node.optional("irradiance", light.irradiance);
  return light;
}

WlkFog parseFog(const JsonNode& node) {
  node.onlyKeys({"model", "dropletDiameter_um", "extinction", "baseAltitude", "scaleHeight",
                 "singleScatteringAlbedo"});
  auto fog = make<WlkFog>();
  if (node.has("model")) {
    fog.phaseModel = parsePhaseModel(node.at("model"));
  }
  node.optional("dropletDiameter_um", fog.dropletDiameter_um);
  node.optional("extinction", fog.extinction);
  node.optional("baseAltitude", fog.baseAltitude);
  node.optional("scaleHeight", fog.scaleHeight);
  node.optional("singleScatteringAlbedo", fog.singleScatteringAlbedo);
  return fog;
}

}  // namespace

void parseWorld(const JsonNode& root, Scene& scene) {
  scene.planet = root.has("planet") ? parsePlanet(root.at("planet")) : make<WlkPlanet>();
  if (root.has("sky")) {
    scene.sky = parseSky(root.at("sky"));
  }
  if (root.has("lights")) {
    for (const JsonNode& node : root.at("lights").elements()) {
      scene.lights.push_back(parseLight(node));
    }
  }
  if (root.has("fog")) {
    scene.fog = parseFog(root.at("fog"));
  }
}

}  // namespace host
