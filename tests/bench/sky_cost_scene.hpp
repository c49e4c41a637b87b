// SPDX-License-Identifier: MIT
// What welkin_sky_cost draws: clear air over mountains up to 50 km away, seen horizontally. Lengths
// in m.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "common/camera.hpp"
#include "reference/globe.hpp"

namespace bench {

using SkyRgb = std::array<double, 3>;

constexpr double SKY_PLANET_RADIUS = 6.371e6;
constexpr SkyRgb SKY_SCATTERING = {5.8e-6, 1.35e-5, 3.31e-5};
constexpr double SKY_SCALE_HEIGHT = 8000;
constexpr double SKY_GROUND_ALBEDO = 0.1;

struct SkyCase {
  std::string name;
  double sun_deg;
  double azimuth_deg;  // of the sun, from the middle of the picture to the right
  double altitude;     // of the eye
};

std::vector<SkyCase> skyCases();
host::CameraDesc skyCamera(const SkyCase& one);
// Unit vector.
host::Vec3 sunDirection(const SkyCase& one);

struct SkyPixel {
  uint32_t x = 0;
  uint32_t y = 0;
  host::Vec3 direction;  // unit vector
  double distance = welkin::reference::FAR;
};

// Reversed depth, 0 where nothing is: ridges one behind the other, all above the sea; every ray
// that sinks meets something.
std::vector<float> skyDepth(const SkyCase& one, uint32_t width, uint32_t height);

// Random pixels: `count` of the sky, and `count` of surfaces at least 1 km away.
std::vector<SkyPixel> drawPixels(const SkyCase& one, const std::vector<float>& depth,
                                 uint32_t width, uint32_t height, uint32_t count, uint64_t seed);

}  // namespace bench
