// SPDX-License-Identifier: MIT
#include "common/cloud_mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

namespace {

using host::CloudMesh;
using host::Vec3;

Vec3 corner(const CloudMesh& mesh, uint32_t vertex) {
  const auto& p = mesh.positions[vertex];
  return {double{p[0]}, double{p[1]}, double{p[2]}};
}

struct Measures {
  double volume = 0.0;
  double area = 0.0;
  double smallest = 1e30;  // triangle
};

// Volume by the divergence theorem: positive for triangles that face outwards.
Measures measure(const CloudMesh& mesh) {
  Measures sum;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 p = corner(mesh, a);
    const Vec3 normal = host::cross(corner(mesh, b) - p, corner(mesh, c) - p);
    sum.volume += host::dot(p, normal) / 6.0;
    sum.area += host::length(normal) / 2.0;
    sum.smallest = std::min(sum.smallest, host::length(normal) / 2.0);
  }
  return sum;
}

void expectClosed(const CloudMesh& mesh) {
  std::map<std::pair<uint32_t, uint32_t>, int> uses;
  std::vector<bool> used(mesh.positions.size());
  for (const auto& triangle : mesh.triangles) {
    for (size_t i = 0; i < 3; ++i) {
      ASSERT_LT(triangle[i], mesh.positions.size());
      used[triangle[i]] = true;
      ++uses[{triangle[i], triangle[(i + 1) % 3]}];
    }
  }
  size_t open = 0;
  for (const auto& [edge, count] : uses) {
    const auto back = uses.find({edge.second, edge.first});
    open += count != 1 || back == uses.end() ? 1u : 0u;
  }
  EXPECT_EQ(open, 0u) << "edges not walked once each way";
  EXPECT_EQ(std::count(used.begin(), used.end(), false), 0) << "vertices without a triangle";
}

void expectCloud(const CloudMesh& mesh) {
  expectClosed(mesh);
  const Measures measures = measure(mesh);
  EXPECT_GT(measures.volume, 0.0);
  EXPECT_GT(measures.smallest, 0.0);
}

TEST(CloudMesh, SphereIsClosedAndOfItsSize) {
  host::SphereMesh shape;
  shape.radius = 3.0;
  shape.subdivisions = 5;
  const CloudMesh mesh = makeMesh(shape);
  expectCloud(mesh);
  EXPECT_EQ(mesh.triangles.size(), size_t{8} << 10u);
  // Between the sphere and the one that its planes touch. The largest triangle is that in the
  // middle of the octahedron's: edges sqrt(2) / 2^5 there, pushed out by sqrt(3); circumradius 1 /
  // sqrt(3).
  const double inner = std::cos(std::sqrt(2.0) / 32.0);
  const Measures measures = measure(mesh);
  EXPECT_LT(measures.volume / (36.0 * host::PI), 1.0);
  EXPECT_GT(measures.volume / (36.0 * host::PI), inner * inner * inner);
  EXPECT_LT(measures.area / (36.0 * host::PI), 1.0);
  EXPECT_GT(measures.area / (36.0 * host::PI), inner * inner);
}

TEST(CloudMesh, BoxIsClosedAndOfItsSize) {
  for (const std::array<uint32_t, 3> cells : {std::array<uint32_t, 3>{1, 1, 1}, {4, 2, 3}}) {
    host::BoxMesh shape;
    shape.extent = {5.0, 1.0, 3.0};
    shape.cells = cells;
    const CloudMesh mesh = makeMesh(shape);
    expectCloud(mesh);
    EXPECT_NEAR(measure(mesh).volume, 15.0, 1e-5);
    EXPECT_NEAR(measure(mesh).area, 46.0, 1e-4);
  }
}

TEST(CloudMesh, StratocumulusIsClosedAndMoves) {
  for (const uint32_t cells : {4u, 5u, 96u}) {
    host::StratocumulusMesh shape;
    shape.cells = cells;
    const CloudMesh mesh = makeMesh(shape);
    expectCloud(mesh);
    const host::Affine box = boundsOf(mesh);
    EXPECT_NEAR(box[0], shape.extent.x, 1e-3);
    EXPECT_LE(box[5] + box[7], shape.extent.y);
  }
  host::StratocumulusMesh shape;
  shape.cells = 32;
  const CloudMesh still = makeMesh(shape);
  shape.time = 10.0;
  const CloudMesh moved = makeMesh(shape);
  EXPECT_EQ(still.triangles, moved.triangles) << "animation is of positions only";
  EXPECT_NE(still.positions, moved.positions);
  double largest = 0.0;
  for (size_t i = 0; i < still.positions.size(); ++i) {
    largest = std::max(largest, std::abs(double{still.positions[i][1]} - moved.positions[i][1]));
  }
  EXPECT_LT(largest, 0.3 * shape.extent.y) << "10 s at 6 m/s are a twentieth of a bump";
}

TEST(CloudMesh, CumulusIsClosedAndFitsItsBox) {
  for (const uint32_t seed : {1u, 2u, 3u, 4u}) {
    host::CumulusMesh shape;
    shape.detail = 40;
    shape.seed = seed;
    const CloudMesh mesh = makeMesh(shape);
    expectCloud(mesh);
    const host::Affine box = boundsOf(mesh);
    EXPECT_NEAR(box[0], shape.extent.x, 1e-3);
    EXPECT_NEAR(box[5], shape.extent.y, 1e-3);
    EXPECT_NEAR(box[7], 0.0, 1e-3);
    // Of the box: more than a cone, less than an ellipsoid's whole box.
    EXPECT_GT(measure(mesh).volume, 0.15 * shape.extent.x * shape.extent.y * shape.extent.z);
    EXPECT_LT(measure(mesh).volume, 0.75 * shape.extent.x * shape.extent.y * shape.extent.z);
  }
}

TEST(CloudMesh, SeedsRepeatAndDiffer) {
  host::CumulusMesh shape;
  shape.detail = 24;
  const CloudMesh first = makeMesh(shape);
  EXPECT_EQ(first.positions, makeMesh(shape).positions);
  shape.seed = 9;
  EXPECT_NE(first.positions, makeMesh(shape).positions);
}

TEST(CloudMesh, BoxIsVoxelsOfOne) {
  host::BoxMesh shape;
  shape.extent = {4.0, 1.0, 2.0};
  const host::Grid grid = voxelise(makeMesh(shape), 16);
  EXPECT_EQ(grid.size, (std::array<uint32_t, 3>{16, 4, 8}));
  for (const float value : grid.values) {
    ASSERT_NEAR(value, 1.0, 1e-6);
  }
}

// The sum of voxels is the volume: exact along y, across up to the error of counting columns, of
// which the outline cuts about 2 pi 20 4: half of one each, with random signs.
TEST(CloudMesh, VoxelsHaveTheMeshesVolume) {
  host::CumulusMesh cumulus;
  cumulus.detail = 40;
  for (const CloudMesh& mesh : {makeMesh(host::SphereMesh{}), makeMesh(cumulus)}) {
    const host::Grid grid = voxelise(mesh, 40);
    const host::Affine& box = grid.worldFromVolume;
    const double voxel = box[0] * box[5] * box[10] / static_cast<double>(grid.values.size());
    const double sum = std::accumulate(grid.values.begin(), grid.values.end(), 0.0);
    EXPECT_NEAR(sum * voxel / measure(mesh).volume, 1.0, 3e-3);
    const auto [least, most] = std::minmax_element(grid.values.begin(), grid.values.end());
    EXPECT_EQ(*least, 0.0f);
    EXPECT_NEAR(*most, 1.0f, 1e-5f);
  }
}

}  // namespace
