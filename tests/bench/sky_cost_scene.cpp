// SPDX-License-Identifier: MIT
#include "bench/sky_cost_scene.hpp"

#include <algorithm>
#include <cmath>

#include "reference/random.hpp"

namespace bench {
namespace {

namespace rt = welkin::reference;

constexpr double FARTHEST = 50e3;
constexpr double NEAREST_DRAWN = 1e3;
constexpr double SLOPE = 20;  // how fast a ridge comes nearer below its crest, per rad

struct Ridge {
  double distance;
  double crest_deg;
  double waves;  // per rad of azimuth
};
constexpr Ridge RIDGES[] = {{2e3, -1.5, 7},   {4e3, -0.3, 9},  {8e3, 1.0, 6},   {14e3, 1.8, 11},
                            {22e3, 2.6, 8.5}, {32e3, 3.2, 13}, {42e3, 3.6, 10}, {50e3, 3.9, 15}};

rt::Climb climbOf(double altitude, const host::Vec3& direction) {
  rt::Globe globe;
  globe.radius = SKY_PLANET_RADIUS;
  return globe.climb({0, altitude, 0}, {direction.x, direction.y, direction.z});
}

double surfaceAlong(double altitude, const host::Vec3& direction) {
  const double elevation = std::asin(direction.y);
  const double azimuth = std::atan2(direction.x, -direction.z);
  const double ground = climbOf(altitude, direction).ground();
  // A little above the sea, so that both sides agree what ends the ray.
  double nearest = ground < rt::FAR ? std::min(0.98 * ground, FARTHEST) : rt::FAR;
  for (const Ridge& ridge : RIDGES) {
    const double wave = std::sin(ridge.waves * azimuth + 1e-3 * ridge.distance);
    const double below = (ridge.crest_deg + 0.8 * wave) * host::RADIANS_PER_DEGREE - elevation;
    if (below > 0) {
      nearest = std::min(nearest, ridge.distance / (1 + SLOPE * below));
    }
  }
  return ground < rt::FAR ? std::min(nearest, 0.98 * ground) : nearest;
}

}  // namespace

std::vector<SkyCase> skyCases() {
  return {{"sun-60", 60, 60, 2},
          {"sun-30", 30, 120, 200},
          {"sun-10", 10, 30, 2000},
          {"sun-2", 2, 80, 20},
          {"sun-below-2", -2, 15, 2}};
}

host::CameraDesc skyCamera(const SkyCase& one) {
  host::CameraDesc camera;
  camera.position = {0, one.altitude, 0};
  return camera;
}

host::Vec3 sunDirection(const SkyCase& one) {
  return host::directionFromAngles(one.sun_deg, one.azimuth_deg);
}

std::vector<float> skyDepth(const SkyCase& one, uint32_t width, uint32_t height) {
  const host::CameraDesc camera = skyCamera(one);
  const host::CameraAxes axes = host::cameraAxes(camera);
  std::vector<float> depth(size_t{width} * height, 0);
  for (uint32_t y = 0; y < height; ++y) {
    for (uint32_t x = 0; x < width; ++x) {
      const host::Vec3 ray = host::pixelRay(camera, axes, x + 0.5, y + 0.5, width, height);
      const double scale = host::length(ray);
      const double distance = surfaceAlong(one.altitude, ray * (1 / scale));
      if (distance < rt::FAR) {
        depth[size_t{y} * width + x] =
            static_cast<float>(host::deviceDepth(camera, distance / scale));
      }
    }
  }
  return depth;
}

std::vector<SkyPixel> drawPixels(const SkyCase& one, const std::vector<float>& depth,
                                 uint32_t width, uint32_t height, uint32_t count, uint64_t seed) {
  const host::CameraDesc camera = skyCamera(one);
  const host::CameraAxes axes = host::cameraAxes(camera);
  rt::Random random(seed, 0, 0, 0);
  std::vector<SkyPixel> sky;
  std::vector<SkyPixel> surfaces;
  while (sky.size() < count || surfaces.size() < count) {
    SkyPixel pixel;
    pixel.x = static_cast<uint32_t>(random.uniform() * width);
    pixel.y = static_cast<uint32_t>(random.uniform() * height);
    const host::Vec3 ray =
        host::pixelRay(camera, axes, pixel.x + 0.5, pixel.y + 0.5, width, height);
    const double scale = host::length(ray);
    pixel.direction = ray * (1 / scale);
    const auto value = double{depth[size_t{pixel.y} * width + pixel.x]};
    if (value > 0) {
      pixel.distance = scale * camera.nearPlane / value;
    }
    std::vector<SkyPixel>& kind = value > 0 ? surfaces : sky;
    if (kind.size() < count && pixel.distance >= NEAREST_DRAWN) {
      kind.push_back(pixel);
    }
  }
  sky.insert(sky.end(), surfaces.begin(), surfaces.end());
  return sky;
}

}  // namespace bench
