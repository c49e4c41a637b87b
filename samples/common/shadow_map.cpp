// SPDX-License-Identifier: MIT
// The geometry's shadow map, as an engine would draw it: cascades around the camera, ray cast along
// the light.
#include <algorithm>
#include <cmath>

#include "common/apply.hpp"
#include "common/parallel.hpp"

namespace host {
namespace {

constexpr uint32_t TEXELS = 768;
constexpr uint32_t CASCADES = 3;
constexpr double RATIO = 4.0;  // of the cascades' edges

// Farthest of the geometry from the camera, without a terrain's rim. m.
double reachOf(const Scene& scene) {
  double reach = 1.0;
  const Vec3 eye = scene.camera.position;
  if (scene.geometry->terrain) {
    reach = 0.5 * scene.geometry->terrain->extent;
  }
  for (const SphereInfo& sphere : scene.geometry->spheres) {
    reach = std::max(reach, length(sphere.centre - eye) + sphere.radius);
  }
  for (const BoxInfo& box : scene.geometry->boxes) {
    reach = std::max(reach, length(box.min - eye) + length(box.size));
  }
  return reach;
}

}  // namespace

ShadowMap makeShadowMap(const Scene& scene, const Progress& progress) {
  ShadowMap map;
  map.place = make<WlkLightShadow>();
  if (!scene.geometry || !scene.geometry->shadows || scene.lights.empty()) {
    return map;
  }
  progress("shadow map");
  std::optional<HeightField> field;
  if (scene.geometry->terrain) {
    field.emplace(*scene.geometry->terrain);
  }
  const double* sea = scene.planet.seaLevelPoint;
  const PlanetShape planet{{sea[0], sea[1], sea[2]}, double{scene.planet.radius}};
  const float* d = scene.lights[0].direction;
  const Vec3 toLight = normalize({double{d[0]}, double{d[1]}, double{d[2]}});
  const Vec3 side = std::abs(toLight.y) < 0.9 ? Vec3{0.0, 1.0, 0.0} : Vec3{1.0, 0.0, 0.0};
  const Vec3 right = normalize(cross(side, toLight));
  const Vec3 down = cross(toLight, right);
  const Vec3 eye = scene.camera.position;
  const double reach = reachOf(scene);
  // Casters and what they shade lie within two reaches of the camera.
  const double depth = 4.0 * reach;

  map.size = TEXELS;
  map.place.cascadeCount = CASCADES;
  map.place.origin[0] = eye.x;
  map.place.origin[1] = eye.y;
  map.place.origin[2] = eye.z;
  map.depth.resize(size_t{CASCADES} * TEXELS * TEXELS);
  double edge = 2.0 * reach / std::pow(RATIO, CASCADES - 1);
  for (uint32_t i = 0; i < CASCADES; ++i, edge *= RATIO) {
    float* m = map.place.clipFromWorld[i];
    const Vec3 u = right * (2.0 / edge);
    const Vec3 v = down * (2.0 / edge);
    const Vec3 s = toLight * (-1.0 / depth);
    const std::array columns{Vec3{u.x, v.x, s.x}, Vec3{u.y, v.y, s.y}, Vec3{u.z, v.z, s.z},
                             Vec3{0.0, 0.0, 0.5}};
    for (size_t k = 0; k < columns.size(); ++k) {
      m[4 * k] = static_cast<float>(columns[k].x);
      m[4 * k + 1] = static_cast<float>(columns[k].y);
      m[4 * k + 2] = static_cast<float>(columns[k].z);
      m[4 * k + 3] = k == 3 ? 1.0f : 0.0f;
    }
    parallelFor(TEXELS, [&](uint32_t y) {
      for (uint32_t x = 0; x < TEXELS; ++x) {
        const Vec3 from = eye + right * (edge * ((x + 0.5) / TEXELS - 0.5)) +
                          down * (edge * ((y + 0.5) / TEXELS - 0.5)) + toLight * (0.5 * depth);
        const double t = castGeometry(*scene.geometry, field ? &*field : nullptr, planet, from,
                                      toLight * -1.0, 0.0);
        map.depth[(size_t{i} * TEXELS + y) * TEXELS + x] =
            static_cast<float>(std::min(t / depth, 1.0));
      }
    });
  }
  // A texel's width of the finest cascade: surfaces seen at up to 45 degrees don't shade the air
  // right above them.
  map.place.bias = static_cast<float>(2.0 * reach / std::pow(RATIO, CASCADES - 1) / TEXELS);
  return map;
}

}  // namespace host
