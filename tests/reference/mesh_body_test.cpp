// SPDX-License-Identifier: MIT
#include "reference/mesh_body.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "reference/mesh_shapes.hpp"
#include "reference/random.hpp"

namespace welkin::reference {
namespace {

constexpr double ROUNDING = 1e-15 * 100;  // some ten operations on numbers of order 10

Point onSphere(Random& random) {
  return deflected({0, 0, 1}, 2 * random.uniform(), 2 * std::numbers::pi * random.uniform());
}

TEST(MeshBody, LengthInABoxIsThatBetweenItsPlanes) {
  const Point half = {1.5, 0.7, 2};
  const MeshBody box = shaped(boxShape(), half);
  EXPECT_NEAR(box.volume(), 8 * half[0] * half[1] * half[2], ROUNDING);
  std::vector<MeshStretch> memory;
  Random random(1, 0, 0, 0);
  int met = 0;
  for (int i = 0; i < 20000; ++i) {
    const Point origin = along({0, 0, 0}, onSphere(random), 4 * random.uniform());
    const Point direction = onSphere(random);
    double begin = 0;
    double end = 1e30;
    for (size_t k = 0; k < 3; ++k) {
      const double a = (-half[k] - origin[k]) / direction[k];
      const double b = (half[k] - origin[k]) / direction[k];
      begin = std::max(begin, std::min(a, b));
      end = std::min(end, std::max(a, b));
    }
    const double expected = std::max(end - begin, 0.0);
    met += expected > 0;
    // Slopes of 1e-4 are met among so many.
    EXPECT_NEAR(box.length(origin, direction, memory), expected, 1e4 * ROUNDING);
  }
  EXPECT_GT(met, 5000);
}

// Through the middles of all of a sphere's edges, from outside and from within.
TEST(MeshBody, NothingSlipsThroughEdges) {
  const MeshShape mesh = sphereShape(20);
  const MeshBody sphere = shaped(mesh, {1, 1, 1});
  std::vector<MeshStretch> found;
  const auto expectInside = [&](const Point& target, double least) {
    for (const Point& origin : {Point{0, 0, 0}, Point{3, 0, 0}, Point{0, 2, -2}, Point{0, 0, 4}}) {
      const Point direction = normalized(minus(target, origin));
      sphere.inside(origin, direction, found);
      EXPECT_LE(found.size(), 1U);
      const bool within = origin == Point{0, 0, 0};
      double sum = 0;
      for (const MeshStretch& stretch : found) {
        sum += stretch.end - stretch.begin;
      }
      const double closest =
          std::sqrt(std::max(dot(origin, origin) - std::pow(dot(origin, direction), 2), 0.0));
      // A chord of the sphere within the mesh.
      const double chord = std::sqrt(std::max(least * least - closest * closest, 0.0));
      EXPECT_GE(sum, (within ? 1 : 2) * chord - ROUNDING);
      EXPECT_LE(sum, within ? 1 + ROUNDING : 2 + ROUNDING);
    }
  };
  constexpr double WITHIN = 0.98;  // radius of a sphere that is inside the mesh
  for (const auto& triangle : mesh.triangle) {
    for (size_t k = 0; k < 3; ++k) {
      const Point& a = mesh.position[triangle[k]];
      const Point& b = mesh.position[triangle[(k + 1) % 3]];

      expectInside(along(a, minus(b, a), 0.5), WITHIN);
    }
  }
}

TEST(MeshBody, TorusIsCrossedTwice) {
  const MeshBody torus = shaped(torusShape(), {1, 1, 1});
  std::vector<MeshStretch> found;
  torus.inside({-3, 0.01, 0.013}, {1, 0, 0}, found);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_LT(found[0].end, found[1].begin);
  EXPECT_NEAR(found[0].end - found[0].begin, 0.6, 0.02);  // twelve sides for a circle
  torus.inside({-0.7, 0.01, 0.013}, {1, 0, 0}, found);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].begin, 0);
  EXPECT_EQ(found[0].front, MeshStretch::NONE);
}

TEST(MeshBody, RaysEnterWhereNormalsFaceThem) {
  const MeshBody box = shaped(boxShape(), {1, 2, 3});
  std::vector<MeshStretch> found;
  for (size_t k = 0; k < 3; ++k) {
    for (const double side : {-1.0, 1.0}) {
      Point origin = {0.1, 0.2, 0.3};
      origin[k] = 5 * side;
      Point direction{};
      direction[k] = -side;
      box.inside(origin, direction, found);
      ASSERT_EQ(found.size(), 1U);
      EXPECT_NEAR(dot(box.normal(found[0].front), direction), -1, ROUNDING);
    }
  }
}

// Two boxes in one mesh that overlap: their union.
TEST(MeshBody, WhatIsWoundAroundTwiceCountsOnce) {
  MeshShape mesh = boxShape();
  const MeshShape other = mesh;
  for (const Point& p : other.position) {
    mesh.position.push_back({p[0] + 1, p[1], p[2]});
  }
  for (const auto& [a, b, c] : other.triangle) {
    mesh.triangle.push_back({a + 8, b + 8, c + 8});
  }
  const MeshBody both = shaped(mesh, {1, 1, 1});
  std::vector<MeshStretch> memory;
  EXPECT_NEAR(both.length({-5, 0.1, 0.2}, {1, 0, 0}, memory), 3, ROUNDING);
  EXPECT_EQ(memory.size(), 1U);
}

TEST(MeshBody, RefusesWhatIsNotClosed) {
  MeshShape mesh = boxShape();
  mesh.triangle.pop_back();
  EXPECT_THROW(shaped(mesh, {1, 1, 1}), std::invalid_argument);
  mesh.triangle.push_back({1, 7, 8});
  EXPECT_THROW(shaped(mesh, {1, 1, 1}), std::invalid_argument);
  EXPECT_THROW(MeshBody({}, {}), std::invalid_argument);
}

}  // namespace
}  // namespace welkin::reference
