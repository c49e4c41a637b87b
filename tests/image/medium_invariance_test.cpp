// SPDX-License-Identifier: MIT
// What a picture of a volume may not depend on: the end from which a line is looked along, and
// whether its medium has one colour or three that are nearly the same.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "cloud_scene.hpp"

namespace {

using namespace image_test;

constexpr int SIZE = 31;  // odd: one pixel looks straight ahead

// Transmittance from a place to another, which is the far end of the volume.
double transmittance(SlicingScene& scene, const Point& from, const Point& to) {
  Camera camera;
  camera.position = from;
  camera.forward = normalized(to - from);
  camera.up = {0.1, 1, 0.2};
  camera.tangent = 0.01;
  scene.setCamera(camera);
  const Point way = to - from;
  const double distance = std::sqrt(dot(way, way));
  const std::vector<float> depth(size_t{SIZE} * SIZE,
                                 camera.depthAt(SIZE / 2, SIZE / 2, SIZE, distance));
  return scene.render(depth).transmittance[size_t{SIZE} * SIZE / 2][0];
}

// Slabs of two views lie elsewhere on the line, so the two differ by the error of the slabs.
TEST(Reciprocity, OfTransmittanceHoldsThroughAHeterogeneousVolume) {
  SlicingScene scene(SIZE);
  VoxelField field = noiseCloudField();
  for (double& x : field.extinction) {
    x *= 0.1;  // optical depths around 1, where an error shows most
  }
  scene.addVolume(field, scene.henyeyGreenstein(CLOUD_G));
  scene.setLight(lightAtAngle(60));
  Quality quality;
  quality.slices = 256;
  scene.setQuality(quality);
  const RayMarch march(field);
  double most = 0;
  double least = 1;
  // From outside to outside, and between places inside.
  const std::array<std::array<Point, 2>, 5> lines = {{{{{-500, 40, 30}, {480, -70, -60}}},
                                                      {{{-30, 420, 400}, {60, -390, -420}}},
                                                      {{{90, -30, 560}, {-110, 60, -540}}},
                                                      {{{-150, 60, 90}, {170, -40, -120}}},
                                                      {{{-20, -180, 10}, {120, 170, 90}}}}};
  for (const std::array<Point, 2>& line : lines) {
    const Point a = CLOUD_CENTRE + line[0];
    const Point b = CLOUD_CENTRE + line[1];
    const double there = transmittance(scene, a, b);
    const double back = transmittance(scene, b, a);
    const Point way = b - a;
    const double length = std::sqrt(dot(way, way));
    const double truth = std::exp(-march.opticalDepth(a, (1 / length) * way, length));
    std::printf("there %.5f, back %.5f, march %.5f\n", there, back, truth);
    most = std::max(most, std::abs(there - back));
    least = std::min(least, truth);
    EXPECT_NEAR(there, truth, 0.005);
  }
  EXPECT_LT(least, 0.6) << "nothing to hide";
  EXPECT_LT(most, 0.002);
}

WlkMedium medium(const SlicingScene& scene, double tint) {
  auto info = welkin::make<WlkMediumInfo>();
  info.particle = WLK_PARTICLE_HENYEY_GREENSTEIN;
  info.asymmetry = static_cast<float>(CLOUD_G);
  for (size_t c = 0; c < 3; ++c) {
    info.singleScatteringAlbedo[c] = static_cast<float>(0.9 + tint * (static_cast<double>(c) - 1));
  }
  WlkMedium result{};
  welkin::check(wlkCreateMedium(scene.context(), &info, &result));
  return result;
}

// Grey media may take one channel where coloured ones take three.
TEST(GreyMedium, IsOneOfNearlyEqualColours) {
  constexpr double TINT = 1e-6;
  // Each of up to twelve scatterings multiplies by the albedo; the rest is single precision.
  constexpr double BOUND = 12 * TINT + 2e-5;
  for (const uint32_t scattering :
       {WLK_SCATTERING_SINGLE, WLK_SCATTERING_FORWARD, WLK_SCATTERING_ALL_ORDERS}) {
    std::array<Picture, 2> pictures;
    for (size_t i = 0; i < 2; ++i) {
      SlicingScene scene(SIZE);
      scene.addVolume(noiseCloudField(), medium(scene, i == 0 ? 0 : TINT));
      scene.setLight(lightAtAngle(60));
      scene.setCamera(cloudCamera());
      Quality quality;
      quality.level = WLK_QUALITY_LOW;
      quality.scattering = scattering;
      quality.slices = quality.lightSize = 0;  // of the level
      scene.setQuality(quality);
      pictures[i] = scene.render();
      EXPECT_EQ(pictures[i].nonFinite, 0u);
    }
    const double scale = mean(pictures[0].red());
    double most = 0;
    for (size_t i = 0; i < pictures[0].radiance.size(); ++i) {
      for (size_t c = 0; c < 3; ++c) {
        most = std::max(most, std::abs(pictures[1].radiance[i][c] - pictures[0].radiance[i][c]));
        most = std::max(most, scale * std::abs(pictures[1].transmittance[i][c] -
                                               pictures[0].transmittance[i][c]));
      }
    }
    std::printf("scattering %u: %.1e of the mean\n", scattering, most / scale);
    EXPECT_GT(scale, 0);
    EXPECT_LT(most / scale, BOUND) << scattering;
  }
}

}  // namespace
