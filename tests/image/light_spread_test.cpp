// SPDX-License-Identifier: MIT
// WlkQuality::lightFrames under a sun that moves 0.25 degrees per frame: the picture follows the
// one whose light is computed at once, smoothly and within a bound.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "cloud_scene.hpp"
#include "support/headless_scene.hpp"

namespace {

using welkin::test::boxTransform;
using welkin::test::HeadlessScene;
using welkin::test::Image;
using welkin::test::SceneOptions;

constexpr double SPEED = 0.25;  // degrees per frame
constexpr double START = 50;    // degrees, azimuth: from behind the cloud to its side
constexpr uint32_t N = 24;

// A cloud of several lumps, of optical depth 30 along its edge.
class Cloud {
 public:
  explicit Cloud(uint32_t lightFrames) : scene_(options()) {
    scene_.setCamera({0, 2, 0}, 0, 12);
    const WlkVolume volume =
        scene_.addVolume(scene_.addHenyeyGreenstein(0.85f), {N, N, N},
                         boxTransform({-1000, 500, -6000}, {2000, 2000, 2000}), 0.03f);
    std::vector<float> values;
    for (uint32_t z = 0; z < N; ++z) {
      for (uint32_t y = 0; y < N; ++y) {
        for (uint32_t x = 0; x < N; ++x) {
          const auto at = [](uint32_t i) { return (static_cast<float>(i) + 0.5f) / N - 0.5f; };
          const float r = std::sqrt(at(x) * at(x) + at(y) * at(y) + at(z) * at(z));
          const float lumps = std::sin(17 * at(x)) * std::sin(15 * at(y)) * std::sin(13 * at(z));
          values.push_back(std::clamp(5 * (0.42f - r + 0.15f * lumps), 0.0f, 1.0f));
        }
      }
    }
    scene_.upload(volume, {N, N, N}, values);
    auto quality = welkin::make<WlkQuality>();
    quality.level = WLK_QUALITY_LOW;
    quality.scattering = WLK_SCATTERING_ALL_ORDERS;
    quality.lightFrames = lightFrames;
    welkin::check(wlkSetQuality(scene_.context, scene_.view, &quality));
    scene_.setSun(25, START);
    scene_.render();
  }
  ~Cloud() { EXPECT_TRUE(scene_.messages().empty()) << scene_.messages().front(); }
  Image frame(double azimuth) const {
    scene_.setSun(25, azimuth);
    welkin::check(wlkRenderHeadless(scene_.context, scene_.view, nullptr));
    return scene_.read(WLK_IMAGE_COLOR);
  }

 private:
  static SceneOptions options() {
    SceneOptions options;
    options.width = 32;
    options.height = 24;
    return options;
  }
  HeadlessScene scene_;
};

// RMS of the difference over that of the picture: black around a cloud does not count.
double apartFrom(const Image& picture, const Image& truth) {
  double difference = 0;
  double all = 0;
  for (size_t i = 0; i < truth.rgba.size(); ++i) {
    if (i % 4 < 3) {
      const double value = static_cast<double>(truth.rgba[i]);
      difference += std::pow(static_cast<double>(picture.rgba[i]) - value, 2);
      all += value * value;
    }
  }
  return std::sqrt(difference / all);
}

TEST(LightSpread, FollowsAMovingSunWithoutPumping) {
  constexpr uint32_t FRAMES = 8;
  constexpr int COUNT = 6 * static_cast<int>(FRAMES);
  const Cloud atOnce(1);
  const Cloud spread(FRAMES);
  std::vector<double> wanted;
  std::vector<double> shown;
  double worst = 0;
  for (int i = 1; i <= COUNT; ++i) {
    const Image truth = atOnce.frame(START + SPEED * i);
    const Image picture = spread.frame(START + SPEED * i);
    ASSERT_EQ(picture.badValues(), 0u);
    worst = std::max(worst, apartFrom(picture, truth));
    wanted.push_back(truth.mean());
    shown.push_back(picture.mean());
  }
  double ownStep = 0;
  double step = 0;
  double kink = 0;  // second difference: what pumping is made of
  for (size_t i = 1; i < shown.size(); ++i) {
    EXPECT_LT(wanted[i], wanted[i - 1]) << "the cloud darkens, or the test is void";
    EXPECT_LT(shown[i], shown[i - 1]) << "the picture pumps at frame " << i;
    ownStep = std::max(ownStep, wanted[i - 1] - wanted[i]);
    step = std::max(step, shown[i - 1] - shown[i]);
    if (i + 1 < shown.size()) {
      kink = std::max(kink, std::abs(shown[i + 1] - 2 * shown[i] + shown[i - 1]));
    }
  }
  std::printf("rms %.4f, step %.3g of %.3g, kink %.3g, mean %.4f to %.4f\n", worst, step, ownStep,
              kink, wanted.front(), wanted.back());
  // Light is up to 2 * 8 - 2 frames old, 3.5 degrees: 0.031 measured.
  EXPECT_LE(worst, 0.04);
  // The sun's own speed, and where it stood 3.5 degrees ago brightness changes up to 1.3 times as
  // fast. Without fading a step would be that of 8 frames.
  EXPECT_LE(step, 1.5 * ownStep);
  EXPECT_LE(kink, 0.5 * ownStep);
}

// Where the last complete light is shown alone it is that of a few frames ago, exactly.
TEST(LightSpread, ShowsTheLightOfAFewFramesAgo) {
  const Cloud spread(4);
  Image picture;
  for (int i = 1; i <= 10; ++i) {
    picture = spread.frame(START + SPEED * i);
  }
  const Cloud still(4);
  Image rested;
  for (int i = 0; i < 13; ++i) {
    rested = still.frame(START + SPEED * 10);
  }
  const double apart = apartFrom(picture, rested);
  std::printf("apart %.5f\n", apart);
  EXPECT_GT(apart, 0);
  EXPECT_LE(apart, 0.02);
}

}  // namespace
