// SPDX-License-Identifier: MIT
// Forward multiple scattering in a homogeneous slab against a quadrature of the same model.
#include "reference/forward_slab.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "reference/phase_reference.hpp"
#include "slicing_scene.hpp"

namespace {

using namespace image_test;
using welkin::reference::ForwardSlab;

constexpr double G = 0.85;
constexpr double THICKNESS = 100.0;  // m
constexpr double WIDTH = 300.0;      // m: the light's way through is 27 m askew at most
constexpr double TILT = 15.0;        // degrees between light and the slab's normal
constexpr Point CENTRE{0, 1000, -1000};

VoxelField slabField(double opticalThickness) {
  VoxelField field = cubeField(1, {1.0f}, opticalThickness / THICKNESS, WIDTH, CENTRE);
  field.worldFromBox[10] = THICKNESS;
  field.worldFromBox[11] = CENTRE[2] - THICKNESS / 2;
  return field;
}

Camera slabCamera() {
  Camera camera;
  camera.position = {0, 1000, 0};
  camera.tangent = 0.02;  // 19 m on the slab
  return camera;
}

// Light behind the slab, or behind the camera, 15 degrees above the horizon.
Point slabLight(bool behind) {
  const double z = std::cos(TILT * DEGREE);
  return {0, std::sin(TILT * DEGREE), behind ? -z : z};
}

// Mean of the picture, and the same of the quadrature pixel by pixel.
double truth(const ForwardSlab& slab, bool behind, int size) {
  double sum = 0;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const Point view = slabCamera().ray(x, y, size);
      const Point light = slabLight(behind);
      sum += slab.radiance(-view[2], std::abs(light[2]), behind, dot(view, light));
    }
  }
  return sum / (size * size);
}

TEST(ForwardSlabReference, MatchesHenyeyGreensteinAndItsHemispheres) {
  const ForwardSlab slab{G, 1, 1};
  for (const double c : {-1.0, -0.3, 0.0, 0.8, 1.0}) {
    const auto hg = static_cast<double>(
        ::reference::henyeyGreenstein(static_cast<long double>(G), static_cast<long double>(c)));
    EXPECT_NEAR(slab.source(0, c), hg, 1e-9 * slab.source(0, 1));
  }
  // Forward part of Henyey-Greenstein, from its distribution function.
  EXPECT_NEAR(slab.forward(0), (1 - G * G) / (2 * G) * (1 / (1 - G) - 1 / std::sqrt(1 + G * G)),
              1e-3);
  EXPECT_NEAR(slab.forward(1e3), 0.5, 1e-9);
}

TEST(ForwardScattering, SlabAgreesWithTheQuadratureWhateverTheSliceCount) {
  constexpr int SIZE = 8;
  constexpr double HALVING = 0.01;  // between N and 2 N slices
  // Table of the source distribution, linear between 32 depth nodes: 0.5 %. 64 slabs of a slab of
  // depth 16 are 0.45 deep: 1.5 % from light at the middle of each stretch.
  constexpr double MODEL = 0.005 + 0.015;
  std::printf("slab, HG %.2f: radiance over quadrature for 64, 128, 256, 512 slices\n", G);
  for (const double depth : {1.0, 4.0, 16.0}) {
    SlicingScene scene(SIZE);
    scene.addVolume(slabField(depth), scene.henyeyGreenstein(G));
    scene.setCamera(slabCamera());
    for (const bool behind : {false, true}) {
      scene.setLight(slabLight(behind));
      const double expected = truth({G, 1, depth}, behind, SIZE);
      for (const uint32_t slicing : {WLK_SLICING_LIGHT_ALIGNED, WLK_SLICING_HALF_ANGLE}) {
        double last = 0;
        std::printf("tau %4.0f %s slicing %u:", depth, behind ? "transmitted" : "reflected  ",
                    slicing);
        for (const uint32_t slices : {64u, 128u, 256u, 512u}) {
          scene.setQuality({slicing, WLK_SCATTERING_FORWARD, slices, 0, 32});
          const double value = mean(scene.render().red());
          std::printf("  %.4f", value / expected);
          EXPECT_NEAR(value / expected, 1, MODEL) << depth << behind << slices;
          if (last > 0) {
            EXPECT_NEAR(value / last, 1, HALVING) << depth << behind << slices;
          }
          last = value;
        }
        std::printf("\n");
      }
    }
  }
}

}  // namespace
