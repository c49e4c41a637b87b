// SPDX-License-Identifier: MIT
// Five hundred cameras anywhere, looking anywhere, through any usual projection: every picture is
// finite, and no pixel is black that its neighbours are not.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "stress/abuse.hpp"

namespace welkin::test {
namespace {

constexpr int CAMERAS = 500;
constexpr uint32_t WIDTH = 16;
constexpr uint32_t HEIGHT = 9;

class RandomCamera {
 public:
  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(random_() >> 11) * 0x1p-53);
  }
  bool chance(double p) { return uniform(0, 1) < p; }

  // Inside the volume, on the ground, under it, at aircraft's, satellites' and moons' heights.
  void place(WlkCamera& camera) {
    static constexpr double HEIGHTS[] = {0.0, 2.0, -100.0, 300.0, 12e3, 4e5, 4e7, 9e8};
    camera.position[0] = uniform(-2e3, 2e3);
    camera.position[1] = HEIGHTS[random_() % std::size(HEIGHTS)] + uniform(-1.0, 1.0);
    camera.position[2] = uniform(-3e3, 1e3);
  }

  // Any orthonormal axes, one in four mirrored, one in four exactly along the world's.
  void turn(WlkCamera& camera) {
    double yaw = uniform(-std::numbers::pi, std::numbers::pi);
    double pitch = std::asin(uniform(-1, 1));
    const double roll = chance(0.5) ? 0.0 : uniform(-std::numbers::pi, std::numbers::pi);
    if (chance(0.25)) {
      yaw = std::numbers::pi / 2 * std::floor(uniform(0, 4));
      pitch = std::numbers::pi / 2 * std::floor(uniform(-1, 2));
    }
    const double right[3] = {std::cos(yaw), 0, std::sin(yaw)};
    const double up[3] = {-std::sin(yaw) * std::sin(pitch), std::cos(pitch),
                          std::cos(yaw) * std::sin(pitch)};
    const double back[3] = {-std::sin(yaw) * std::cos(pitch), -std::sin(pitch),
                            std::cos(yaw) * std::cos(pitch)};
    const double mirror = chance(0.25) ? -1 : 1;
    for (size_t i = 0; i < 3; ++i) {
      const double x = right[i] * std::cos(roll) + up[i] * std::sin(roll);
      const double y = up[i] * std::cos(roll) - right[i] * std::sin(roll);
      camera.viewFromWorld[3 * i] = static_cast<float>(mirror * x);
      camera.viewFromWorld[3 * i + 1] = static_cast<float>(y);
      camera.viewFromWorld[3 * i + 2] = static_cast<float>(back[i]);
    }
  }

  // Fields of view from a telescope's to 150 degrees, off the axis or not, depth reversed and
  // infinite, or forward between a near and a far plane.
  void project(WlkCamera& camera) {
    const double tangent = std::tan(std::exp(uniform(std::log(1e-4), std::log(1.3))));
    const double near = std::pow(10.0, uniform(-4, 1));
    const bool reversed = chance(0.5);
    const double far = near * std::pow(10.0, uniform(1, 6));
    std::fill(std::begin(camera.clipFromView), std::end(camera.clipFromView), 0.0f);
    camera.clipFromView[0] = static_cast<float>(1 / tangent);
    camera.clipFromView[5] = static_cast<float>(-1 / (tangent * HEIGHT / WIDTH));
    camera.clipFromView[8] = static_cast<float>(chance(0.3) ? uniform(-1, 1) : 0);
    camera.clipFromView[9] = static_cast<float>(chance(0.3) ? uniform(-1, 1) : 0);
    camera.clipFromView[10] = static_cast<float>(reversed ? 0.0 : far / (near - far));
    camera.clipFromView[11] = -1.0f;
    camera.clipFromView[14] = static_cast<float>(reversed ? near : near * far / (near - far));
    camera.preExposure = static_cast<float>(std::pow(10.0, uniform(-2, 2)));
  }

 private:
  std::mt19937_64 random_{1500};
};

// Pixels that have no light where all around them do, as others have seen above the horizon. Edges
// of a few pixels stay apart by asking for all eight neighbours.
uint32_t speckles(const Image& image) {
  const auto light = [&](uint32_t x, uint32_t y) {
    const float* p = image.at(x, y);
    return p[0] + p[1] + p[2];
  };
  uint32_t count = 0;
  for (uint32_t y = 1; y + 1 < image.height; ++y) {
    for (uint32_t x = 1; x + 1 < image.width; ++x) {
      float least = light(x - 1, y);
      for (uint32_t n = 0; n < 9; ++n) {
        least = n == 4 ? least : std::min(least, light(x + n % 3 - 1, y + n / 3 - 1));
      }
      count += light(x, y) < 0.01f * least ? 1U : 0U;
    }
  }
  return count;
}

TEST(RandomCameras, AllGiveFinitePicturesWithoutSpeckles) {
  SceneOptions options;
  options.width = WIDTH;
  options.height = HEIGHT;
  options.validation = false;  // the same calls five hundred times
  const HeadlessScene scene(options);
  scene.setSky();
  scene.setFog(2e-4f, 300.0f);
  scene.addBall(0.005f);
  RandomCamera random;
  uint32_t lit = 0;
  for (int n = 0; n < CAMERAS; ++n) {
    if (n % 20 == 0) {  // the table of skylight follows the sun: seldom
      scene.setSun(random.uniform(-8, 90), random.uniform(0, 360));
    }
    auto camera = make<WlkCamera>();
    random.place(camera);
    random.turn(camera);
    random.project(camera);
    ASSERT_EQ(wlkSetCamera(scene.context, scene.view, &camera), WLK_SUCCESS)
        << n << ": " << lastError().message;
    if (n == 0) {
      ASSERT_EQ(wlkPrepare(scene.context), WLK_SUCCESS);
    }
    ASSERT_EQ(wlkRenderHeadless(scene.context, scene.view, nullptr), WLK_SUCCESS) << "camera " << n;
    const Image image = scene.read(WLK_IMAGE_COLOR);
    ASSERT_EQ(image.badValues(), 0u) << "camera " << n;
    ASSERT_EQ(scene.stats().nonFinitePixels, 0u) << "camera " << n;
    ASSERT_EQ(speckles(image), 0u) << "camera " << n;
    lit += image.mean() > 0 ? 1U : 0U;
  }
  EXPECT_GT(lit, uint32_t{CAMERAS} / 2);
}

}  // namespace
}  // namespace welkin::test
