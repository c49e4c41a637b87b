// SPDX-License-Identifier: MIT
// WLK_SCATTERING_ALL_ORDERS in wide layers against the discrete ordinates of tests/reference, in
// 1/sr per unit irradiance, at optical depths and suns that no table of the benchmarks has.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "reference/slab_solver.hpp"
#include "slicing_scene.hpp"

namespace {

using namespace image_test;
namespace rt = welkin::reference;

constexpr double HEIGHT = 1e3;  // m
constexpr double WIDTH = 40e3;  // m; light that enters at its edges is far from its middle
constexpr int VOXELS = 8;
constexpr int PIXELS = 4;
constexpr double G = 0.85;

struct View {
  double zenith;
  double azimuth;
};
constexpr View VIEWS[] = {{0, 0}, {30 * DEGREE, 90 * DEGREE}, {60 * DEGREE, 150 * DEGREE}};

class Layer : public ::testing::Test {
 protected:
  Layer() : scene_(PIXELS), medium_(scene_.henyeyGreenstein(G)) {}
  ~Layer() override { EXPECT_TRUE(scene_.messages().empty()) << scene_.messages().front(); }

  void light(double sun_deg, uint32_t scattering) {
    sun_ = sun_deg * DEGREE;
    scene_.setLight({-std::sin(sun_), std::cos(sun_), 0});
    Quality quality;
    quality.scattering = scattering;
    quality.slices = quality.lightSize = 0;  // of the level
    scene_.setQuality(quality);
    single_ = scattering == WLK_SCATTERING_SINGLE;
  }

  // Largest |radiance over the truth's - 1| of all views, of light that comes back alone where
  // scattered once: what is let through then is too little to have a figure.
  double worst(double tau, double distance) {
    VoxelField field = cubeField(VOXELS, std::vector<float>(size_t{VOXELS} * VOXELS * VOXELS, 1.0F),
                                 tau / HEIGHT, HEIGHT, {0, 0, 0});
    for (const size_t axis : {size_t{0}, size_t{2}}) {
      field.worldFromBox[5 * axis] = WIDTH;
      field.worldFromBox[4 * axis + 3] = -WIDTH / 2;
    }
    const WlkVolume volume = scene_.addVolume(field, medium_);
    double most = 0;
    for (const double side : {1.0, -1.0}) {
      if (single_ && side < 0) {
        continue;
      }
      for (const View& view : VIEWS) {
        const double sine = std::sin(view.zenith);
        const Point travel{sine * std::cos(view.azimuth), side * std::cos(view.zenith),
                           sine * std::sin(view.azimuth)};
        Camera camera;
        camera.position = Point{0, side * HEIGHT / 2, 0} + distance * travel;
        camera.forward = -1.0 * travel;
        camera.up = {0, 0, 1};
        camera.tangent = 3.5 / distance;  // m of the layer, on either side
        scene_.setCamera(camera);
        const double seen = mean(scene_.render().red());
        const rt::SlabRadiance all =
            solver_.radiance(tau, std::cos(sun_), {travel[1], view.azimuth});
        const double truth = single_ ? all.single : all.total;
        std::printf("%g, %g m, %+.0f: %+.1f %%\n", tau, distance, side * view.zenith / DEGREE,
                    100 * (seen / truth - 1));
        most = std::max(most, std::abs(seen / truth - 1));
      }
    }
    scene_.removeVolume(volume);
    return most;
  }

  SlicingScene scene_;
  WlkMedium medium_;
  double sun_ = 0;
  bool single_ = false;
  rt::SlabSolver solver_{rt::henyeyGreensteinSlabPhase(G), 1};
};

// At HIGH; without harmonics of degree 4, thin ones are 16 % too dark along the normal. Bounds are
// half as much again as was measured.
TEST_F(Layer, SeenFromAfarIsThatOfDiscreteOrdinates) {
  light(63, WLK_SCATTERING_ALL_ORDERS);
  EXPECT_LT(worst(0.7, 100e3), 0.06);
  EXPECT_LT(worst(7, 100e3), 0.03);
  EXPECT_LT(worst(32, 100e3), 0.05);
}

// Light that goes on towards the sun's side, below a layer and a low sun: without what cells show
// of Y(4, 1) it is 5.2 % too bright. 4.3 % was measured, above, where cells are wide.
TEST_F(Layer, OfALowSunIsDimTowardsTheSunFromBelow) {
  light(75, WLK_SCATTERING_ALL_ORDERS);
  EXPECT_LT(worst(4.5, 100e3), 0.047);
}

// An eye close to cells that are wide sees each ray's direction, not that of the cells' middles.
TEST_F(Layer, SeenFromNearbyIsTheSame) {
  light(63, WLK_SCATTERING_ALL_ORDERS);
  EXPECT_LT(worst(2, 2e3), 0.05);
}

// Slabs parallel to the layer, whose faces have no part of the optical depth smeared over them.
// Slabs across the light lose up to 99 % of what is scattered once.
TEST_F(Layer, OfALowSunTakesUpLightAtItsFace) {
  light(78, WLK_SCATTERING_SINGLE);
  EXPECT_LT(worst(3, 20e3), 0.001);
  EXPECT_LT(worst(50, 20e3), 0.001);
  light(78, WLK_SCATTERING_ALL_ORDERS);
  EXPECT_LT(worst(50, 20e3), 0.05);
}

}  // namespace
