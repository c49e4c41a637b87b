// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "cloud_scene.hpp"

namespace {

using namespace image_test;

constexpr int SIZE = 64;

class Clouds {
 public:
  explicit Clouds(const VoxelField& field) : march_(field), scene_(SIZE) {
    scene_.addVolume(field, scene_.henyeyGreenstein(CLOUD_G));
    scene_.setCamera(cloudCamera());
  }
  std::vector<double> truth(const Point& toLight) {
    return marchPicture(march_, cloudCamera(), SIZE, toLight, CLOUD_G);
  }
  Picture render(const Point& toLight, const Quality& quality) {
    scene_.setLight(toLight);
    scene_.setQuality(quality);
    return scene_.render();
  }

 private:
  RayMarch march_;
  SlicingScene scene_;
};

TEST(SingleScattering, Explore) {
  for (const bool steep : {false, true}) {
    Clouds clouds(steep ? steepCloudField() : noiseCloudField());
    for (const double angle : {10.0, 45.0, 89.9, 90.1, 135.0, 170.0}) {
      const Point light = lightAtAngle(angle);
      const std::vector<double> truth = clouds.truth(light);
      for (const uint32_t slicing : {WLK_SLICING_LIGHT_ALIGNED, WLK_SLICING_HALF_ANGLE}) {
        for (const uint32_t slices : {32u, 64u, 128u, 256u}) {
          Quality q;
          q.slicing = slicing;
          q.slices = slices;
          const Picture p = clouds.render(light, q);
          std::printf("%s %5.1f %s %3u: %6.2f %% bias %+6.2f %%  eye %6.1f light %6.1f ms\n", steep ? "steep" : "noise",
                      angle, slicing == WLK_SLICING_HALF_ANGLE ? "half " : "light", slices,
                      100 * relativeRms(p.red(), truth), 100 * (mean(p.red()) / mean(truth) - 1),
                      p.eye_ms, p.light_ms);
        }
      }
    }
  }
}

}  // namespace
