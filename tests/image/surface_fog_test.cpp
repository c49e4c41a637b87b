// SPDX-License-Identifier: MIT
// A cloud surface behind fog of exponential height, whose transmittance along a ray is known in
// closed form: what the eye gets of the cloud and of what is behind it is dimmed by that.
#include <gtest/gtest.h>

#include <cmath>

#include "support/surface_scene.hpp"

namespace welkin::test {
namespace {

constexpr double FOG = 4e-3;    // 1/m at the ground
constexpr double HEIGHT = 50;   // m, e-fold
constexpr double EYE = 2;       // m over the ground
constexpr double CLOUD = 4e-4;  // 1/m
constexpr double LOWEST = 500;  // m, of the cloud: e^-10 of the fog is left

SceneOptions separate() {
  SceneOptions options;
  options.composite = WLK_COMPOSITE_SEPARATE;
  return options;
}

TEST(SurfaceBehindFog, IsDimmedByTheFogBeforeIt) {
  const HeadlessScene scene(separate());
  scene.setCamera({0, EYE, 0}, 0, 0);
  scene.setSun(40, 60);
  const auto pictures = [&](Image& light, Image& passes) {
    light = scene.render();
    passes = scene.read(WLK_IMAGE_TRANSMITTANCE);
  };
  const auto addCloud = [&] {
    return addSurface(scene, support::boxMesh(), scene.addMedium(), static_cast<float>(CLOUD),
                      {900, 600, 900}, {100, LOWEST + 600, -3000});
  };
  Image cloudLight;
  Image cloudPasses;
  const WlkSurface cloud = addCloud();
  pictures(cloudLight, cloudPasses);
  check(wlkDestroySurface(scene.context, cloud));
  scene.setFog(static_cast<float>(FOG), static_cast<float>(HEIGHT));
  Image fogLight;
  Image fogPasses;
  pictures(fogLight, fogPasses);
  addCloud();
  Image light;
  Image passes;
  pictures(light, passes);
  int covered = 0;
  double worst = 0;
  double worstPassing = 0;
  for (uint32_t y = 0; y < light.height; ++y) {
    for (uint32_t x = 0; x < light.width; ++x) {
      if (cloudLight.at(x, y)[0] == 0) {
        continue;
      }
      ++covered;
      // All of the fog: none is as high as the cloud. The ground's curvature is left out; the
      // cloud is 2 km away, where it sinks by 0.3 m of HEIGHT.
      const double up = pixelDirection(scene, x, y).y;
      const double fog = std::exp(-FOG * HEIGHT * std::exp(-EYE / HEIGHT) / up);
      const double passing = static_cast<double>(cloudPasses.at(x, y)[0]) * fog;
      worstPassing =
          std::max(worstPassing, std::fabs(static_cast<double>(passes.at(x, y)[0]) / passing - 1));
      // The fog's own light is the same with and without the cloud behind it.
      for (uint32_t c = 0; c < 3; ++c) {
        const double seen = static_cast<double>(light.at(x, y)[c] - fogLight.at(x, y)[c]);
        const double expected = static_cast<double>(cloudLight.at(x, y)[c]) * fog;
        worst = std::max(worst, std::fabs(seen / expected - 1));
      }
    }
  }
  std::printf("%d pixels, light %.5f, transmittance %.5f\n", covered, worst, worstPassing);
  EXPECT_GT(covered, 60);
  EXPECT_LT(worst, 2e-3);
  EXPECT_LT(worstPassing, 1e-3);
  for (const std::string& message : scene.messages()) {
    ADD_FAILURE() << message;
  }
}

}  // namespace
}  // namespace welkin::test
