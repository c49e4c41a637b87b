// SPDX-License-Identifier: MIT
// A body bounded by a closed triangle mesh: where a ray is inside it. Triangles in a tree of boxes,
// crossings by signed volumes of the ray with the edges, which are the same number with the other
// sign for the two triangles at an edge, so that no ray slips through between them
// (one through a vertex may, which no drawn ray meets).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "reference/vector.hpp"

namespace welkin::reference {

struct MeshStretch {
  double begin, end;  // along the ray
  // Triangle that is crossed at the begin, NONE if the ray starts inside.
  static constexpr uint32_t NONE = UINT32_MAX;
  uint32_t front = NONE;
};

class MeshBody {
 public:
  // Counter-clockwise from outside. Throws std::invalid_argument if an index has no position or an
  // edge is not walked as often one way as the other.
  MeshBody(std::vector<Point> positions, std::vector<std::array<uint32_t, 3>> triangles);

  // Stretches of the ray beyond its origin, in order: points that the mesh winds around. `found` is
  // overwritten.
  void inside(const Point& origin, const Point& direction, std::vector<MeshStretch>& found) const;
  // Length inside.
  double length(const Point& origin, const Point& direction,
                std::vector<MeshStretch>& memory) const;

  const Point& low() const { return nodes_.front().low; }
  const Point& high() const { return nodes_.front().high; }
  double volume() const;                  // divergence theorem
  Point normal(uint32_t triangle) const;  // outwards, unit

 private:
  struct Node {
    Point low{}, high{};
    uint32_t first = 0;  // triangle, or left child with the right one behind it
    uint32_t count = 0;  // of triangles; 0: inner node
  };
  void build(uint32_t node, uint32_t first, uint32_t count);

  std::vector<Point> positions_;
  std::vector<std::array<uint32_t, 3>> triangles_;
  std::vector<Node> nodes_;
};

}  // namespace welkin::reference
