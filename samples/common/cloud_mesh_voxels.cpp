// SPDX-License-Identifier: MIT
// What a closed mesh fills of each voxel: along y exactly, across by 4 x 4 columns per voxel. Where
// a column goes in, all above is filled; where it comes out, all above is emptied.
#include <algorithm>
#include <utility>

#include "common/cloud_mesh.hpp"

namespace host {
namespace {

constexpr uint32_t COLUMNS = 4;

struct Point2 {
  double x = 0.0;
  double z = 0.0;
};

// Which side of the line a-b the point is on. The same for b-a, so that a column through an edge
// meets one of its two triangles.
bool leftOf(Point2 a, Point2 b, Point2 p) {
  const bool turned = std::pair{b.x, b.z} < std::pair{a.x, a.z};
  if (turned) {
    std::swap(a, b);
  }
  const bool left = (b.x - a.x) * (p.z - a.z) - (b.z - a.z) * (p.x - a.x) > 0.0;
  return left != turned;
}

// Columns whose middles may lie in [low, high].
std::pair<uint32_t, uint32_t> columnRange(double low, double high, uint32_t count) {
  const auto clamped = [&](double x) {
    return static_cast<uint32_t>(std::clamp(x, 0.0, static_cast<double>(count)));
  };
  return {clamped(std::floor(low)), clamped(std::ceil(high) + 1.0)};
}

}  // namespace

Grid voxelise(const CloudMesh& mesh, uint32_t resolution) {
  Grid grid;
  grid.worldFromVolume = boundsOf(mesh);
  const Affine& box = grid.worldFromVolume;
  const std::array<double, 3> edge{box[0], box[5], box[10]};
  const double voxel = *std::max_element(edge.begin(), edge.end()) / resolution;
  for (size_t axis = 0; axis < 3; ++axis) {
    grid.size[axis] = std::max(1u, static_cast<uint32_t>(std::ceil(edge[axis] / voxel - 1e-9)));
  }
  const auto& n = grid.size;
  grid.values.assign(checkedVoxelCount("voxels of a mesh", {n[0], n[1], n[2]}), 0.0f);
  std::vector<double> change(grid.values.size(), 0.0);
  const auto fill = [&](uint32_t x, double y, uint32_t z, double share) {
    const double at = std::clamp(y, 0.0, static_cast<double>(n[1]));
    const auto k = static_cast<uint32_t>(at);
    const size_t row = x + size_t{n[0]} * n[1] * z;
    if (k < n[1]) {
      change[row + size_t{n[0]} * k] += share * (k + 1.0 - at);
    }
    if (k + 1 < n[1]) {
      change[row + size_t{n[0]} * (k + 1)] += share * (at - k);
    }
  };
  const Vec3 scale{COLUMNS * n[0] / edge[0], n[1] / edge[1], COLUMNS * n[2] / edge[2]};
  for (const auto& triangle : mesh.triangles) {
    std::array<Point2, 3> flat;
    std::array<double, 3> height{};
    for (size_t i = 0; i < 3; ++i) {
      const auto& p = mesh.positions[triangle[i]];
      const Vec3 local =
          (Vec3{double{p[0]}, double{p[1]}, double{p[2]}} - Vec3{box[3], box[7], box[11]}) * scale;
      flat[i] = {local.x, local.z};
      height[i] = local.y;
    }
    const Point2 u{flat[1].x - flat[0].x, flat[1].z - flat[0].z};
    const Point2 v{flat[2].x - flat[0].x, flat[2].z - flat[0].z};
    const double area = u.x * v.z - u.z * v.x;
    if (area == 0.0) {
      continue;  // upright: columns run past
    }
    // Counter-clockwise from outside: a top side runs clockwise in x and z.
    const double share = (area > 0.0 ? 1.0 : -1.0) / (COLUMNS * COLUMNS);
    const auto [x0, x1] =
        columnRange(std::min({flat[0].x, flat[1].x, flat[2].x}) - 0.5,
                    std::max({flat[0].x, flat[1].x, flat[2].x}) - 0.5, COLUMNS * n[0]);
    const auto [z0, z1] =
        columnRange(std::min({flat[0].z, flat[1].z, flat[2].z}) - 0.5,
                    std::max({flat[0].z, flat[1].z, flat[2].z}) - 0.5, COLUMNS * n[2]);
    for (uint32_t z = z0; z < z1; ++z) {
      for (uint32_t x = x0; x < x1; ++x) {
        const Point2 p{x + 0.5, z + 0.5};
        const bool side = leftOf(flat[0], flat[1], p);
        if (side != leftOf(flat[1], flat[2], p) || side != leftOf(flat[2], flat[0], p)) {
          continue;
        }
        const double s = ((p.x - flat[0].x) * v.z - (p.z - flat[0].z) * v.x) / area;
        const double t = (u.x * (p.z - flat[0].z) - u.z * (p.x - flat[0].x)) / area;
        // Of slivers s and t may be far out.
        const double y =
            std::clamp(height[0] + s * (height[1] - height[0]) + t * (height[2] - height[0]),
                       std::min({height[0], height[1], height[2]}),
                       std::max({height[0], height[1], height[2]}));
        fill(x / COLUMNS, y, z / COLUMNS, share);
      }
    }
  }
  for (uint32_t z = 0; z < n[2]; ++z) {
    for (uint32_t x = 0; x < n[0]; ++x) {
      double sum = 0.0;
      for (uint32_t y = 0; y < n[1]; ++y) {
        const size_t at = x + n[0] * (y + size_t{n[1]} * z);
        sum += change[at];
        // Rounding leaves 1e-16 outside, which would count as cloud.
        grid.values[at] = sum > 1e-9 ? static_cast<float>(sum) : 0.0f;
      }
    }
  }
  return grid;
}

}  // namespace host
