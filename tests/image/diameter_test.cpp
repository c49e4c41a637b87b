// SPDX-License-Identifier: MIT
// Droplets whose diameter changes inside a volume, against an independent march with the phase
// function of each place, and against media of one diameter.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "slicing_scene.hpp"

namespace {

using namespace image_test;

constexpr int SIZE = 64;
constexpr int VOXELS = 8;
constexpr double EDGE = 1000;
constexpr Point CENTRE{0, 0, -3000};
constexpr std::array<float, 2> HALVES{8.0f, 30.0f};  // um, left and right

WlkMedium droplets(WlkContext context, float diameter_um) {
  auto info = welkin::make<WlkMediumInfo>();
  info.diameter_um = diameter_um;
  WlkMedium medium{};
  welkin::check(wlkCreateMedium(context, &info, &medium));
  return medium;
}

void uploadDiameters(WlkContext context, WlkVolume volume, const std::vector<float>& diameters) {
  auto upload = welkin::make<WlkVolumeUpload>();
  std::fill_n(upload.extent, 3, static_cast<uint32_t>(VOXELS));
  upload.data = diameters.data();
  upload.dataSize = diameters.size() * sizeof(float);
  welkin::check(wlkUploadVolumeDiameters(context, volume, &upload));
}

std::vector<float> halves() {
  std::vector<float> diameters(VOXELS * VOXELS * VOXELS);
  for (size_t i = 0; i < diameters.size(); ++i) {
    diameters[i] = HALVES[i % VOXELS < VOXELS / 2 ? 0 : 1];
  }
  return diameters;
}

VoxelField box(double opticalDepth) {
  return cubeField(VOXELS, std::vector<float>(VOXELS * VOXELS * VOXELS, 1.0f), opticalDepth / EDGE,
                   EDGE, CENTRE);
}

std::array<double, 3> phase(WlkContext context, WlkMedium medium, double angle) {
  auto query = welkin::make<WlkPhaseQuery>();
  query.medium = medium;
  query.count = 1;
  query.scatteringAngle = &angle;
  std::array<double, 3> p{};
  welkin::check(wlkEvalPhase(context, &query, p.data()));
  return p;
}

struct Half {
  double rms = 0;    // relative error
  double worst = 0;  // relative error
  double ring = 0;   // where red is brightest beside the shadow point's own light, degrees
  double trueRing = 0;
};

// Pixels whose rays stay in one half, three voxels wide, clear of the blend between the two.
Half compare(const SlicingScene& scene, const Picture& picture, const Camera& camera,
             const Point& light, const RayMarch& march, WlkMedium medium, int half) {
  constexpr double BLEND = EDGE / VOXELS / 2;
  Half result;
  double sum = 0;
  int count = 0;
  double most = 0;
  double trueMost = 0;
  for (int y = 0; y < SIZE; ++y) {
    for (int x = 0; x < SIZE; ++x) {
      const Point ray = camera.ray(x, y, SIZE);
      const double aside = (half == 0 ? -1 : 1) * ray[0] / -ray[2] * (-CENTRE[2] - EDGE / 2);
      const double angle = std::acos(std::clamp(dot(ray, light), -1.0, 1.0));
      const MarchResult truth = march.march(camera.position, ray, 1e30, light);
      if (aside < BLEND || !(truth.scattered > 0)) {
        continue;
      }
      const auto p = phase(scene.context(), medium, angle);
      const auto& got = picture.radiance[static_cast<size_t>(y * SIZE + x)];
      for (size_t c = 0; c < 3; ++c) {
        const double error = got[c] / (truth.scattered * p[c]) - 1;
        sum += error * error;
        result.worst = std::max(result.worst, std::abs(error));
        ++count;
      }
      // Of the glory the ring in red, of its ratio to blue.
      const double ratio = got[0] / got[2];
      const double trueRatio = p[0] / p[2];
      const double away = 180 - angle / DEGREE;
      if (ratio > most) {
        most = ratio;
        result.ring = away;
      }
      if (trueRatio > trueMost) {
        trueMost = trueRatio;
        result.trueRing = away;
      }
    }
  }
  result.rms = std::sqrt(sum / count);
  EXPECT_GT(count, SIZE * SIZE / 2);
  return result;
}

// The eye on the plane between the halves, the sun behind it: each half has its own glory.
TEST(Diameters, EachHalfScattersByItsOwn) {
  SlicingScene scene(SIZE, true);
  const WlkMedium own = droplets(scene.context(), 20);
  const VoxelField field = box(0.8);
  const RayMarch march(field);
  const WlkVolume volume = scene.addVolume(field, own);
  uploadDiameters(scene.context(), volume, halves());
  Camera camera;
  camera.tangent = 0.12;
  scene.setCamera(camera);
  const Point light = normalized({0.002, 0.003, 1});
  scene.setLight(light);
  for (const uint32_t batch : {0u, 16u}) {
    Quality quality;
    quality.batch = batch;
    scene.setQuality(quality);
    const Picture picture = scene.render();
    EXPECT_EQ(picture.nonFinite, 0u);
    std::array<double, 2> ring{};
    for (int half = 0; half < 2; ++half) {
      const auto index = static_cast<size_t>(half);
      const Half result = compare(scene, picture, camera, light, march,
                                  droplets(scene.context(), HALVES[index]), half);
      std::printf("batches of %u, %.0f um: rms %.3f %%, worst %.3f %%, ring at %.2f, truth %.2f\n",
                  batch, static_cast<double>(HALVES[index]), 100 * result.rms, 100 * result.worst,
                  result.ring, result.trueRing);
      // Half of the bound between nodes, and the march's own.
      EXPECT_LT(result.rms, 0.005 + 0.003);
      EXPECT_LT(result.worst, 0.01 + 0.01);
      EXPECT_NEAR(result.ring, result.trueRing, 0.3);
      ring[index] = result.trueRing;
    }
    EXPECT_GT(ring[0], 2 * ring[1]) << "the test could not tell them apart";
  }
  EXPECT_TRUE(scene.messages().empty());
}

double meanDifference(const Picture& a, const Picture& b) {
  double difference = 0;
  double sum = 0;
  for (size_t i = 0; i < a.radiance.size(); ++i) {
    for (size_t c = 0; c < 3; ++c) {
      difference += std::abs(a.radiance[i][c] - b.radiance[i][c]);
      sum += b.radiance[i][c];
    }
  }
  return difference / sum;
}

// One diameter everywhere is a medium of that diameter: exactly so for light scattered once. What
// light scattered before keeps the medium's own diameter, here 2.5 times as large.
TEST(Diameters, OneEverywhereIsAMediumOfIt) {
  struct Case {
    uint32_t scattering;
    double opticalDepth;
    double bound;
  };
  for (const Case& test :
       {Case{WLK_SCATTERING_SINGLE, 8, 0.005}, Case{WLK_SCATTERING_FORWARD, 8, 0.08},
        Case{WLK_SCATTERING_ALL_ORDERS, 8, 0.15}}) {
    constexpr std::array<double, 3> TOWARDS{-0.5, 0.2, 0.9};
    // With the diameters, of a medium of them, of the medium without them.
    std::array<std::array<Picture, 3>, TOWARDS.size()> all;
    for (size_t i = 0; i < 3; ++i) {
      SlicingScene scene(16);
      const float diameter = i == 1 ? 8.0f : 20.0f;
      const WlkVolume volume =
          scene.addVolume(box(test.opticalDepth), droplets(scene.context(), diameter));
      if (i == 0) {
        uploadDiameters(scene.context(), volume,
                        std::vector<float>(VOXELS * VOXELS * VOXELS, 8.0f));
      }
      Camera camera;
      camera.tangent = 0.2;
      scene.setCamera(camera);
      Quality quality;
      quality.scattering = test.scattering;
      quality.slices = 64;
      quality.cells = 16;  // the same for all three
      scene.setQuality(quality);
      for (size_t k = 0; k < TOWARDS.size(); ++k) {
        scene.setLight(normalized({0.3, 0.5, TOWARDS[k]}));
        all[k][i] = scene.render();
      }
    }
    for (size_t k = 0; k < TOWARDS.size(); ++k) {
      const auto& pictures = all[k];
      const double towards = TOWARDS[k];
      const double error = meanDifference(pictures[0], pictures[1]);
      const double without = meanDifference(pictures[2], pictures[1]);
      std::printf("scattering %u, light %4.1f: %.3f %%, the medium's own %.3f %%\n",
                  test.scattering, towards, 100 * error, 100 * without);
      EXPECT_LT(error, test.bound) << test.scattering << " " << towards;
    }
  }
}

// Of the second of two frames: the first one uploads.
WlkFrameStats steadyStats(SlicingScene& scene) {
  scene.render();
  scene.render();
  return scene.stats();
}

// A volume without them records what it always did, also after they are gone again.
TEST(Diameters, CostNothingWithoutThem) {
  SlicingScene scene(16);
  const WlkMedium own = droplets(scene.context(), 20);
  const WlkVolume volume = scene.addVolume(box(2), own);
  Camera camera;
  camera.tangent = 0.2;
  scene.setCamera(camera);
  scene.setLight(normalized({0.3, 0.5, 0.9}));
  scene.setQuality({});
  const Picture before = scene.render();
  const WlkFrameStats without = steadyStats(scene);
  uploadDiameters(scene.context(), volume, halves());
  EXPECT_GT(meanDifference(scene.render(), before), 0.05);
  const WlkFrameStats with = steadyStats(scene);
  EXPECT_EQ(with.dispatches, without.dispatches);
  EXPECT_EQ(with.barriers, without.barriers);
  uploadDiameters(scene.context(), volume,
                  std::vector<float>(VOXELS * VOXELS * VOXELS, std::nanf("")));
  EXPECT_LT(meanDifference(scene.render(), before), 0.005) << "no diameter: the medium's own";
  welkin::check(wlkClearVolumeDiameters(scene.context(), volume));
  EXPECT_EQ(scene.render().radiance, before.radiance);
  const WlkFrameStats after = steadyStats(scene);
  EXPECT_EQ(after.dispatches, without.dispatches);
  EXPECT_EQ(after.barriers, without.barriers);
  welkin::check(wlkClearVolumeDiameters(scene.context(), volume));
  EXPECT_EQ(scene.render().radiance, before.radiance);
}

}  // namespace
