// SPDX-License-Identifier: MIT
// The volumes' distance in a picture against an independent march: mean distance of what is hidden,
// and how much of it; counts of what it adds to a frame.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "reference/noise_volume.hpp"
#include "reference/raymarch.hpp"
#include "support/distance_scene.hpp"
#include "support/half_float.hpp"

namespace welkin::test {
namespace {

using reference::MarchNode;
using reference::RayMarch;
using reference::VoxelField;

constexpr uint32_t SIZE = DistanceScene::SIZE;
constexpr double EDGE = 2000;
constexpr std::array<double, 3> LO{-1000, -1000, -4000};
constexpr double SLABS = DistanceScene::SLABS;

constexpr uint32_t ALL = reference::NOISE_CLOUD_SIZE;

VoxelField noiseField(double extinction, uint32_t size = ALL) {
  const int N = static_cast<int>(size);
  VoxelField field{{N, N, N}, {}, {EDGE, 0, 0, LO[0], 0, EDGE, 0, LO[1], 0, 0, EDGE, LO[2]}};
  for (const float value : reference::coarseNoiseCloud(size)) {
    field.extinction.push_back(static_cast<double>(value) * extinction);
  }
  return field;
}

WlkVolume addNoise(const EngineScene& scene, double extinction, uint32_t size = ALL) {
  const WlkVolume volume =
      scene.addVolume(scene.addHenyeyGreenstein(0), {size, size, size},
                      boxTransform(LO, {EDGE, EDGE, EDGE}), static_cast<float>(extinction));
  scene.upload(volume, {size, size, size}, reference::coarseNoiseCloud(size));
  return volume;
}

struct Errors {
  double meanDistance = 0;  // over pixels that hide a tenth or more, m
  double worstDistance = 0;
  double meanHidden = 0;
};

Errors compare(const DistanceScene& s, const RayMarch& march, double wall) {
  Errors errors;
  int counted = 0;
  std::vector<MarchNode> nodes;
  for (uint32_t i = 0; i < SIZE * SIZE; ++i) {
    march.nodes({0, 0, 0}, DistanceScene::direction(i), wall > 0 ? wall : 1e30, {0, 1, 0}, 1,
                nodes);
    double hidden = 0;
    double weighted = 0;
    for (const MarchNode& node : nodes) {
      hidden += node.absorbed;
      weighted += node.absorbed * node.distance;
    }
    errors.meanHidden += std::abs(s.at(i)[1] - hidden) / (SIZE * SIZE);
    if (hidden > 0.1) {
      const double error = std::abs(s.at(i)[0] - weighted / hidden);
      errors.meanDistance += error;
      errors.worstDistance = std::max(errors.worstDistance, error);
      ++counted;
    } else if (hidden == 0) {
      EXPECT_EQ(s.at(i)[0], 0) << i;
      EXPECT_EQ(s.at(i)[1], 0) << i;
    }
  }
  EXPECT_GT(counted, 60);
  errors.meanDistance /= counted;
  return errors;
}

TEST(VolumeDistance, IsThatOfAnIndependentMarch) {
  constexpr double EXTINCTION = 0.3 * reference::NOISE_CLOUD_SIZE / EDGE;
  const RayMarch march(noiseField(EXTINCTION));
  DistanceScene s;
  addNoise(s.scene, EXTINCTION);
  s.scene.setSky();  // air does not count, nor how the medium scatters: isotropic, without a peak
  struct Case {
    double elevation, azimuth;
    uint32_t batchSize, slicing, scattering;
    double wall;
  };
  constexpr uint32_t ALIGNED = WLK_SLICING_LIGHT_ALIGNED;
  constexpr uint32_t ALL_ORDERS = WLK_SCATTERING_ALL_ORDERS;
  const double slab = EDGE * std::sqrt(3.0) / SLABS;  // at most
  const std::array cases{Case{30, 170, 0, ALIGNED, WLK_SCATTERING_FORWARD, 0},
                         Case{30, 170, 0, ALIGNED, ALL_ORDERS, 3100},
                         Case{30, 170, 64, ALIGNED, WLK_SCATTERING_FORWARD, 0},
                         Case{30, 170, 16, ALIGNED, ALL_ORDERS, 0},
                         Case{20, 10, 16, ALIGNED, WLK_SCATTERING_SINGLE, 0},
                         Case{60, 90, 16, WLK_SLICING_HALF_ANGLE, WLK_SCATTERING_FORWARD, 3100}};
  for (const Case& test : cases) {
    s.scene.setSun(test.elevation, test.azimuth);
    auto quality = make<WlkQuality>();
    quality.slicing = test.slicing;
    quality.scattering = test.scattering;
    s.setQuality(test.batchSize, quality);
    s.wall = test.wall;
    s.render();
    const Errors errors = compare(s, march, test.wall);
    std::printf("sun %.0f, %.0f, batches of %u: mean %.2f m, worst %.1f m, hidden %.4f\n",
                test.elevation, test.azimuth, test.batchSize, errors.meanDistance,
                errors.worstDistance, errors.meanHidden);
    // Density at the middle of steps of a slab at most: a part of it of second order.
    EXPECT_LT(errors.meanDistance, 0.02 * slab);
    EXPECT_LT(errors.worstDistance, 0.1 * slab);
    EXPECT_LT(errors.meanHidden, 5e-4);
  }
}

// Nothing but the volume: passes leave out what only air needs.
TEST(VolumeDistance, NeedsNoAir) {
  constexpr double EXTINCTION = 0.3 * reference::NOISE_CLOUD_SIZE / EDGE;
  const RayMarch march(noiseField(EXTINCTION));
  DistanceScene s;
  addNoise(s.scene, EXTINCTION);
  const double slab = EDGE * std::sqrt(3.0) / SLABS;  // at most
  for (const uint32_t slicing : {WLK_SLICING_LIGHT_ALIGNED, WLK_SLICING_HALF_ANGLE}) {
    for (const bool lit : {false, true}) {
      if (lit) {
        s.scene.setSun(30, 170);
      }
      auto quality = make<WlkQuality>();
      quality.slicing = slicing;
      s.setQuality(0, quality);
      s.render();
      const Errors errors = compare(s, march, 0);
      EXPECT_LT(errors.meanDistance, 0.02 * slab) << slicing << lit;
      EXPECT_LT(errors.worstDistance, 0.1 * slab) << slicing << lit;
      EXPECT_LT(errors.meanHidden, 5e-4) << slicing << lit;
    }
  }
}

// Rays in every second pixel, or in every fourth of voxels of two pixels: those between take on the
// neighbours' sums where these are smooth.
class VolumeDistanceBetweenRays : public testing::TestWithParam<uint32_t> {};
INSTANTIATE_TEST_SUITE_P(Voxels, VolumeDistanceBetweenRays, testing::Values(ALL, 4u));

TEST_P(VolumeDistanceBetweenRays, IsThatOfAnIndependentMarch) {
  constexpr double EXTINCTION = 0.3 * reference::NOISE_CLOUD_SIZE / EDGE;
  const RayMarch march(noiseField(EXTINCTION, GetParam()));
  DistanceScene s;
  addNoise(s.scene, EXTINCTION, GetParam());
  const double slab = EDGE * std::sqrt(3.0) / SLABS;  // at most
  s.scene.setSky();
  s.scene.setSun(30, 170);
  for (const double wall : {0.0, 3100.0}) {
    auto quality = make<WlkQuality>();
    quality.slicing = WLK_SLICING_LIGHT_ALIGNED;
    quality.scattering = WLK_SCATTERING_FORWARD;
    quality.volumeResolution = WLK_VOLUME_RESOLUTION_HALF;
    s.setQuality(0, quality);
    s.wall = wall;
    s.render();
    const Errors errors = compare(s, march, wall);
    std::printf("half, wall %.0f: mean %.2f m, worst %.1f m, hidden %.5f\n", wall,
                errors.meanDistance, errors.worstDistance, errors.meanHidden);
    // Of voxels below a pixel most pixels have rays of their own, the others see next to nothing.
    // Of wide ones sums are interpolated, second pixels' and then pixels', each within its bound.
    constexpr double INTERPOLATED = (0.32 + 0.64) / SLABS;
    constexpr double FARTHEST = 4000;
    EXPECT_LT(errors.meanDistance, 0.02 * slab);
    EXPECT_LT(errors.worstDistance, GetParam() == ALL ? 0.1 * slab : INTERPOLATED * FARTHEST);
    EXPECT_LT(errors.meanHidden, 5e-4);
  }
}

// Two boxes that overlap, one homogeneous in front: the second adds what the first lets through.
TEST(VolumeDistance, VolumesAddUpInTheOrderOfTheirDistance) {
  constexpr double NEAR_EXTINCTION = 1e-3;
  constexpr double FAR_EXTINCTION = 2e-3;
  DistanceScene s;
  const auto add = [&](double z, double extinction) {
    const WlkVolume box = s.scene.addVolume(s.scene.addHenyeyGreenstein(0), {2, 2, 2},
                                            boxTransform({-4000, -4000, z}, {8000, 8000, 1000}),
                                            static_cast<float>(extinction));
    s.scene.upload(box, {2, 2, 2}, std::vector<float>(8, 1.0f));
  };
  add(-4000, FAR_EXTINCTION);
  add(-2000, NEAR_EXTINCTION);
  for (const double azimuth : {10.0, 170.0}) {
    s.scene.setSun(40, azimuth);
    s.setQuality(16);
    s.render();
    double worst = 0;
    for (uint32_t i = 0; i < SIZE * SIZE; ++i) {
      const double ahead = -DistanceScene::direction(i)[2];
      double passes = 1;
      double weighted = 0;
      const auto through = [&](double begin, double extinction) {
        const double length = 1000 / ahead;
        const double depth = extinction * length;
        const double opacity = 1 - std::exp(-depth);
        const double inside = length * (1 / depth - std::exp(-depth) / opacity);
        weighted += passes * opacity * (begin / ahead + inside);
        passes *= 1 - opacity;
      };
      through(1000, NEAR_EXTINCTION);
      through(3000, FAR_EXTINCTION);
      worst = std::max(worst, std::abs(s.at(i)[0] - weighted / (1 - passes)));
      EXPECT_NEAR(s.at(i)[1], 1 - passes, 1e-5) << i;
    }
    std::printf("two boxes, azimuth %.0f: worst %.2g m\n", azimuth, worst);
    const double floats = 4000 * 6e-8 * 2 * SLABS;  // sums over the steps of both
    EXPECT_LT(worst, 10 * floats);
  }
}

// Without skips every stretch is marched; another size needs buffers of its own.
TEST(VolumeDistance, IsTheSameWithoutSkipsAndAfterAnotherSize) {
  DistanceScene s;
  addNoise(s.scene, 0.005);
  s.scene.setSun(50, 20);
  s.setQuality(0);
  s.render();
  std::vector<std::array<double, 2>> before;
  for (uint32_t i = 0; i < SIZE * SIZE; ++i) {
    before.push_back(s.at(i));
  }
  auto all = make<WlkQuality>();
  all.flags = WLK_QUALITY_FLAG_NO_SKIP;
  s.setQuality(0, all);
  s.render();
  for (uint32_t i = 0; i < SIZE * SIZE; ++i) {
    EXPECT_NEAR(s.at(i)[0], before[i][0], 4000 * 6e-8 * 2 * SLABS) << i;  // floats' sums
    EXPECT_NEAR(s.at(i)[1], before[i][1], 6e-8 * 2 * SLABS) << i;
  }
  s.setQuality(0);
  auto info = make<WlkViewInfo>();
  info.composite = WLK_COMPOSITE_COMPUTE;
  info.targetFormat = WLK_TARGET_RGBA32_FLOAT;
  for (const uint32_t size : {2 * SIZE, SIZE}) {
    info.width = info.height = size;
    check(wlkUpdateView(s.scene.context, s.scene.view, &info));
    check(wlkPrepare(s.scene.context));
    if (size != SIZE) {
      EXPECT_THROW(s.render(), Error);  // the image has the old one
    }
  }
  s.render();
  for (uint32_t i = 0; i < SIZE * SIZE; ++i) {
    EXPECT_EQ(s.at(i), before[i]) << i;
  }
}

TEST(VolumeDistance, CostsNothingUnlessItIsAskedFor) {
  DistanceScene s;
  addNoise(s.scene, 0.005);
  s.scene.setSun(50, 20);
  s.setQuality(16);
  const auto steady = [&] {
    FrameCounts counts;
    for (int i = 0; i < 5; ++i) {
      counts = s.render();
    }
    return counts;
  };
  s.asked = false;
  const FrameCounts without = steady();
  s.asked = true;
  const FrameCounts with = steady();
  EXPECT_EQ(with.view.dispatches, without.view.dispatches + 1);
  EXPECT_EQ(with.view.barriers, without.view.barriers + 3);
  EXPECT_EQ(with.view.descriptorWrites, 0u);
  EXPECT_EQ(with.view.created + with.view.allocated, 0u);
  EXPECT_EQ(s.scene.stats().dispatches, with.view.dispatches);
  EXPECT_EQ(s.scene.stats().barriers, with.view.barriers);
  s.asked = false;
  check(wlkSetVolumeDistance(s.scene.context, s.scene.view, 0));
  const FrameCounts never = steady();
  EXPECT_EQ(std::memcmp(&never.view, &without.view, sizeof never.view), 0);
  s.asked = true;
  EXPECT_THROW(s.scene.renderFrame(), Error);
}

TEST(VolumeDistance, OfAnEmptyViewIsZeroAndHalvesAreRounded) {
  DistanceScene empty;
  check(wlkPrepare(empty.scene.context));
  empty.render();
  DistanceScene full;
  DistanceScene half(VK_FORMAT_R16_SFLOAT);
  for (DistanceScene* s : {&full, &half}) {
    addNoise(s->scene, 0.005);
    s->scene.setSun(50, 20);
    s->setQuality(64);
    s->render();
  }
  for (uint32_t i = 0; i < SIZE * SIZE; ++i) {
    EXPECT_EQ(empty.at(i), (std::array<double, 2>{0, 0}));
    const double truth = full.at(i)[0];
    const double rounded =
        static_cast<double>(decodedHalf(static_cast<const uint16_t*>(half.bytes())[i]));
    EXPECT_NEAR(rounded, truth, truth / 2048) << i;
  }
}

}  // namespace
}  // namespace welkin::test
