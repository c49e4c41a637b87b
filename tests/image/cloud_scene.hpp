// SPDX-License-Identifier: MIT
// The clouds of the image tests, 640 m wide, 1.5 km in front of a level camera at 1 km.
#pragma once

#include "reference/noise_volume.hpp"
#include "slicing_scene.hpp"

namespace image_test {

constexpr double CLOUD_EDGE = 640.0;  // m
constexpr Point CLOUD_CENTRE{0, 1000, -1500};
constexpr double CLOUD_G = 0.6;  // Henyey-Greenstein

// 0.3 optical depth per voxel at most, 12 through the densest column.
inline VoxelField noiseCloudField() {
  constexpr int N = welkin::reference::NOISE_CLOUD_SIZE;
  return cubeField(N, welkin::reference::noiseCloud(), 0.3 * N / CLOUD_EDGE, CLOUD_EDGE,
                   CLOUD_CENTRE);
}

// 4 optical depths per voxel at most.
inline VoxelField steepCloudField() {
  constexpr int N = welkin::reference::STEEP_CLOUD_SIZE;
  return cubeField(N, welkin::reference::steepCloud(), 4.0 * N / CLOUD_EDGE, CLOUD_EDGE,
                   CLOUD_CENTRE);
}

// The cloud fills the picture.
inline Camera cloudCamera() {
  Camera camera;
  camera.position = {0, 1000, 0};
  camera.tangent = 0.27;
  return camera;
}

// Direction to a light at an angle from the viewing direction, above the horizon, along no axis of
// the volume.
inline Point lightAtAngle(double degrees) {
  const Point side = normalized({0.3, 1, 0});
  return std::cos(degrees * DEGREE) * Point{0, 0, -1} + std::sin(degrees * DEGREE) * side;
}

}  // namespace image_test
