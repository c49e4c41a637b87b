// SPDX-License-Identifier: MIT
// Volumes with rays in every fourth pixel first against those with rays in each: how far pictures
// differ, opaque edges in front of a cloud, odd and tiny views, several volumes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "reference/noise_volume.hpp"
#include "support/headless_scene.hpp"

namespace welkin::test {
namespace {

constexpr uint32_t N = reference::NOISE_CLOUD_SIZE;

struct HalfScene : HeadlessScene {
  explicit HalfScene(uint32_t width, uint32_t height) : HeadlessScene(sized(width, height)) {
    setSun(40, 60);
    setCamera({0, 0, 0}, 0, 0);
  }
  static SceneOptions sized(uint32_t width, uint32_t height) {
    SceneOptions o;
    o.width = width;
    o.height = height;
    return o;
  }
  WlkVolume addCloud(const std::array<double, 3>& lo, double edge, double depth,
                     uint32_t size = N) const {
    const WlkVolume volume =
        addVolume(addHenyeyGreenstein(0.6f), {size, size, size},
                  boxTransform(lo, {edge, edge, edge}), static_cast<float>(depth * N / edge));
    upload(volume, {size, size, size}, reference::coarseNoiseCloud(size));
    return volume;
  }
  Image at(uint32_t resolution, const WlkHeadlessInputs* targets = nullptr,
           uint32_t scattering = WLK_SCATTERING_FORWARD, uint32_t batch = 0) const {
    auto quality = make<WlkQuality>();
    quality.level = WLK_QUALITY_LOW;
    quality.scattering = scattering;
    quality.batchSize = batch;
    quality.volumeResolution = resolution;
    check(wlkSetQuality(context, view, &quality));
    Image image = render(targets);
    EXPECT_EQ(image.badValues(), 0u);
    return image;
  }
  Image full(const WlkHeadlessInputs* targets = nullptr) const {
    return at(WLK_VOLUME_RESOLUTION_FULL, targets);
  }
  Image half(const WlkHeadlessInputs* targets = nullptr) const {
    return at(WLK_VOLUME_RESOLUTION_HALF, targets);
  }
};

// Of one colour of a pixel over the brightest.
double largestDifference(const Image& a, const Image& b) {
  double brightest = 1e-30;  // black pictures do not differ
  double largest = 0;
  for (size_t i = 0; i < a.rgba.size(); ++i) {
    if (i % 4 < 3) {
      brightest = std::max(brightest, std::abs(double{b.rgba[i]}));
      largest = std::max(largest, std::abs(double{a.rgba[i]} - double{b.rgba[i]}));
    }
  }
  return largest / brightest;
}

// RMS over the pixels in which there is anything, over their mean.
double rmsOfSeen(const Image& image, const Image& truth) {
  double squares = 0;
  double sum = 0;
  double count = 0;
  for (size_t i = 0; i < truth.rgba.size(); i += 4) {
    if (truth.rgba[i] > 0) {
      squares += std::pow(double{image.rgba[i]} - double{truth.rgba[i]}, 2);
      sum += double{truth.rgba[i]};
      count += 1;
    }
  }
  return std::sqrt(squares / count) / (sum / count);
}

// What eye_spread.comp lets through at 32 slabs, as a part of the brightest neighbour (half as much
// of second pixels).
constexpr double BOUND = 0.64 / 32;
// Steps of 8 bounds, half of which a pixel between is wrong by, and as much along the other axis.
constexpr double LARGEST = BOUND * 8 / 2 * 2;

// Voxels of less than 2 pixels in views of 120 to 130, which rays of every second pixel are for,
// and of more, which those of every fourth are for.
constexpr uint32_t FINE = N;
constexpr uint32_t COARSE = N / 4;

struct Shape {
  uint32_t width;
  uint32_t height;
};

TEST(HalfResolution, GivesThePictureOfAllRaysWithinItsBound) {
  for (const uint32_t scattering :
       {WLK_SCATTERING_SINGLE, WLK_SCATTERING_FORWARD, WLK_SCATTERING_ALL_ORDERS}) {
    for (const auto& [sky, size] :
         {std::pair{false, FINE}, std::pair{true, FINE}, std::pair{true, COARSE}}) {
      HalfScene scene(120, 90);
      scene.addCloud({-1000, -1000, -4000}, 2000, 0.3, size);
      if (sky) {
        scene.setSky();
      }
      const Image full = scene.at(WLK_VOLUME_RESOLUTION_FULL, nullptr, scattering);
      const Image half = scene.at(WLK_VOLUME_RESOLUTION_HALF, nullptr, scattering);
      const double rms = rmsOfSeen(half, full);
      const double largest = largestDifference(half, full);
      std::printf("scattering %u, sky %d, %u voxels: RMS %.2e, largest %.2e\n", scattering, sky,
                  size, rms, largest);
      EXPECT_GT(rms, 0.0) << "some pixels take on what their neighbours see";
      EXPECT_LT(rms, BOUND);
      EXPECT_LT(largest, LARGEST);
      EXPECT_TRUE(scene.messages().empty()) << scene.messages().front();
    }
  }
}

// Largest difference of the pixels that have rays of their own: none, since one text computes them
// and the driver contracts nothing.
double largestOfGrid(const Image& a, const Image& b, uint32_t width, uint32_t every) {
  double largest = 0;
  for (size_t i = 0; i < b.rgba.size(); ++i) {
    const size_t pixel = i / 4;
    if (pixel % width % every == 0 && pixel / width % every == 0) {
      largest = std::max(largest, std::abs(double{a.rgba[i]} - double{b.rgba[i]}));
    }
  }
  return largest;
}

TEST(HalfResolution, LeavesPixelsWithRaysOfTheirOwnAsTheyAre) {
  for (const uint32_t scattering : {WLK_SCATTERING_SINGLE, WLK_SCATTERING_ALL_ORDERS}) {
    for (const auto& [size, every] : {std::pair{FINE, 2u}, std::pair{COARSE, 4u}}) {
      HalfScene scene(120, 44);
      scene.addCloud({-1000, -1000, -4000}, 2000, 0.3, size);
      scene.setSky();  // transmittance shows, too
      const Image full = scene.at(WLK_VOLUME_RESOLUTION_FULL, nullptr, scattering);
      const Image half = scene.at(WLK_VOLUME_RESOLUTION_HALF, nullptr, scattering);
      EXPECT_EQ(largestOfGrid(half, full, 120, every), 0.0) << scattering << " " << size;
      EXPECT_FALSE(half == full);
    }
  }
}

TEST(HalfResolution, TakesEveryShapeOfView) {
  for (const Shape& shape : {Shape{1, 1}, Shape{2, 1}, Shape{1, 7}, Shape{2, 2}, Shape{3, 5},
                             Shape{17, 9}, Shape{33, 64}}) {
    HalfScene scene(shape.width, shape.height);
    scene.addCloud({-1000, -1000, -4000}, 2000, 0.3);
    const double apart = largestDifference(scene.half(), scene.full());
    EXPECT_LT(apart, LARGEST) << shape.width << " x " << shape.height;
    EXPECT_TRUE(scene.messages().empty()) << scene.messages().front();
  }
}

TEST(HalfResolution, HoldsInsideACloudAndBehindOthers) {
  HalfScene scene(96, 64);
  scene.setSky();
  scene.addCloud({-1000, -1000, -1200}, 2000, 0.05);  // around the camera
  scene.addCloud({-500, -700, -3500}, 1400, 0.1);
  scene.addCloud({-2000, 200, -6000}, 2500, 0.3);
  const Image full = scene.full();
  const Image half = scene.half();
  std::printf("three clouds: RMS %.2e, largest %.2e\n", rmsOfSeen(half, full),
              largestDifference(half, full));
  EXPECT_LT(rmsOfSeen(half, full), BOUND);
  EXPECT_LT(largestDifference(half, full), 3 * LARGEST);  // each by its own
  // The others lie in the picture.
  scene.setCamera({0, 0, 4000}, 0, 0);
  EXPECT_GT(largestDifference(scene.half(), half), LARGEST);
}

// A wall with bars, lines and single pixels of it, inside of the cloud and in front: where a
// surface hides the cloud for one pixel only, its neighbours show nothing of what it shows.
TEST(HalfResolution, LeavesNoHaloAtOpaqueEdges) {
  constexpr uint32_t SIZE = 65;
  constexpr float NEAR = 0.1f;  // of the default camera: depth = near / distance along the view
  for (const auto& [distance, size] : {std::pair{500.0f, FINE}, std::pair{1800.0f, FINE},
                                       std::pair{500.0f, N / 8}, std::pair{1800.0f, N / 8}}) {
    HalfScene scene(SIZE, SIZE);
    scene.addCloud({-1500, -1500, -4500}, 3000, 0.2, size);
    std::vector<float> depth(size_t{SIZE} * SIZE);
    std::vector<float> color(4 * depth.size(), 0.0f);
    for (uint32_t y = 0; y < SIZE; ++y) {
      for (uint32_t x = 0; x < SIZE; ++x) {
        const bool bar =
            x % 13 == 5 || y % 17 == 8 || (x % 7 == 3 && y % 9 == 2) || (x > 40 && y > 40);
        if (bar) {
          depth[y * SIZE + x] = NEAR / distance;
        }
      }
    }
    auto targets = make<WlkHeadlessInputs>();
    targets.depth = depth.data();
    targets.depthSize = depth.size() * sizeof(float);
    targets.color = color.data();
    targets.colorSize = color.size() * sizeof(float);
    const Image full = scene.full(&targets);
    const Image half = scene.half(&targets);
    const Image open = scene.full();
    double worst = 0;
    double seen = 0;
    double brightest = 0;
    for (size_t i = 0; i < depth.size(); ++i) {
      brightest = std::max(brightest, double{open.rgba[4 * i]});
      seen = std::max(seen, std::abs(double{full.rgba[4 * i]} - double{open.rgba[4 * i]}));
      if (depth[i] > 0) {
        worst = std::max(worst, std::abs(double{half.rgba[4 * i]} - double{full.rgba[4 * i]}));
      }
    }
    std::printf("surface at %.0f m: edges differ by %.2e of the brightest, all by %.2e\n",
                static_cast<double>(distance), worst / brightest, largestDifference(half, full));
    EXPECT_GT(seen, 0.3 * brightest) << "what a wrong neighbour would show";
    EXPECT_LT(worst, BOUND * brightest);
    EXPECT_LT(largestDifference(half, full), LARGEST);
    if (distance < 1000) {
      EXPECT_EQ(worst, 0.0) << "nothing of the cloud in front of the wall";
    }
  }
}

// One row of voxels along x, in a box of so many rows; `edge`: of voxels, along y and z.
struct LoneRow {
  const char* name;
  uint32_t rows;
  uint32_t row;
  double edge;
};

// Rays of every fourth pixel are 208 m apart. What a row shows is 150 m high where it is the whole
// box, 1.5 edges at the box's face and 2 edges between others.
TEST(HalfResolution, SeesARowOfVoxelsWhereverItLiesBetweenRays) {
  for (const LoneRow& lone :
       {LoneRow{"alone", 1, 0, 150}, LoneRow{"at the lower face", 4, 0, 120},
        LoneRow{"at the upper face", 4, 3, 120}, LoneRow{"between others", 5, 2, 120}}) {
    HalfScene scene(120, 90);
    const std::array<uint32_t, 3> size{8, lone.rows, 1};
    const WlkVolume volume = scene.addVolume(
        scene.addHenyeyGreenstein(0.6f), size,
        boxTransform({-1000, -60, -4400}, {2000, lone.rows * lone.edge, 240}), 0.01f);
    std::vector<float> values(size_t{8} * lone.rows, 0.0f);
    std::fill_n(values.begin() + 8 * lone.row, 8, 1.0f);
    scene.upload(volume, size, values);
    for (int i = 0; i < 16; ++i) {
      scene.setCamera({0, 13.0 * i, 0}, 0, 0);  // 208 m in all
      const Image full = scene.full();
      EXPECT_GT(full.mean(), 0.0) << lone.name;
      EXPECT_LT(largestDifference(scene.half(), full), LARGEST) << lone.name << " " << i;
    }
  }
}

TEST(HalfResolution, LeavesBatchesAsTheyAre) {
  HalfScene scene(40, 30);
  scene.addCloud({-1000, -1000, -4000}, 2000, 0.3);
  const auto picture = [&](uint32_t resolution) {
    return scene.at(resolution, nullptr, WLK_SCATTERING_FORWARD, 16);
  };
  EXPECT_TRUE(picture(WLK_VOLUME_RESOLUTION_HALF) == picture(WLK_VOLUME_RESOLUTION_FULL));
}

// Of the levels all but ULTRA take it by themselves, and every controlled view.
TEST(HalfResolution, IsWhatLevelsTake) {
  HalfScene scene(64, 48);
  scene.addCloud({-1000, -1000, -4000}, 2000, 0.3);
  const auto picture = [&](uint32_t level, uint32_t resolution) {
    auto quality = make<WlkQuality>();
    quality.level = level;
    quality.scattering = WLK_SCATTERING_FORWARD;
    quality.volumeResolution = resolution;
    check(wlkSetQuality(scene.context, scene.view, &quality));
    return scene.render();
  };
  for (uint32_t level = WLK_QUALITY_LOW; level <= WLK_QUALITY_ULTRA; ++level) {
    SCOPED_TRACE(level);
    const Image own = picture(level, WLK_VOLUME_RESOLUTION_DEFAULT);
    const Image full = picture(level, WLK_VOLUME_RESOLUTION_FULL);
    const Image half = picture(level, WLK_VOLUME_RESOLUTION_HALF);
    EXPECT_FALSE(half == full);
    EXPECT_TRUE(own == (level == WLK_QUALITY_ULTRA ? full : half));
  }
  auto quality = make<WlkQuality>();
  quality.scattering = WLK_SCATTERING_FORWARD;
  quality.level = quality.lowestLevel = WLK_QUALITY_ULTRA;
  quality.control = WLK_CONTROL_REPORTED_TIME;
  quality.timeBudget_ms = 1000;
  check(wlkSetQuality(scene.context, scene.view, &quality));
  EXPECT_TRUE(scene.render() == picture(WLK_QUALITY_ULTRA, WLK_VOLUME_RESOLUTION_HALF));
}

// Three commands for one where it is asked for, five where every fourth ray sees all voxels;
// nothing else is recorded where it is not.
TEST(HalfResolution, RecordsWhatItsRaysNeed) {
  HalfScene scene(128, 96);
  const WlkVolume fine = scene.addCloud({-1000, -1000, -4000}, 2000, 0.3, FINE);
  const auto eye = [&] {
    for (const WlkPassStats& pass : scene.passes()) {
      if (pass.pass == WLK_PASS_EYE_SLICES) {
        return pass;
      }
    }
    return WlkPassStats{};
  };
  scene.full();
  EXPECT_EQ(eye().commands, 1u);
  const uint64_t full = eye().invocations;
  scene.half();
  EXPECT_EQ(eye().commands, 3u);
  const uint64_t seconds = eye().invocations;
  EXPECT_LT(seconds, full) << "but for those of the list";
  wlkDestroyVolume(scene.context, fine);
  scene.addCloud({-1000, -1000, -4000}, 2000, 0.3, COARSE);
  scene.half();
  EXPECT_EQ(eye().commands, 5u);
  EXPECT_LT(eye().invocations, seconds);
  // Voxels of less than 2 pixels from so far.
  scene.setCamera({0, 0, 3000}, 0, 0);
  scene.half();
  EXPECT_EQ(eye().commands, 3u);
}

}  // namespace
}  // namespace welkin::test
