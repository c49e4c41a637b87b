// SPDX-License-Identifier: MIT
#include "reference/voxels.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "reference/noise_volume.hpp"
#include "reference/raymarch.hpp"
#include "reference/statistics.hpp"

namespace welkin::reference {
namespace {

constexpr int N = NOISE_CLOUD_SIZE;
// Turned, sheared and off the origin; about 64 m along an edge.
constexpr std::array<double, 12> PLACE{60, 5, 0, 100, -3, 50, 8, -40, 0, 10, 70, 7};

ParticleField cloudField(double perVoxel) {
  ParticleField field;
  field.values = noiseCloud();
  field.extinctionScale = {perVoxel, 2 * perVoxel, 0.5 * perVoxel};
  return field;
}

VoxelVolume cloud(double perVoxel) {
  return {{N, N, N}, PLACE, {cloudField(perVoxel)}};
}

RayMarch marched(double perVoxel) {
  const std::vector<float> values = noiseCloud();
  VoxelField field{{N, N, N}, {}, PLACE};
  for (const float value : values) {
    field.extinction.push_back(perVoxel * static_cast<double>(value));
  }
  return RayMarch(field);
}

struct TestRay {
  Point origin;
  Point direction;
};

// Through the box in all directions; every third one starts inside.
TestRay rayOf(uint64_t i) {
  Random random(3, i, 0, 0);
  const Point axis{0, 1, 0};
  const Point direction =
      deflected(axis, 2 * random.uniform(), 2 * std::numbers::pi * random.uniform());
  Point inside{};
  const Point unit{random.uniform(), random.uniform(), random.uniform()};
  for (size_t k = 0; k < 3; ++k) {
    inside[k] = PLACE[4 * k] * unit[0] + PLACE[4 * k + 1] * unit[1] + PLACE[4 * k + 2] * unit[2] +
                PLACE[4 * k + 3];
  }
  return {i % 3 == 0 ? inside : along(inside, direction, -200), direction};
}

TEST(VoxelsReference, DepthAgreesWithTheRayMarch) {
  const VoxelVolume volume = cloud(0.3);
  const RayMarch march = marched(0.3);
  constexpr double ROUNDING = 1e-11;  // positions of 200 m to 1e-14, in cells of 1 m
  double deepest = 0;
  for (uint64_t i = 0; i < 400; ++i) {
    const TestRay ray = rayOf(i);
    const double length = i % 4 == 0 ? 215 : FAR;
    const double expected = march.opticalDepth(ray.origin, ray.direction, length);
    EXPECT_NEAR(volume.opticalDepth(ray.origin, ray.direction, 0, length), expected,
                ROUNDING * (1 + expected));
    EXPECT_NEAR(volume.opticalDepth(ray.origin, ray.direction, 1, length), 2 * expected,
                2 * ROUNDING * (1 + expected));
    deepest = std::max(deepest, expected);
  }
  EXPECT_GT(deepest, 4);
}

TEST(VoxelsReference, DepthAlongAxesAndFacesIsFinite) {
  const VoxelVolume volume({N, N, N}, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}, {cloudField(20)});
  for (const double at : {0.0, 0.5, 0.5 / N, 10.5 / N, 12.0 / N, 1.0}) {
    for (size_t axis = 0; axis < 3; ++axis) {
      Point origin{at, at, at};
      Point direction{};
      origin[axis] = -1;
      direction[axis] = 1;
      const double there = volume.opticalDepth(origin, direction, 0, FAR);
      origin[axis] = 2;
      direction[axis] = -1;
      EXPECT_NEAR(volume.opticalDepth(origin, direction, 0, FAR), there, 1e-12) << at;
    }
  }
}

TEST(VoxelsReference, CollisionsFollowTheDepth) {
  const VoxelVolume volume = cloud(0.3);
  std::vector<double> values;
  for (uint64_t i = 0; i < 30000; ++i) {
    const TestRay ray = rayOf(i);
    Random random(5, i, 1, 0);
    const double length = i % 4 == 0 ? 215 : FAR;
    const VoxelCollision hit = volume.collision(ray.origin, ray.direction, 1, length, random);
    const double end = hit.distance == FAR ? length : hit.distance;
    const double through = std::exp(-volume.opticalDepth(ray.origin, ray.direction, 1, end));
    values.push_back(hit.distance == FAR ? through * random.uniform() : through);
  }
  EXPECT_LT(uniformityOf(values), UNIFORMITY);
}

TEST(VoxelsReference, RatioTrackingHasTheMeanOfTheTransmittance) {
  const VoxelVolume volume = cloud(0.1);
  for (const uint64_t i : {1u, 4u, 7u, 9u}) {
    const TestRay ray = rayOf(i);
    const double expected = std::exp(-volume.opticalDepth(ray.origin, ray.direction, 0, FAR));
    constexpr double COUNT = 20000;
    double sum = 0;
    double square = 0;
    for (uint64_t k = 0; k < static_cast<uint64_t>(COUNT); ++k) {
      Random random(9, i, k, 0);
      const double value = volume.ratioTracking(ray.origin, ray.direction, 0, FAR, random);
      sum += value / COUNT;
      square += value * value / COUNT;
    }
    constexpr double ERRORS = 3.5;
    EXPECT_NEAR(sum, expected, ERRORS * std::sqrt((square - sum * sum) / COUNT) + 1e-12);
  }
}

TEST(VoxelsReference, FieldsAreHitInTheRatioOfTheirExtinctions) {
  ParticleField one = cloudField(0.1);
  ParticleField two = cloudField(0.3);
  one.extinctionScale[0] = 0.1;
  two.extinctionScale[0] = 0.3;
  const VoxelVolume both({N, N, N}, PLACE, {one, two});
  const VoxelVolume sum = cloud(0.4);
  int hits[2] = {0, 0};
  for (uint64_t i = 0; i < 20000; ++i) {
    const TestRay ray = rayOf(i);
    EXPECT_NEAR(both.opticalDepth(ray.origin, ray.direction, 0, FAR),
                sum.opticalDepth(ray.origin, ray.direction, 0, FAR), 1e-11);
    Random random(5, i, 1, 0);
    const VoxelCollision hit = both.collision(ray.origin, ray.direction, 0, FAR, random);
    if (hit.distance < FAR) {
      ++hits[hit.field];
    }
  }
  const double count = hits[0] + hits[1];
  constexpr double ERRORS = 3.5;
  EXPECT_NEAR(hits[0] / count, 0.25, ERRORS * std::sqrt(0.25 * 0.75 / count));
}

TEST(VoxelsReference, RefusesWhatIsNoVolume) {
  EXPECT_THROW(VoxelVolume({N, N, N}, PLACE, {}), std::invalid_argument);
  EXPECT_THROW(VoxelVolume({N, N, 1}, PLACE, {cloudField(1)}), std::invalid_argument);
  EXPECT_THROW(VoxelVolume({N, N, N}, {1, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0}, {cloudField(1)}),
               std::invalid_argument);
}

}  // namespace
}  // namespace welkin::reference
