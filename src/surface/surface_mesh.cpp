// SPDX-License-Identifier: MIT
#include "surface/surface_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <utility>

#include "failure.hpp"

namespace welkin {
namespace {

using Point = std::array<double, 3>;
using Edge = std::pair<uint32_t, uint32_t>;

// Of volume / (area * diagonal). Places are rounded to 6e-8 of the box; what is flatter than 16
// such steps has a volume of rounding only.
constexpr double FLAT = 16 * 6e-8;

void checkInput(std::span<const float> positions, std::span<const uint32_t> indices) {
  if (positions.empty() || positions.size() % 3 != 0) {
    fail(WLK_ERROR_INVALID_ARGUMENT, 0, "positions", "%zu numbers are no list of x, y, z",
         positions.size());
  }
  if (indices.empty() || indices.size() % 3 != 0) {
    fail(WLK_ERROR_INVALID_ARGUMENT, 0, "indices", "%zu indices are no list of triangles",
         indices.size());
  }
  // Three vertices for each triangle are the most that a mesh can use.
  if (indices.size() / 3 > SURFACE_TRIANGLES_MAX) {
    fail(WLK_ERROR_INVALID_ARGUMENT, 0, "indices", "%zu triangles, at most %zu", indices.size() / 3,
         SURFACE_TRIANGLES_MAX);
  }
  if (positions.size() / 9 > SURFACE_TRIANGLES_MAX) {
    fail(WLK_ERROR_INVALID_ARGUMENT, 0, "positions", "%zu vertices, at most %zu",
         positions.size() / 3, SURFACE_TRIANGLES_MAX * 3);
  }
  for (size_t i = 0; i < positions.size(); ++i) {
    if (!(std::fabs(positions[i]) <= SURFACE_POSITION_MAX)) {  // NaN too
      fail(WLK_ERROR_INVALID_ARGUMENT, 0, "positions",
           "vertex %zu: %g is not finite or beyond %g m", i / 3, static_cast<double>(positions[i]),
           static_cast<double>(SURFACE_POSITION_MAX));
    }
  }
  const size_t vertices = positions.size() / 3;
  for (size_t i = 0; i < indices.size(); ++i) {
    if (indices[i] >= vertices) {
      fail(WLK_ERROR_INVALID_ARGUMENT, 0, "indices", "index %zu is %u, there are %zu vertices", i,
           indices[i], vertices);
    }
  }
}

// Fills `mesh.positions` with the different places that are used; returns each vertex's place,
// NO_PLACE of those that are not.
std::vector<uint32_t> weld(std::span<const float> positions, std::span<const uint32_t> indices,
                           SurfaceMesh& mesh) {
  const size_t vertices = positions.size() / 3;
  const auto place = [&](uint32_t vertex) {
    const float* at = positions.data() + size_t{3} * vertex;
    return std::array{at[0] + 0.0f, at[1] + 0.0f, at[2] + 0.0f};  // -0 becomes 0
  };
  std::vector<uint32_t> order(indices.begin(), indices.end());
  std::sort(order.begin(), order.end(),
            [&](uint32_t a, uint32_t b) { return place(a) < place(b); });
  std::vector<uint32_t> welded(vertices, NO_PLACE);
  for (const uint32_t vertex : order) {
    if (mesh.positions.empty() || mesh.positions.back() != place(vertex)) {
      mesh.positions.push_back(place(vertex));
    }
    welded[vertex] = static_cast<uint32_t>(mesh.positions.size() - 1);
  }
  return welded;
}

void checkClosed(const SurfaceMesh& mesh) {
  std::vector<Edge> forth;
  std::vector<Edge> back;
  for (const auto& triangle : mesh.triangles) {
    for (size_t i = 0; i < 3; ++i) {
      const uint32_t a = triangle[i];
      const uint32_t b = triangle[(i + 1) % 3];
      if (a != b) {
        (a < b ? forth : back).emplace_back(std::min(a, b), std::max(a, b));
      }
    }
  }
  std::sort(forth.begin(), forth.end());
  std::sort(back.begin(), back.end());
  std::vector<Edge> open;
  std::set_symmetric_difference(forth.begin(), forth.end(), back.begin(), back.end(),
                                std::back_inserter(open));
  if (!open.empty()) {
    const auto& at = mesh.positions[open.front().first];
    fail(WLK_ERROR_INVALID_ARGUMENT, 0, "indices",
         "not closed or not wound one way: %zu edges, one at (%g, %g, %g)", open.size(),
         static_cast<double>(at[0]), static_cast<double>(at[1]), static_cast<double>(at[2]));
  }
}

void findBox(SurfaceMesh& mesh) {
  mesh.low = mesh.high = mesh.positions.front();
  for (const auto& position : mesh.positions) {
    for (size_t i = 0; i < 3; ++i) {
      mesh.low[i] = std::min(mesh.low[i], position[i]);
      mesh.high[i] = std::max(mesh.high[i], position[i]);
    }
  }
}

Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// Drops triangles without area; sums area and, by the divergence theorem, volume.
void measure(SurfaceMesh& mesh) {
  const auto kept = std::remove_if(
      mesh.triangles.begin(), mesh.triangles.end(), [&](const std::array<uint32_t, 3>& triangle) {
        std::array<Point, 3> corner;
        for (size_t i = 0; i < 3; ++i) {
          for (size_t j = 0; j < 3; ++j) {  // from the box's corner: less cancels far from 0
            corner[i][j] = static_cast<double>(mesh.positions[triangle[i]][j]) -
                           static_cast<double>(mesh.low[j]);
          }
        }
        Point side{};
        Point other{};
        for (size_t j = 0; j < 3; ++j) {
          side[j] = corner[1][j] - corner[0][j];
          other[j] = corner[2][j] - corner[0][j];
        }
        const Point normal = cross(side, other);
        const double area = std::hypot(normal[0], normal[1], normal[2]) / 2;
        mesh.area_m2 += area;
        mesh.volume_m3 +=
            std::inner_product(normal.begin(), normal.end(), corner[0].begin(), 0.0) / 6;
        return !(area > 0);
      });
  mesh.triangles.erase(kept, mesh.triangles.end());
}

}  // namespace

SurfaceMesh makeSurfaceMesh(std::span<const float> positions, std::span<const uint32_t> indices) {
  checkInput(positions, indices);
  SurfaceMesh mesh;
  mesh.placeOf = weld(positions, indices, mesh);
  mesh.triangles.resize(indices.size() / 3);
  for (size_t i = 0; i < indices.size(); ++i) {
    mesh.triangles[i / 3][i % 3] = mesh.placeOf[indices[i]];
  }
  checkClosed(mesh);
  findBox(mesh);
  measure(mesh);
  const double diagonal =
      std::hypot(static_cast<double>(mesh.high[0]) - static_cast<double>(mesh.low[0]),
                 static_cast<double>(mesh.high[1]) - static_cast<double>(mesh.low[1]),
                 static_cast<double>(mesh.high[2]) - static_cast<double>(mesh.low[2]));
  if (!(std::fabs(mesh.volume_m3) > FLAT * mesh.area_m2 * diagonal)) {
    fail(WLK_ERROR_INVALID_ARGUMENT, 0, "positions", "the triangles enclose no volume");
  }
  if (mesh.volume_m3 < 0) {
    mesh.volume_m3 = -mesh.volume_m3;
    for (auto& triangle : mesh.triangles) {
      std::swap(triangle[1], triangle[2]);
    }
  }
  return mesh;
}

}  // namespace welkin
