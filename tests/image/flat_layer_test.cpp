// SPDX-License-Identifier: MIT
// Light scattered once in a layer much wider than high with the sun aside, through which light goes
// further than it is high: rays have stretches enough all the same, at any slice count.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "slicing_scene.hpp"

namespace {

using namespace image_test;

constexpr int SIZE = 48;
constexpr int WIDE = 64;  // voxels
constexpr int HIGH = 12;
constexpr double WIDTH = 64e3;  // m
constexpr double HEIGHT = 800;
constexpr double BASE = 6000;
constexpr double DEPTH = 0.3;  // optical depth of most columns, upwards
constexpr double G = 0.8;      // Henyey-Greenstein

// Ramps to both faces, waves along the plane.
VoxelField layerField() {
  VoxelField field;
  field.size = {WIDE, HIGH, WIDE};
  field.worldFromBox = {WIDTH, 0, 0, -WIDTH / 2, 0, HEIGHT, 0, BASE, 0, 0, WIDTH, -WIDTH / 2};
  for (int z = 0; z < WIDE; ++z) {
    for (int y = 0; y < HIGH; ++y) {
      for (int x = 0; x < WIDE; ++x) {
        const double up = std::sin((y + 0.5) / HIGH * std::numbers::pi);
        const double wave = 1 + 0.4 * std::sin(0.5 * x) * std::cos(0.4 * z);
        field.extinction.push_back(
            static_cast<double>(static_cast<float>(1.5 * DEPTH / HEIGHT * up * wave)));
      }
    }
  }
  return field;
}

std::vector<double> transmittances(const RayMarch& march, const Camera& camera) {
  std::vector<double> values;
  for (int i = 0; i < SIZE * SIZE; ++i) {
    const Point ray = camera.ray(i % SIZE, i / SIZE, SIZE);
    values.push_back(std::exp(-march.opticalDepth(camera.position, ray)));
  }
  return values;
}

std::vector<double> transmittancesOf(const Picture& picture) {
  std::vector<double> values;
  for (const std::array<double, 3>& rgb : picture.transmittance) {
    values.push_back(rgb[0]);
  }
  return values;
}

TEST(FlatLayer, FewSlicesDrawWhatManyDo) {
  // Midpoints of 16 stretches miss the integral of a sine's half wave by (pi / 16)^2 / 24, once in
  // the light that is scattered and once, with the depth before it, in what is left of it.
  const double bound = 2 * std::pow(std::numbers::pi / 16, 2) / 24;
  const VoxelField field = layerField();
  const RayMarch march(field);
  SlicingScene scene(SIZE, true);
  scene.addVolume(field, scene.henyeyGreenstein(G));
  const Point light = normalized({0.1, 0.5, -1});
  scene.setLight(light);
  Camera camera;
  camera.forward = normalized({0, 0.6, -1});
  scene.setCamera(camera);
  const std::vector<double> truth = marchPicture(march, camera, SIZE, light, G);
  const std::vector<double> clear = transmittances(march, camera);
  for (const uint32_t slicing : {WLK_SLICING_LIGHT_ALIGNED, WLK_SLICING_HALF_ANGLE}) {
    for (const uint32_t batch : {0u, 16u}) {
      for (const uint32_t slices : {16u, 32u, 128u}) {
        Quality quality;
        quality.slicing = slicing;
        quality.batch = batch;
        quality.slices = slices;
        scene.setQuality(quality);
        const Picture picture = scene.render();
        EXPECT_EQ(picture.nonFinite, 0u);
        const double error = relativeRms(picture.red(), truth);
        const double hidden = relativeRms(transmittancesOf(picture), clear);
        std::printf("slicing %u, batch %2u, %3u slices: %.2f %%, transmittance %.3f %%\n", slicing,
                    batch, slices, 100 * error, 100 * hidden);
        EXPECT_LT(hidden, bound) << slicing << " " << batch << " " << slices;
        // In batches, as half-way between light and view, light goes slab by slab and stays coarse.
        if (slicing == WLK_SLICING_LIGHT_ALIGNED && batch == 0) {
          EXPECT_LT(error, bound) << slices;
        }
      }
    }
  }
  EXPECT_TRUE(scene.messages().empty()) << scene.messages().front();
}

}  // namespace
