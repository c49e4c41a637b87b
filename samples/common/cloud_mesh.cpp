// SPDX-License-Identifier: MIT
#include "common/cloud_mesh.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "common/noise.hpp"

namespace host {
namespace {

std::array<float, 3> toFloat(Vec3 p) {
  return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

// Vertices on the integer points of a box's faces, shared by the faces that meet there.
class BoxVertices {
 public:
  BoxVertices(const BoxMesh& shape, CloudMesh& mesh) : shape_(shape), mesh_(mesh) {}

  uint32_t at(const std::array<uint32_t, 3>& point) {
    const auto [found, fresh] =
        index_.try_emplace(point, static_cast<uint32_t>(mesh_.positions.size()));
    if (fresh) {
      const auto& n = shape_.cells;
      mesh_.positions.push_back(
          toFloat(shape_.extent * Vec3{static_cast<double>(point[0]) / n[0] - 0.5,
                                       static_cast<double>(point[1]) / n[1] - 0.5,
                                       static_cast<double>(point[2]) / n[2] - 0.5}));
    }
    return found->second;
  }

 private:
  const BoxMesh& shape_;
  CloudMesh& mesh_;
  std::map<std::array<uint32_t, 3>, uint32_t> index_;
};

// Smooth, in about [0, 1]; each octave goes its own way, so that bumps change as they drift.
double bumps(const StratocumulusMesh& shape, double x, double z) {
  constexpr int OCTAVES = 5;
  constexpr double DRIFT = 6.0;   // m/s of the largest bumps
  constexpr double TURN = 2.4;    // rad, the golden angle: no two octaves alike
  constexpr double SPREAD = 1.3;  // of a sum of octaves, whose extremes rarely meet
  double sum = 0.0;
  double amplitude = 0.5;
  double size = shape.bumpSize;
  for (int i = 0; i < OCTAVES; ++i) {
    const double shift = DRIFT * shape.time / size * (i == 0 ? 1.0 : 0.5);
    sum += amplitude * perlin({x / size + shift * std::cos(TURN * i), 0.37 * i + 0.1 * shift * i,
                               z / size + shift * std::sin(TURN * i)},
                              shape.seed + static_cast<uint32_t>(i));
    amplitude *= 0.45;
    size *= 0.5;
  }
  return std::clamp(0.5 + 0.5 * SPREAD * sum, 0.0, 1.0);
}

// 0 at the rim, 1 inside, with an upright tangent at the rim as a cloud's edge has.
double rimHeight(double u, double v) {
  constexpr double RIM = 0.08;  // of the width
  const auto side = [](double t) {
    const double depth = std::min(std::min(t, 1.0 - t) / RIM, 1.0);
    return std::sqrt(depth * (2.0 - depth));
  };
  return side(u) * side(v);
}

}  // namespace

CloudMesh makeMesh(const SphereMesh& shape) {
  std::vector<Vec3> unit = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  CloudMesh mesh;
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                    {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (uint32_t i = 0; i < shape.subdivisions; ++i) {
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
    const auto middle = [&](uint32_t a, uint32_t b) {
      const auto [found, fresh] =
          middles.try_emplace(std::minmax(a, b), static_cast<uint32_t>(unit.size()));
      if (fresh) {
        unit.push_back(normalize(unit[a] + unit[b]));
      }
      return found->second;
    };
    std::vector<std::array<uint32_t, 3>> finer;
    finer.reserve(4 * mesh.triangles.size());
    for (const auto& [a, b, c] : mesh.triangles) {
      const uint32_t ab = middle(a, b);
      const uint32_t bc = middle(b, c);
      const uint32_t ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    mesh.triangles = std::move(finer);
  }
  for (const Vec3& p : unit) {
    mesh.positions.push_back(toFloat(p * shape.radius));
  }
  return mesh;
}

CloudMesh makeMesh(const BoxMesh& shape) {
  CloudMesh mesh;
  BoxVertices vertices(shape, mesh);
  for (uint32_t axis = 0; axis < 3; ++axis) {
    const uint32_t across = (axis + 1) % 3;
    const uint32_t along = (axis + 2) % 3;
    for (const bool high : {false, true}) {
      const auto at = [&](uint32_t i, uint32_t j) {
        std::array<uint32_t, 3> point{};
        point[axis] = high ? shape.cells[axis] : 0;
        // Axes in cyclic order turn counter-clockwise seen from the high side.
        point[high ? across : along] = i;
        point[high ? along : across] = j;
        return vertices.at(point);
      };
      const uint32_t columns = shape.cells[high ? across : along];
      const uint32_t rows = shape.cells[high ? along : across];
      for (uint32_t j = 0; j < rows; ++j) {
        for (uint32_t i = 0; i < columns; ++i) {
          mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
          mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
      }
    }
  }
  return mesh;
}

CloudMesh makeMesh(const StratocumulusMesh& shape) {
  constexpr double BOTTOM_DEPTH = 0.12;  // of the height
  const uint32_t n = shape.cells;
  CloudMesh mesh;
  std::vector<uint32_t> top(size_t{n + 1} * (n + 1));
  std::vector<uint32_t> bottom(top.size());
  const auto add = [&](double x, double y, double z) {
    mesh.positions.push_back(toFloat({x, y, z}));
    return static_cast<uint32_t>(mesh.positions.size() - 1);
  };
  for (uint32_t j = 0; j <= n; ++j) {
    for (uint32_t i = 0; i <= n; ++i) {
      const double u = static_cast<double>(i) / n;
      const double v = static_cast<double>(j) / n;
      const double x = (u - 0.5) * shape.extent.x;
      const double z = (v - 0.5) * shape.extent.z;
      const size_t at = i + size_t{n + 1} * j;
      if (i == 0 || j == 0 || i == n || j == n) {
        bottom[at] = top[at] = add(x, 0.0, z);
        continue;
      }
      const double bump = bumps(shape, x, z);
      const double height = shape.extent.y * rimHeight(u, v);
      top[at] = add(x, height * (1.0 - shape.relief + shape.relief * bump), z);
      bottom[at] = add(x, -BOTTOM_DEPTH * height * (1.0 - 0.5 * shape.relief * bump), z);
    }
  }
  for (uint32_t j = 0; j < n; ++j) {
    for (uint32_t i = 0; i < n; ++i) {
      std::array<size_t, 4> corner{};  // around the cell, counter-clockwise seen from above
      corner[0] = i + size_t{n + 1} * j;
      corner[1] = corner[0] + n + 1;
      corner[2] = corner[1] + 1;
      corner[3] = corner[0] + 1;
      // Cut through the sheet's corners: a triangle of three rim vertices would be of both sides.
      if ((2 * i < n) != (2 * j < n)) {
        std::rotate(corner.begin(), corner.begin() + 1, corner.end());
      }
      const auto [a, b, c, d] = corner;
      mesh.triangles.insert(mesh.triangles.end(), {{top[a], top[b], top[c]},
                                                   {top[a], top[c], top[d]},
                                                   {bottom[a], bottom[c], bottom[b]},
                                                   {bottom[a], bottom[d], bottom[c]}});
    }
  }
  return mesh;
}

CloudMesh makeMesh(const MeshShape& shape) {
  return std::visit([](const auto& kind) { return makeMesh(kind); }, shape);
}

Affine boundsOf(const CloudMesh& mesh) {
  std::array<double, 3> low{};
  std::array<double, 3> high{};
  for (size_t axis = 0; axis < 3; ++axis) {
    const auto [least, most] =
        std::minmax_element(mesh.positions.begin(), mesh.positions.end(),
                            [&](const auto& a, const auto& b) { return a[axis] < b[axis]; });
    low[axis] = double{(*least)[axis]};
    high[axis] = double{(*most)[axis]};
  }
  return affineFromEdges({low[0], low[1], low[2]}, {high[0] - low[0], 0.0, 0.0},
                         {0.0, high[1] - low[1], 0.0}, {0.0, 0.0, high[2] - low[2]});
}

}  // namespace host
