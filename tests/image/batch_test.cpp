// SPDX-License-Identifier: MIT
// The number of slabs per batch is a matter of cost alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "cloud_scene.hpp"
#include "support/on_gpu.hpp"

namespace {

using namespace image_test;

constexpr uint32_t SLICES = 72;  // 7, 16 and 64 do not divide it: the last batch is partial

// Largest difference of any pixel over the picture's mean, radiance and transmittance.
double difference(const Picture& a, const Picture& b) {
  double largest = 0;
  for (size_t channel = 0; channel < 3; ++channel) {
    double sum = 0;
    double worst = 0;
    for (size_t i = 0; i < b.radiance.size(); ++i) {
      sum += b.radiance[i][channel];
      worst = std::max(worst, std::abs(a.radiance[i][channel] - b.radiance[i][channel]));
      largest =
          std::max(largest, std::abs(a.transmittance[i][channel] - b.transmittance[i][channel]));
    }
    largest = std::max(largest, worst * static_cast<double>(b.radiance.size()) / sum);
  }
  return largest;
}

TEST(Batches, AnySizeGivesTheSamePicture) {
  // A stretch's ends are rounded to 2^-24 of their distance (2 km: 1.2e-4 m), 1e-5 of the optical
  // depth of a slab; neighbours move together, so the error does not add up over the slabs. Bright
  // pixels stand up to 10 times above the mean. On a GPU each batch size is a kernel that fuses
  // other products, which doubles the roundings.
  const double bound = (welkin::test::onGpu() ? 2 : 1) * 10 * 1e-5;
  SlicingScene scene(24);
  scene.addVolume(noiseCloudField(), scene.henyeyGreenstein(CLOUD_G));
  double worst = 0;
  for (const bool air : {false, true}) {
    scene.setSky(air);
    scene.setFog(air ? 0.002 : 0);
    for (const bool inside : {false, true}) {
      Camera camera = cloudCamera();
      if (inside) {
        camera.position = CLOUD_CENTRE + Point{60, -90, 110};
        camera.tangent = 0.8;
      }
      scene.setCamera(camera);
      for (const double angle : {60.0, 120.0}) {
        scene.setLight(lightAtAngle(angle));
        for (const uint32_t slicing : {WLK_SLICING_LIGHT_ALIGNED, WLK_SLICING_HALF_ANGLE}) {
          for (const uint32_t scattering : {WLK_SCATTERING_SINGLE, WLK_SCATTERING_FORWARD}) {
            Quality q{slicing, scattering, SLICES, 1, 64};
            scene.setQuality(q);
            const Picture one = scene.render();
            for (const uint32_t batch : {2u, 7u, 16u, 64u, SLICES}) {
              q.batch = batch;
              scene.setQuality(q);
              const double d = difference(scene.render(), one);
              worst = std::max(worst, d);
              EXPECT_LE(d, bound) << "batch " << batch << " slicing " << slicing << " scattering "
                                  << scattering << " angle " << angle << " air " << air
                                  << " inside " << inside;
            }
          }
        }
      }
    }
  }
  std::printf("batch sizes 2, 7, 16, 64, all against 1: largest difference %.1e of the mean\n",
              worst);
}

TEST(Batches, RunWithoutAValidationMessage) {
  SlicingScene scene(24, true);
  scene.addVolume(noiseCloudField(), scene.henyeyGreenstein(CLOUD_G));
  scene.setCamera(cloudCamera());
  scene.setLight(lightAtAngle(60));
  scene.setSky(true);
  scene.setFog(0.002);
  const std::vector<float> depth(24 * 24, cloudCamera().depthAt(12, 12, 24, 1500));
  for (const uint32_t slicing : {WLK_SLICING_LIGHT_ALIGNED, WLK_SLICING_HALF_ANGLE}) {
    for (const uint32_t batch : {1u, 7u, 24u}) {
      scene.setQuality({slicing, WLK_SCATTERING_FORWARD, 24, batch, 32});
      EXPECT_EQ(scene.render().nonFinite, 0u);
      EXPECT_EQ(scene.render(depth).nonFinite, 0u);
    }
  }
  for (const std::string& message : scene.messages()) {
    ADD_FAILURE() << message;
  }
}

}  // namespace
