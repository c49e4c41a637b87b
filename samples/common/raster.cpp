// SPDX-License-Identifier: MIT
// Ray casts terrain, spheres and boxes into radiance and reversed depth.
#include <algorithm>
#include <cmath>
#include <limits>

#include "common/geometry.hpp"
#include "common/noise.hpp"
#include "common/parallel.hpp"

namespace host {
namespace {

constexpr double NO_HIT = std::numeric_limits<double>::infinity();

// A surface point; `distance` counts in view depth because pixelRay is scaled so.
struct Hit {
  double distance = NO_HIT;
  Vec3 normal;
  Rgb albedo{};
};

// Height over the sea-level sphere near its top: exact to (d^2 / 2R)^2 / 2R, under 1 m at 100 km.
double altitudeOf(const PlanetShape& planet, Vec3 p) {
  const Vec3 d = p - planet.seaLevelPoint;
  return d.y + (d.x * d.x + d.z * d.z) / (2.0 * planet.radius);
}

// Narrows [t0, t1] to where p0 + t d lies between low and high along one axis.
void clipAxis(double p0, double d, double low, double high, double& t0, double& t1) {
  if (d == 0.0) {
    if (p0 < low || p0 > high) {
      t1 = -1.0;
    }
    return;
  }
  const double a = (low - p0) / d;
  const double b = (high - p0) / d;
  t0 = std::max(t0, std::min(a, b));
  t1 = std::min(t1, std::max(a, b));
}

double castTerrain(const TerrainInfo& info, const HeightField& field, const PlanetShape& planet,
                   Vec3 eye, Vec3 ray, double nearest) {
  double t0 = nearest;
  double t1 = NO_HIT;
  clipAxis(eye.x - info.centre.x, ray.x, -0.5 * info.extent, 0.5 * info.extent, t0, t1);
  clipAxis(eye.z - info.centre.z, ray.z, -0.5 * info.extent, 0.5 * info.extent, t0, t1);
  // The sphere falls away from the plane by at most this over the square.
  const double reach = std::abs(info.centre.x - planet.seaLevelPoint.x) +
                       std::abs(info.centre.z - planet.seaLevelPoint.z) + info.extent;
  clipAxis(eye.y - planet.seaLevelPoint.y, ray.y,
           field.lowest() - reach * reach / (2.0 * planet.radius), field.highest(), t0, t1);
  const double scale = length(ray);
  const double cell = info.extent / info.resolution;
  const auto clearance = [&](double t) {
    const Vec3 p = eye + ray * t;
    return altitudeOf(planet, p) - field.height(p.x - info.centre.x, p.z - info.centre.z);
  };
  double previous = t0;
  for (double t = t0; t <= t1;) {
    const double above = clearance(t);
    if (above <= 0.0) {
      // 24 halvings of a step of at most a few hundred metres: millimetres.
      for (int i = 0; i < 24; ++i) {
        const double middle = 0.5 * (previous + t);
        (clearance(middle) <= 0.0 ? t : previous) = middle;
      }
      return t;
    }
    previous = t;
    // Half the clearance is safe on slopes up to 63 degrees; far away a pixel spans many cells.
    t += std::max({0.5 * above, 0.3 * cell, 0.001 * t * scale}) / scale;
  }
  return NO_HIT;
}

Rgb terrainAlbedo(const TerrainInfo& info, Vec3 p, double altitude, Vec3 normal) {
  const auto ramp = [](double low, double high, double x) {
    return static_cast<float>(std::clamp((x - low) / (high - low), 0.0, 1.0));
  };
  const double patch = fbm(p * (1.0 / 160.0), 4, info.seed + 200);
  const float rock = ramp(0.86, 0.72, normal.y + 0.06 * patch);
  const float snow = ramp(-80.0, 80.0, altitude - info.snowLine + 150.0 * patch) *
                     ramp(0.6, 0.75, normal.y + 0.1 * patch);
  const auto shade = static_cast<float>(1.0 + 0.5 * patch);
  Rgb albedo{};
  for (size_t c = 0; c < 3; ++c) {
    const float ground = info.albedo[c] + rock * (info.rockAlbedo[c] - info.albedo[c]);
    albedo[c] = std::clamp((ground + snow * (info.snowAlbedo[c] - ground)) * shade, 0.0f, 1.0f);
  }
  return albedo;
}

void castSphere(const SphereInfo& sphere, Vec3 eye, Vec3 ray, double nearest, Hit& hit) {
  const Vec3 to = sphere.centre - eye;
  const double scale = length(ray);
  const Vec3 unit = ray * (1.0 / scale);
  const double along = dot(to, unit);
  // The distance of the ray from the centre as a vector: no difference of large squares.
  const Vec3 off = to - unit * along;
  const double inside = sphere.radius * sphere.radius - dot(off, off);
  if (inside < 0.0) {
    return;
  }
  const double t = (along - std::sqrt(inside)) / scale;
  if (t > nearest && t < hit.distance) {
    hit.distance = t;
    hit.normal = (eye + ray * t - sphere.centre) * (1.0 / sphere.radius);
    hit.albedo = sphere.albedo;
  }
}

void castBox(const BoxInfo& box, Vec3 eye, Vec3 ray, double nearest, Hit& hit) {
  double t0 = nearest;
  double t1 = NO_HIT;
  const Vec3 from = eye - box.min;
  clipAxis(from.x, ray.x, 0.0, box.size.x, t0, t1);
  clipAxis(from.y, ray.y, 0.0, box.size.y, t0, t1);
  clipAxis(from.z, ray.z, 0.0, box.size.z, t0, t1);
  if (!(t0 < t1) || t0 >= hit.distance || t0 <= nearest) {
    return;
  }
  hit.distance = t0;
  // The face that the point lies on: there it is farthest from the middle in shares of the edge.
  const Vec3 at = eye + ray * t0 - box.min - box.size * 0.5;
  const Vec3 share{std::abs(at.x) / box.size.x, std::abs(at.y) / box.size.y,
                   std::abs(at.z) / box.size.z};
  const auto sign = [](double x) { return x < 0.0 ? -1.0 : 1.0; };
  hit.normal = share.x >= share.y && share.x >= share.z ? Vec3{sign(at.x), 0.0, 0.0}
               : share.y >= share.z                     ? Vec3{0.0, sign(at.y), 0.0}
                                                        : Vec3{0.0, 0.0, sign(at.z)};
  hit.albedo = box.albedo;
}

// What a ray meets behind `nearest`, counted in lengths of the ray.
Hit castAll(const GeometryDesc& geometry, const HeightField* field, const PlanetShape& planet,
            Vec3 eye, Vec3 ray, double nearest) {
  Hit hit;
  if (geometry.terrain && field != nullptr) {
    const TerrainInfo& terrain = *geometry.terrain;
    const double t = castTerrain(terrain, *field, planet, eye, ray, nearest);
    const Vec3 p = eye + ray * t;
    if (t < NO_HIT && altitudeOf(planet, p) > 0.0) {
      hit.distance = t;
      hit.normal = field->normal(p.x - terrain.centre.x, p.z - terrain.centre.z);
      hit.albedo = terrainAlbedo(terrain, p, altitudeOf(planet, p), hit.normal);
    }
  }
  for (const SphereInfo& sphere : geometry.spheres) {
    castSphere(sphere, eye, ray, nearest, hit);
  }
  for (const BoxInfo& box : geometry.boxes) {
    castBox(box, eye, ray, nearest, hit);
  }
  return hit;
}

std::array<double, 3> irradianceAt(const SunLight& light, double position) {
  if (light.irradiance.empty()) {
    return {};
  }
  const double last = static_cast<double>(light.irradiance.size() - 1);
  const double x = std::clamp(position, 0.0, 1.0) * last;
  const size_t low = static_cast<size_t>(x);
  const size_t high = std::min(low + 1, light.irradiance.size() - 1);
  const double weight = x - static_cast<double>(low);
  std::array<double, 3> value{};
  for (size_t c = 0; c < 3; ++c) {
    value[c] = light.irradiance[low][c] * (1.0 - weight) + light.irradiance[high][c] * weight;
  }
  return value;
}

}  // namespace

double castGeometry(const GeometryDesc& geometry, const HeightField* field,
                    const PlanetShape& planet, Vec3 origin, Vec3 direction, double nearest) {
  return castAll(geometry, field, planet, origin, direction, nearest).distance;
}

RasterResult rasterise(const GeometryDesc& geometry, const HeightField* field,
                       const PlanetShape& planet, const Illumination& light,
                       const CameraDesc& camera, uint32_t width, uint32_t height) {
  RasterResult result;
  result.color = {width, height, std::vector<float>(size_t{width} * height * 4, 0.0f)};
  result.depth = {width, height, std::vector<float>(size_t{width} * height, 0.0f)};
  const CameraAxes axes = cameraAxes(camera);

  parallelFor(height, [&](uint32_t y) {
    for (uint32_t x = 0; x < width; ++x) {
      const Vec3 ray = pixelRay(camera, axes, x + 0.5, y + 0.5, width, height);
      const Hit hit = castAll(geometry, field, planet, camera.position, ray, camera.nearPlane);
      if (hit.distance == NO_HIT) {
        continue;
      }
      const double altitude = altitudeOf(planet, camera.position + ray * hit.distance);
      const double place = (altitude - light.lowest) / (light.highest - light.lowest);
      std::array<double, 3> received{};
      for (size_t c = 0; c < 3; ++c) {
        // A tilted surface sees a part of the sky; the ground's own light is left out.
        received[c] = light.ambient[c] * (0.5 + 0.5 * hit.normal.y);
      }
      for (const SunLight& sun : light.lights) {
        const std::array<double, 3> facing = irradianceAt(sun, place);
        double cosine = std::max(dot(hit.normal, sun.direction), 0.0);
        // A thousandth of the distance off the surface: no shadow from the surface itself.
        const Vec3 off = camera.position + ray * hit.distance + hit.normal * (1e-3 * hit.distance);
        if (geometry.shadows && cosine > 0.0 &&
            castAll(geometry, field, planet, off, sun.direction, 0.0).distance < NO_HIT) {
          cosine = 0.0;
        }
        for (size_t c = 0; c < 3; ++c) {
          received[c] += facing[c] * cosine;
        }
      }
      const size_t pixel = size_t{y} * width + x;
      for (size_t c = 0; c < 3; ++c) {
        result.color.rgba[pixel * 4 + c] =
            static_cast<float>(double{hit.albedo[c]} / PI * received[c] * camera.preExposure);
      }
      result.color.rgba[pixel * 4 + 3] = 1.0f;
      result.depth.values[pixel] = static_cast<float>(deviceDepth(camera, hit.distance));
    }
  });
  return result;
}

}  // namespace host
