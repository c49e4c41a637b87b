// SPDX-License-Identifier: MIT
// Once-scattered light of a cloud against the ray march: error and time per slice count, and what
// small moves of light and camera change.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "cloud_scene.hpp"

namespace {

using namespace image_test;

constexpr int SIZE = 64;
constexpr std::array<double, 6> ANGLES{10, 45, 89.9, 90.1, 135, 170};  // degrees, [R04] flips at 90
constexpr std::array<uint32_t, 2> SLICINGS{WLK_SLICING_LIGHT_ALIGNED, WLK_SLICING_HALF_ANGLE};

const char* nameOf(uint32_t slicing) {
  return slicing == WLK_SLICING_HALF_ANGLE ? "half-angle" : "light-aligned";
}

class Cloud {
 public:
  explicit Cloud(const VoxelField& field, int size = SIZE)
      : size_(size), march_(field), scene_(size) {
    scene_.addVolume(field, scene_.henyeyGreenstein(CLOUD_G));
    move(cloudCamera());
  }
  void move(const Camera& camera) {
    camera_ = camera;
    scene_.setCamera(camera);
  }
  std::vector<double> truth(double angle) const {
    return marchPicture(march_, camera_, size_, lightAtAngle(angle), CLOUD_G);
  }
  Picture render(double angle, uint32_t slicing, uint32_t slices) {
    scene_.setLight(lightAtAngle(angle));
    Quality quality;
    quality.slicing = slicing;
    quality.slices = slices;
    scene_.setQuality(quality);
    return scene_.render();
  }

