// SPDX-License-Identifier: MIT
// Camera, placement of volumes, and the opaque picture.
#include "common/geometry.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "common/scene.hpp"

namespace {

using host::Vec3;

// A few operations in double on numbers of size `magnitude`.
double rounding(double magnitude) {
  return 16.0 * 0x1p-52 * magnitude;
}

host::CameraDesc tiltedCamera() {
  host::CameraDesc camera;
  camera.position = {10.0, 20.0, 30.0};
  camera.forward = host::directionFromAngles(-20.0, 35.0);
  camera.verticalFovDeg = 40.0;
  camera.nearPlane = 0.5;
  return camera;
}

TEST(HostCamera, GivesTheApiTheMatricesOfItsOwnRays) {
  const host::CameraDesc desc = tiltedCamera();
  const host::CameraAxes axes = host::cameraAxes(desc);
  WlkCamera camera{};
  host::fillCamera(desc, 320, 200, camera);
  const Vec3 ray = host::pixelRay(desc, axes, 250.0, 40.0, 320, 200);
  const double world[3] = {ray.x * 7.0, ray.y * 7.0, ray.z * 7.0};
  double view[4] = {0.0, 0.0, 0.0, 1.0};
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      view[row] += double{camera.viewFromWorld[column * 3 + row]} * world[column];
    }
  }
  double clip[4] = {};
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      clip[row] += double{camera.clipFromView[column * 4 + row]} * view[column];
    }
  }
  // Matrices are floats: three products of size 7 and a division by 7.
  const double tolerance = 6.0 * 0x1p-23;
  EXPECT_NEAR(clip[0] / clip[3], 250.0 / 160.0 - 1.0, tolerance);
  EXPECT_NEAR(clip[1] / clip[3], 40.0 / 100.0 - 1.0, tolerance);  // Vulkan: y down
  EXPECT_NEAR(clip[2] / clip[3], host::deviceDepth(desc, 7.0), tolerance);
}

TEST(HostCamera, HasRightHandedAxesEvenStraightDown) {
  for (const double pitch : {-90.0, -30.0, 0.0, 89.0, 90.0}) {
    host::CameraDesc camera;
    camera.forward = host::directionFromAngles(pitch, 123.0);
    const host::CameraAxes axes = host::cameraAxes(camera);
    EXPECT_NEAR(host::length(axes.right), 1.0, rounding(1.0));
    EXPECT_NEAR(host::length(axes.up), 1.0, rounding(1.0));
    EXPECT_NEAR(host::dot(host::cross(axes.right, axes.up), axes.forward), -1.0, rounding(1.0));
  }
}

TEST(HostPlacement, FitsTheBoxOfATurnedVolume) {
  // Data with z up: its box is 4 x 6 x 5 in the world.
  const host::Affine natural = host::affineFromEdges({1, 2, 3}, {4, 0, 0}, {0, 0, -5}, {0, 6, 0});
  host::PlacementDesc placement;
  placement.box = true;
  placement.min = {-100.0, 50.0, 10.0};
  placement.size = {40.0, 60.0, 50.0};
  const host::Affine placed = host::placeVolume(natural, placement);
  const Vec3 corner = host::transformPoint(placed, {0.0, 0.0, 0.0});
  EXPECT_NEAR(corner.x, -100.0, rounding(100.0));
  EXPECT_NEAR(corner.y, 50.0, rounding(100.0));
  EXPECT_NEAR(corner.z, 60.0, rounding(100.0));  // the data's y runs along -z
  const Vec3 top = host::transformPoint(placed, {1.0, 1.0, 1.0});
  EXPECT_NEAR(top.x, -60.0, rounding(100.0));
  EXPECT_NEAR(top.y, 110.0, rounding(100.0));
  EXPECT_NEAR(top.z, 10.0, rounding(100.0));
}

