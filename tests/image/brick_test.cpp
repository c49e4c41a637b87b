// SPDX-License-Identifier: MIT
// Fields kept as bricks: the same picture as from their voxels, and what they take.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>

#include "support/brick_volume.hpp"
#include "support/headless_scene.hpp"

namespace {

using namespace welkin::test;
using welkin::check;
using welkin::make;

constexpr std::array<uint32_t, 3> SIZE{61, 34, 45};  // last bricks are partial
constexpr std::array<double, 3> LO{-600, 600, -3000};
constexpr std::array<double, 3> EDGES{1200, 700, 900};

// Balls that end inside bricks, at their faces and at the volume's, in halves that floats give.
std::vector<float> balls(double shift) {
  std::vector<float> values(size_t{SIZE[0]} * SIZE[1] * SIZE[2]);
  constexpr std::array<std::array<double, 4>, 4> BALLS{
      {{16, 16, 16, 8}, {45, 20, 30, 11}, {3, 30, 40, 7}, {58, 2, 5, 9}}};
  for (size_t n = 0; n < values.size(); ++n) {
    const double x = static_cast<double>(n % SIZE[0]);
    const double y = static_cast<double>(n / SIZE[0] % SIZE[1]);
    const double z = static_cast<double>(n / SIZE[0] / SIZE[1]);
    for (const auto& b : BALLS) {
      const double r = std::hypot(x - b[0] - shift, y - b[1], z - b[2]) / b[3];
      // Multiples of 1/256: exact as half floats.
      const double value = r < 1 ? std::ceil(256 * (1 - r * r)) / 256 : 0;
      values[n] = std::max(values[n], static_cast<float>(value));
    }
  }
  return values;
}

struct BrickScene : HeadlessScene {
  explicit BrickScene(const SceneOptions& options, uint32_t fields) : HeadlessScene(options) {
    setSky();
    setSun(35, 70);
    setCamera({0, 900, 0}, 0, 0);
    std::vector<WlkVolumeField> list(fields);
    for (uint32_t i = 0; i < fields; ++i) {
      list[i].medium = addHenyeyGreenstein(0.5f + 0.1f * static_cast<float>(i));
      list[i].extinctionScale = 0.02f / static_cast<float>(1 + i);
    }
    auto info = make<WlkVolumeInfo>();
    std::copy(SIZE.begin(), SIZE.end(), info.size);
    info.fieldCount = fields;
    info.fields = list.data();
    const auto transform = boxTransform(LO, EDGES);
    std::copy(transform.begin(), transform.end(), info.worldFromVolume);
    check(wlkCreateVolume(context, &info, &volume));
  }
  void bricks(uint32_t field, const std::vector<float>& values) const {
    const BrickVolume sparse = bricksOf(SIZE, values);
    const WlkVolumeBricks upload = sparse.upload(field);
    check(wlkUploadVolumeBricks(context, volume, &upload));
  }
  void voxels(uint32_t field, const std::vector<float>& values) const {
    upload(volume, SIZE, values, field);
  }
  WlkVolumeState state() const {
    auto state = make<WlkVolumeState>();
    check(wlkGetVolumeState(context, volume, &state));
    return state;
  }
  WlkVolume volume{};
};

SceneOptions options(uint32_t level) {
  SceneOptions o;
  o.width = 48;
  o.height = 32;
  o.level = level;
  o.volumeCells = 16;  // of the light inside, which takes most of the time at ULTRA
  return o;
}

double largestDifference(const Image& a, const Image& b) {
  double largest = 0;
  for (size_t i = 0; i < a.rgba.size(); ++i) {
    largest = std::max(largest, std::abs(double{a.rgba[i]} - double{b.rgba[i]}));
  }
  return largest / b.mean();
}

// Rounding of a place in the image: 2^-24 of at most 63 texels, twice, times the steepest rise of
// the value, a quarter per voxel, as part of the optical depth; pixels stand up to 10 times above
// the mean. Neither adds up over many samples: they fall on all sides.
constexpr double BOUND = 10 * 2 * 63 * 0x1p-24 * 0.25 * 10;

TEST(Bricks, GiveThePictureOfTheirVoxels) {
  for (const uint32_t level : {WLK_QUALITY_LOW, WLK_QUALITY_MEDIUM, WLK_QUALITY_ULTRA}) {
    BrickScene scene(options(level), 1);
    scene.voxels(0, balls(0));
    const Image dense = scene.render();
    scene.bricks(0, balls(0));
    const Image sparse = scene.render();
    const double apart = largestDifference(sparse, dense);
    std::printf("level %u: bricks against voxels %.1e of the mean\n", level, apart);
    EXPECT_LE(apart, BOUND);
    EXPECT_EQ(sparse.badValues(), 0u);
    // What was uploaded is seen at all.
    scene.bricks(0, std::vector<float>(balls(0).size()));
    EXPECT_GT(largestDifference(scene.render(), dense), 0.1);
    EXPECT_TRUE(scene.messages().empty()) << scene.messages().front();
  }
}

TEST(Bricks, OfSomeFieldsMixWithVoxelsOfOthers) {
  BrickScene scene(options(WLK_QUALITY_MEDIUM), 3);
  const std::array shifts{0.0, 5.0, -9.0};
  for (uint32_t i = 0; i < shifts.size(); ++i) {
    scene.voxels(i, balls(shifts[i]));
  }
  const Image dense = scene.render();
  for (const auto& order : {std::array{2u, 0u, 1u}, std::array{1u, 2u, 0u}}) {
    for (const uint32_t field : order) {
      scene.bricks(field, balls(shifts[field]));
      EXPECT_LE(largestDifference(scene.render(), dense), BOUND) << "field " << field;
    }
    for (const uint32_t field : order) {
      scene.voxels(field, balls(shifts[field]));
      EXPECT_LE(largestDifference(scene.render(), dense), BOUND) << "field " << field;
    }
  }
  EXPECT_EQ(scene.state().storedBricks, 0u);
  EXPECT_TRUE(scene.messages().empty()) << scene.messages().front();
}

TEST(Bricks, ReplaceEachOtherAndVoxelsBeforeAnyCopyRan) {
  BrickScene scene(options(WLK_QUALITY_LOW), 1);
  scene.voxels(0, balls(0));
  const Image first = scene.render();
  scene.bricks(0, balls(20));
  scene.voxels(0, balls(7));
  scene.bricks(0, balls(9));
  scene.bricks(0, balls(0));
  EXPECT_LE(largestDifference(scene.render(), first), BOUND);
  scene.bricks(0, balls(20));
  scene.voxels(0, balls(0));
  EXPECT_TRUE(scene.render() == first);
  // Fewer and more bricks than before, every frame.
  for (const double shift : {30.0, -30.0, 0.0}) {
    scene.bricks(0, balls(shift));
    scene.render();
  }
  EXPECT_LE(largestDifference(scene.render(), first), BOUND);
  EXPECT_TRUE(scene.messages().empty()) << scene.messages().front();
}

// 512^3 voxels, of whose bricks a tenth is occupied, in clumps: at most 1.3 times the occupied
// bricks' floats, on device and host together.
TEST(Bricks, OfALargeSparseCloudTakeLittleMoreThanTheOccupied) {
  constexpr uint32_t N = 512;
  constexpr uint32_t BRICKS = N / 8;
  SceneOptions o = options(WLK_QUALITY_LOW);
  o.validation = false;
  HeadlessScene scene(o);
  scene.setSky();
  scene.setSun(35, 70);
  scene.setCamera({0, 900, 0}, 0, 0);
  const WlkVolume volume =
      scene.addVolume(scene.addHenyeyGreenstein(0.7f), {N, N, N},
                      boxTransform({-600, 400, -3000}, {1200, 1000, 1200}), 0.02f);
  const Image empty = scene.render();
  BrickVolume sparse;
  // 64 balls on a lattice, at all places within bricks.
  constexpr double RADIUS = 33;
  for (uint32_t b = 0; b < BRICKS * BRICKS * BRICKS; ++b) {
    const std::array<uint32_t, 3> brick{b % BRICKS, b / BRICKS % BRICKS, b / BRICKS / BRICKS};
    std::array<float, 512> values{};
    bool any = false;
    for (uint32_t n = 0; n < values.size(); ++n) {
      double squares = 0;
      for (uint32_t axis = 0; axis < 3; ++axis) {
        const uint32_t local = axis == 0 ? n % 8 : axis == 1 ? n / 8 % 8 : n / 64;
        const double at = 8 * brick[axis] + local;
        const double d = std::fmod(at, 128.0) - 64 - 3 * std::floor(at / 128.0);
        squares += d * d;
      }
      values[n] = squares < RADIUS * RADIUS ? 1.0f : 0.0f;
      any = any || values[n] > 0;
    }
    if (any) {
      sparse.coordinates.insert(sparse.coordinates.end(), brick.begin(), brick.end());
      sparse.values.insert(sparse.values.end(), values.begin(), values.end());
    }
  }
  const uint64_t count = sparse.coordinates.size() / 3;
  const double share = static_cast<double>(count) / (BRICKS * BRICKS * BRICKS);
  EXPECT_NEAR(share, 0.1, 0.03);
  const WlkVolumeBricks upload = sparse.upload();
  check(wlkUploadVolumeBricks(scene.context, volume, &upload));
  const Image picture = scene.render();
  EXPECT_GT(largestDifference(picture, empty), 0.1);
  EXPECT_EQ(picture.badValues(), 0u);
  auto state = make<WlkVolumeState>();
  check(wlkGetVolumeState(scene.context, volume, &state));
  EXPECT_EQ(state.occupiedBricks, count);
  EXPECT_EQ(state.pendingMemory, 0u);
  const double floats = static_cast<double>(count) * 512 * 4;
  const double ratio = static_cast<double>(state.deviceMemory + state.hostMemory) / floats;
  std::printf("512^3, %.1f %% of the bricks: %.1f MiB, %.3f of the occupied bricks' floats\n",
              100 * share, static_cast<double>(state.deviceMemory + state.hostMemory) / 1048576,
              ratio);
  EXPECT_LE(ratio, 1.3);
  // A device's images: 64 times the bytes of those bricks when dense.
  EXPECT_LE(scene.stats().deviceMemory, 200u << 20);
}

// Rays that leap sample where the others sample something: nothing but rounding at faces of bricks
// may differ.
TEST(Leaps, LeaveThePictureAsItIs) {
  for (const uint32_t level : {WLK_QUALITY_LOW, WLK_QUALITY_HIGH}) {
    for (const bool bricks : {false, true}) {
      BrickScene scene(options(level), 2);
      scene.setFog(1e-4f, 400);
      const auto show = [&](double shift) {
        for (uint32_t field = 0; field < 2; ++field) {
          const std::vector<float> values = balls(shift - 5 * field);
          bricks ? scene.bricks(field, values) : scene.voxels(field, values);
        }
      };
      show(0);
      for (const auto& eye : {std::array{0.0, 900.0, 0.0}, std::array{100.0, 900.0, -2500.0}}) {
        scene.setCamera(eye, 10, 5);
        scene.setQuality(level, WLK_QUALITY_FLAG_NO_SKIP);
        const Image all = scene.render();
        scene.setQuality(level);
        const Image leaping = scene.render();
        EXPECT_EQ(scene.state().leaps, 1u);
        EXPECT_LE(largestDifference(leaping, all), 0.1 * BOUND) << "level " << level;
        std::printf("level %u, bricks %d: leaps change %.1e of the mean\n", level, bricks,
                    largestDifference(leaping, all));
      }
      // Other contents: nothing is leapt over because of the old.
      show(17);
      const Image moved = scene.render();
      scene.setQuality(level, WLK_QUALITY_FLAG_NO_SKIP);
      EXPECT_LE(largestDifference(moved, scene.render()), 0.1 * BOUND);
      EXPECT_TRUE(scene.messages().empty()) << scene.messages().front();
    }
  }
}

// Steps several voxels long pass beside corners of what is not empty: what lies between two samples
// without anything is not met either.
TEST(Leaps, MeetNothingThatStepsPassBy) {
  constexpr uint32_t N = 64;
  std::vector<float> crumbs(size_t{N} * N * N);
  std::mt19937 random(3);
  std::uniform_int_distribution<size_t> inside(2, N - 3);
  for (int i = 0; i < 60; ++i) {
    const std::array<size_t, 3> at{inside(random), inside(random), inside(random)};
    for (size_t n = 0; n < 27; ++n) {
      crumbs[((at[2] + n / 9 - 1) * N + at[1] + n / 3 % 3 - 1) * N + at[0] + n % 3 - 1] = 1.0f;
    }
  }
  SceneOptions o = options(WLK_QUALITY_LOW);
  o.width = 128;
  o.height = 96;
  HeadlessScene scene(o);
  scene.setSun(35, 70);
  const WlkVolume volume =
      scene.addVolume(scene.addHenyeyGreenstein(0.3f), {N, N, N},
                      boxTransform({-500, 500, -1800}, {1000, 1000, 1000}), 0.01f);
  scene.upload(volume, {N, N, N}, crumbs, 0);
  const auto draw = [&](uint64_t flags) {
    auto quality = make<WlkQuality>();
    quality.sliceCount = 8;
    quality.volumeResolution = WLK_VOLUME_RESOLUTION_FULL;
    quality.flags = flags;
    check(wlkSetQuality(scene.context, scene.view, &quality));
    return scene.render();
  };
  for (const double pitch_deg : {0.0, 10.0}) {
    scene.setCamera({0, 900, 0}, 5, pitch_deg);
    const Image all = draw(WLK_QUALITY_FLAG_NO_SKIP);
    const Image leaping = draw(0);
    EXPECT_GT(all.mean(), 0.0);
    EXPECT_LE(largestDifference(leaping, all), 0.1 * BOUND);
    std::printf("crumbs: leaps change %.1e of the mean\n", largestDifference(leaping, all));
  }
  auto state = make<WlkVolumeState>();
  check(wlkGetVolumeState(scene.context, volume, &state));
  EXPECT_EQ(state.leaps, 1u);
}

// Along a beam of voxels under a sun above, in a layer 2000 times as wide as high, a ray
// takes as many steps as it may, nearly all in bricks that hold something: leaps take rounds
// of their own, and a driver that counts all of them must not end the ray before its time.
TEST(Leaps, LetTheLongestRaysComeToTheirEnd) {
  constexpr std::array<uint32_t, 3> LAYER{64, 64, 64};
  std::vector<float> beam(size_t{64} * 64 * 64);
  for (size_t n = 0; n < beam.size(); ++n) {
    const size_t x = n % 64;
    const size_t y = n / 64 % 64;
    beam[n] = x >= 20 && x < 44 && y >= 26 && y < 38 ? 1.0f : 0.0f;
  }
  SceneOptions o = options(WLK_QUALITY_LOW);
  o.width = 16;
  o.height = 16;
  HeadlessScene scene(o);
  scene.setSun(90, 0);
  auto camera = make<WlkCamera>();
  camera.position[1] = 900;
  camera.clipFromView[0] = 30000;  // no ray leaves the beam
  camera.clipFromView[5] = -30000;
  check(wlkSetCamera(scene.context, scene.view, &camera));
  const WlkVolume volume =
      scene.addVolume(scene.addHenyeyGreenstein(0.0f), LAYER,
                      boxTransform({-30000, 885, -60000}, {60000, 30, 60000}), 1e-5f);
  scene.upload(volume, LAYER, beam, 0);
  scene.setQuality(WLK_QUALITY_LOW, WLK_QUALITY_FLAG_NO_SKIP);
  const Image all = scene.render();
  scene.setQuality(WLK_QUALITY_LOW);
  const Image leaping = scene.render();
  auto state = make<WlkVolumeState>();
  check(wlkGetVolumeState(scene.context, volume, &state));
  EXPECT_EQ(state.leaps, 1u);
  EXPECT_GT(all.mean(), 0.0);
  EXPECT_LE(largestDifference(leaping, all), 0.1 * BOUND);
  std::printf("long rays: leaps change %.1e of the mean\n", largestDifference(leaping, all));
}

TEST(Leaps, AreLeftOutWhereLittleIsEmpty) {
  BrickScene scene(options(WLK_QUALITY_LOW), 1);
  std::vector<float> values(balls(0).size(), 0.5f);
  scene.voxels(0, values);
  scene.render();
  EXPECT_EQ(scene.state().leaps, 0u);
  // Between the two thresholds it stays as it is.
  const auto half = static_cast<std::ptrdiff_t>(values.size() / 2);
  std::fill(values.begin(), values.begin() + half, 0.0f);
  scene.voxels(0, values);
  scene.render();
  EXPECT_EQ(scene.state().leaps, 0u);
  scene.voxels(0, balls(0));
  scene.render();
  EXPECT_EQ(scene.state().leaps, 1u);
  scene.voxels(0, values);
  scene.render();
  EXPECT_EQ(scene.state().leaps, 1u);
  std::fill(values.begin(), values.end(), 0.5f);
  scene.voxels(0, values);
  const Image full = scene.render();
  EXPECT_EQ(scene.state().leaps, 0u);
  EXPECT_EQ(full.badValues(), 0u);
  EXPECT_TRUE(scene.messages().empty()) << scene.messages().front();
}

}  // namespace