 private:
  int size_;
  RayMarch march_;
  SlicingScene scene_;
  Camera camera_;
};

// Relative RMS error for 32, 64, 128 and 256 slices.
std::array<double, 4> errors(Cloud& cloud, double angle, uint32_t slicing,
                             const std::vector<double>& truth) {
  std::array<double, 4> result{};
  std::printf("%6.1f %-13s", angle, nameOf(slicing));
  for (size_t i = 0; i < result.size(); ++i) {
    const Picture picture = cloud.render(angle, slicing, 32u << i);
    EXPECT_EQ(picture.nonFinite, 0u);
    result[i] = relativeRms(picture.red(), truth);
    std::printf(" | %6.2f %% %+6.2f %% %5.1f %6.1f", 100 * result[i],
                100 * (mean(picture.red()) / mean(truth) - 1), picture.eye_ms, picture.light_ms);
  }
  std::printf("\n");
  return result;
}

void printHead(const char* field) {
  std::printf("%s; per slice count 32, 64, 128, 256: relative RMS error, bias, eye ms, light ms\n",
              field);
}

TEST(SingleScattering, NoiseCloudIsWithin3PercentAt128SlicesAndSecondOrder) {
  constexpr double BOUND = 0.03;
  // Differences this small come from the light buffer's texels, not from the slices.
  constexpr double FLOOR = 0.004;
  Cloud cloud(noiseCloudField());
  printHead("noise cloud");
  for (const double angle : ANGLES) {
    const std::vector<double> truth = cloud.truth(angle);
    for (const uint32_t slicing : SLICINGS) {
      const std::array<double, 4> e = errors(cloud, angle, slicing, truth);
      EXPECT_LE(e[2], BOUND) << angle << " " << nameOf(slicing);
      for (size_t i = 0; i + 1 < e.size(); ++i) {
        // Halving the slabs quarters the error down to the floor; 2^1.5 leaves room for the
        // thickest slabs, whose third-order term is not small.
        EXPECT_LE(e[i + 1], std::max(e[i] / std::exp2(1.5), FLOOR))
            << angle << " " << nameOf(slicing) << " " << (32 << i);
      }
    }
  }
}

TEST(SingleScattering, SteepCloudIsWithin15PercentAt128Slices) {
  constexpr double BOUND = 0.15;  // 3 slabs, 4 light texels per voxel of depth 4
  Cloud cloud(steepCloudField());
  printHead("steep cloud");
  for (const double angle : {10.0, 90.1, 135.0}) {
    const std::vector<double> truth = cloud.truth(angle);
    for (const uint32_t slicing : SLICINGS) {
      EXPECT_LE(errors(cloud, angle, slicing, truth)[2], BOUND) << angle << " " << nameOf(slicing);
    }
  }
}

// Change of the picture when the light moves by 0.2 degrees, over the true change.
double excess(Cloud& cloud, double from, uint32_t slicing, uint32_t slices, double trueChange) {
  const std::vector<double> a = cloud.render(from, slicing, slices).red();
  const std::vector<double> b = cloud.render(from + 0.2, slicing, slices).red();
  return relativeRms(b, a) / trueChange;
}

TEST(SingleScattering, MovingTheLightChangesThePictureByNoMoreThanTheTruth) {
  constexpr double BOUND = 1.5;
  constexpr double STEP = 22.5;  // degrees between the places where the light moves
  Cloud cloud(noiseCloudField(), 32);
  std::printf("noise cloud, 128 slices; light moved by 0.2 degrees: true change, change / true\n");
  for (double angle = 0; angle <= 180; angle += STEP) {
    const double from = std::min(std::max(angle - 0.1, 0.5), 179.3);  // across 90, within 0 ... 180
    const double change = relativeRms(cloud.truth(from + 0.2), cloud.truth(from));
    const double aligned = excess(cloud, from, WLK_SLICING_LIGHT_ALIGNED, 128, change);
    const double half = excess(cloud, from, WLK_SLICING_HALF_ANGLE, 128, change);
    std::printf("%6.1f: %.3f %%, light-aligned %.3f, half-angle %.3f\n", from, 100 * change,
                aligned, half);
    EXPECT_LE(aligned, BOUND) << from;
  }
}

TEST(SingleScattering, MovingTheLightOverASteepCloudCalmsDownWithMoreSlices) {
  // Slabs 1.5 optical depths thick sample the bright edge at a few places that move with the light:
  // such a cloud needs more slices. Second order would be 1/4 of the surplus.
  constexpr double LEFT_OF_SURPLUS = 0.5;
  Cloud cloud(steepCloudField(), 32);
  std::printf("steep cloud; as above, for 128 and 512 slices\n");
  for (const double from : {89.9, 104.9}) {
    const double change = relativeRms(cloud.truth(from + 0.2), cloud.truth(from));
    const double coarse = excess(cloud, from, WLK_SLICING_LIGHT_ALIGNED, 128, change);
    const double fine = excess(cloud, from, WLK_SLICING_LIGHT_ALIGNED, 512, change);
    std::printf("%6.1f: %.3f %%, light-aligned %.3f, %.3f; half-angle %.3f, %.3f\n", from,
                100 * change, coarse, fine,
                excess(cloud, from, WLK_SLICING_HALF_ANGLE, 128, change),
                excess(cloud, from, WLK_SLICING_HALF_ANGLE, 512, change));
    EXPECT_LE(fine - 1, LEFT_OF_SURPLUS * (coarse - 1)) << from;
  }
}

TEST(SingleScattering, MovingTheCameraAlongTheViewKeepsTheBrightness) {
  // Error of the mean radiance while slabs pass under the rays: at most its spread over 2 slabs.
  constexpr double BOUND = 0.002;
  Cloud cloud(noiseCloudField(), 32);
  for (const uint32_t slicing : SLICINGS) {
    double low = 1e9;
    double high = -1e9;
    for (int step = 0; step < 6; ++step) {
      Camera camera = cloudCamera();
      camera.position[2] -= 1.75 * step;  // m; slabs are 5 to 7 m thick
      cloud.move(camera);
      const double bias = mean(cloud.render(120, slicing, 128).red()) / mean(cloud.truth(120)) - 1;
      low = std::min(low, bias);
      high = std::max(high, bias);
    }
    std::printf("camera moved by 8.75 m, %s: bias of the mean %.4f ... %.4f %%\n", nameOf(slicing),
                100 * low, 100 * high);
    EXPECT_LE(high - low, BOUND);
  }
}

}  // namespace