TEST(HostPlacement, TurnsAboutTheMiddleAndKeepsVolume) {
  const host::Affine natural = host::affineFromEdges({}, {2, 0, 0}, {0, 4, 0}, {0, 0, 6});
  host::PlacementDesc placement;
  placement.scale = 3.0;
  placement.origin = {5.0, 6.0, 7.0};
  placement.rotationDeg = {20.0, 90.0, -30.0};
  const host::Affine m = host::placeVolume(natural, placement);
  const Vec3 middle = host::transformPoint(m, {0.5, 0.5, 0.5});
  EXPECT_NEAR(middle.x, 8.0, rounding(20.0));
  EXPECT_NEAR(middle.y, 12.0, rounding(20.0));
  EXPECT_NEAR(middle.z, 16.0, rounding(20.0));
  const Vec3 x{m[0], m[4], m[8]};
  const Vec3 y{m[1], m[5], m[9]};
  const Vec3 z{m[2], m[6], m[10]};
  EXPECT_NEAR(host::dot(host::cross(x, y), z), 27.0 * 48.0, rounding(27.0 * 48.0));
  placement.rotationDeg = {0.0, 90.0, 0.0};
  const host::Affine yaw = host::placeVolume(natural, placement);
  EXPECT_NEAR(yaw[8], -6.0, rounding(20.0));  // +x turns to -z
}

host::Illumination sunFrom(Vec3 direction) {
  host::Illumination light;
  light.lights.push_back({direction, {{2.0, 3.0, 4.0}}});
  return light;
}

TEST(HostRaster, ReflectsAlbedoOverPiTimesIrradiance) {
  host::GeometryDesc geometry;
  geometry.spheres.push_back({{0.0, 0.0, -50.0}, 10.0, {0.5f, 0.25f, 1.0f}});
  host::CameraDesc camera;
  camera.position = {};
  camera.preExposure = 2.0;
  const Vec3 sun = host::normalize({0.0, 1.0, 1.0});
  const host::RasterResult result =
      host::rasterise(geometry, nullptr, {}, sunFrom(sun), camera, 65, 65);
  const size_t centre = 32 * 65 + 32;
  // The centre pixel looks at (0, 0, -40) with normal +z: cosine sqrt(1/2).
  EXPECT_FLOAT_EQ(result.depth.values[centre], static_cast<float>(0.1 / 40.0));
  const double expected = 2.0 * 0.5 / host::PI * 2.0 * std::sqrt(0.5);
  EXPECT_NEAR(double{result.color.rgba[centre * 4]}, expected, 2.0 * 0x1p-24 * expected);
  EXPECT_EQ(result.depth.values[0], 0.0f);
  EXPECT_EQ(result.color.rgba[0], 0.0f);
}

TEST(HostRaster, MeetsTheHeightFieldWhereTheDepthSays) {
  host::GeometryDesc geometry;
  geometry.terrain.emplace();
  geometry.terrain->resolution = 256;
  const host::HeightField field(*geometry.terrain);
  host::CameraDesc camera;
  camera.position = {500.0, 2500.0, 9000.0};
  camera.forward = host::directionFromAngles(-15.0, 10.0);
  const host::PlanetShape planet;
  const host::RasterResult result =
      host::rasterise(geometry, &field, planet, sunFrom({0.0, 1.0, 0.0}), camera, 64, 48);
  const host::CameraAxes axes = host::cameraAxes(camera);
  size_t hits = 0;
  for (uint32_t y = 0; y < 48; ++y) {
    for (uint32_t x = 0; x < 64; ++x) {
      const double depth = double{result.depth.values[y * 64 + x]};
      if (depth == 0.0) {
        continue;
      }
      ++hits;
      const Vec3 ray = host::pixelRay(camera, axes, x + 0.5, y + 0.5, 64, 48);
      const Vec3 p = camera.position + ray * (camera.nearPlane / depth);
      const double fall = (p.x * p.x + p.z * p.z) / (2.0 * planet.radius);
      // The depth is a float: half an ulp of the distance, on slopes of at most about 2.
      const double tolerance = 0x1p-23 * 2.0 * host::length(p - camera.position) + 0.01;
      ASSERT_NEAR(p.y + fall, field.height(p.x, p.z), tolerance);
    }
  }
  EXPECT_GT(hits, 300u);
}

TEST(HostRaster, LeavesOutWhatLiesUnderTheSea) {
  host::GeometryDesc geometry;
  geometry.terrain.emplace();
  geometry.terrain->resolution = 64;
  geometry.terrain->centre.y = -1e4;
  const host::HeightField field(*geometry.terrain);
  host::CameraDesc camera;
  camera.position = {0.0, 100.0, 0.0};
  camera.forward = {0.0, -1.0, 0.0};
  const host::RasterResult result =
      host::rasterise(geometry, &field, {}, sunFrom({0.0, 1.0, 0.0}), camera, 8, 8);
  EXPECT_EQ(result.depth.values, std::vector<float>(64, 0.0f));
}

}  // namespace
