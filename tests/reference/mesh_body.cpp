// SPDX-License-Identifier: MIT
#include "reference/mesh_body.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

namespace welkin::reference {
namespace {

constexpr uint32_t LEAF = 4;  // triangles; only speed depends on it
constexpr size_t DEEPEST = 64;

// A crossing, and +1 where the ray goes out.
struct Crossing {
  double at;
  int out;
  uint32_t triangle;
};

bool meets(const Point& low, const Point& high, const Point& origin, const Point& direction,
           const Point& inverse) {
  double begin = 0;
  double end = std::numeric_limits<double>::infinity();
  for (size_t k = 0; k < 3; ++k) {
    if (direction[k] == 0) {
      if (origin[k] < low[k] || origin[k] > high[k]) {
        return false;
      }
      continue;
    }
    const double a = (low[k] - origin[k]) * inverse[k];
    const double b = (high[k] - origin[k]) * inverse[k];
    begin = std::max(begin, std::min(a, b));
    end = std::min(end, std::max(a, b));
  }
  return begin <= end * (1 + 1e-12);  // above rounding
}

// Volume between the ray's line and the edge, rounded alike either way round; never 0, so that a
// line through the edge crosses one of its triangles.
double edgeVolume(const Point& direction, const Point& a, const Point& b) {
  const bool turned = b < a;
  const double volume = dot(direction, cross(turned ? b : a, turned ? a : b));
  const double apart = volume == 0 ? std::numeric_limits<double>::min() : volume;
  return turned ? -apart : apart;
}

void expectClosed(const std::vector<Point>& positions,
                  const std::vector<std::array<uint32_t, 3>>& triangles) {
  std::map<std::pair<uint32_t, uint32_t>, int> balance;
  for (const auto& triangle : triangles) {
    for (size_t k = 0; k < 3; ++k) {
      const uint32_t a = triangle[k];
      const uint32_t b = triangle[(k + 1) % 3];
      if (a >= positions.size()) {
        throw std::invalid_argument("mesh: an index has no position");
      }
      balance[std::minmax(a, b)] += a < b ? 1 : -1;
    }
  }
  for (const auto& [edge, sum] : balance) {
    if (sum != 0) {
      throw std::invalid_argument("mesh: an edge is open");
    }
  }
}

}  // namespace

MeshBody::MeshBody(std::vector<Point> positions, std::vector<std::array<uint32_t, 3>> triangles)
    : positions_(std::move(positions)), triangles_(std::move(triangles)) {
  if (triangles_.empty()) {
    throw std::invalid_argument("mesh: no triangles");
  }
  expectClosed(positions_, triangles_);
  nodes_.reserve(2 * triangles_.size());
  nodes_.emplace_back();
  build(0, 0, static_cast<uint32_t>(triangles_.size()));
}

void MeshBody::build(uint32_t node, uint32_t first, uint32_t count) {
  constexpr double FAR_AWAY = std::numeric_limits<double>::infinity();
  Point low = {FAR_AWAY, FAR_AWAY, FAR_AWAY};
  Point high = {-FAR_AWAY, -FAR_AWAY, -FAR_AWAY};
  for (uint32_t i = first; i < first + count; ++i) {
    for (const uint32_t corner : triangles_[i]) {
      for (size_t k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], positions_[corner][k]);
        high[k] = std::max(high[k], positions_[corner][k]);
      }
    }
  }
  nodes_[node].low = low;
  nodes_[node].high = high;
  nodes_[node].first = first;
  nodes_[node].count = count;
  if (count <= LEAF) {
    return;
  }
  size_t axis = 0;
  for (size_t k = 1; k < 3; ++k) {
    axis = high[k] - low[k] > high[axis] - low[axis] ? k : axis;
  }
  const auto middle = [&](const std::array<uint32_t, 3>& t) {
    return positions_[t[0]][axis] + positions_[t[1]][axis] + positions_[t[2]][axis];
  };
  const auto begin = triangles_.begin() + first;
  std::nth_element(begin, begin + count / 2, begin + count,
                   [&](const auto& a, const auto& b) { return middle(a) < middle(b); });
  const auto left = static_cast<uint32_t>(nodes_.size());
  nodes_.resize(nodes_.size() + 2);
  nodes_[node].first = left;
  nodes_[node].count = 0;
  build(left, first, count / 2);
  build(left + 1, first + count / 2, count - count / 2);
}

void MeshBody::inside(const Point& origin, const Point& direction,
                      std::vector<MeshStretch>& found) const {
  thread_local std::vector<Crossing> crossings;
  crossings.clear();
  const Point inverse = {1 / direction[0], 1 / direction[1], 1 / direction[2]};
  std::array<uint32_t, DEEPEST> stack{};
  size_t size = 1;
  while (size > 0) {
    const Node& node = nodes_[stack[--size]];
    if (!meets(node.low, node.high, origin, direction, inverse)) {
      continue;
    }
    if (node.count == 0) {
      stack[size++] = node.first;
      stack[size++] = node.first + 1;
      continue;
    }
    for (uint32_t i = node.first; i < node.first + node.count; ++i) {
      const auto& triangle = triangles_[i];
      const Point a = minus(positions_[triangle[0]], origin);
      const Point b = minus(positions_[triangle[1]], origin);
      const Point c = minus(positions_[triangle[2]], origin);
      const double u = edgeVolume(direction, b, c);
      const double v = edgeVolume(direction, c, a);
      const double w = edgeVolume(direction, a, b);
      const bool out = u > 0 && v > 0 && w > 0;
      if (out || (u < 0 && v < 0 && w < 0)) {
        const Point normal = cross(minus(b, a), minus(c, a));
        const double at = dot(normal, a) / dot(normal, direction);
        if (at > 0) {
          crossings.push_back({at, out ? 1 : -1, i});
        }
      }
    }
  }
  std::sort(crossings.begin(), crossings.end(),
            [](const Crossing& a, const Crossing& b) { return a.at > b.at; });
  // From the far end, where the mesh winds around nothing.
  found.clear();
  int windings = 0;
  double end = 0;
  for (const Crossing& crossing : crossings) {
    const bool was = windings > 0;
    windings += crossing.out;
    if (!was && windings > 0) {
      end = crossing.at;
    } else if (was && windings <= 0) {
      found.push_back({crossing.at, end, crossing.triangle});
    }
  }
  if (windings > 0) {
    found.push_back({0, end, MeshStretch::NONE});
  }
  std::reverse(found.begin(), found.end());
}

double MeshBody::length(const Point& origin, const Point& direction,
                        std::vector<MeshStretch>& memory) const {
  inside(origin, direction, memory);
  double sum = 0;
  for (const MeshStretch& stretch : memory) {
    sum += stretch.end - stretch.begin;
  }
  return sum;
}

double MeshBody::volume() const {
  double sum = 0;
  for (const auto& [a, b, c] : triangles_) {
    sum += dot(positions_[a], cross(positions_[b], positions_[c])) / 6;
  }
  return sum;
}

Point MeshBody::normal(uint32_t triangle) const {
  const auto& [a, b, c] = triangles_[triangle];
  return normalized(
      cross(minus(positions_[b], positions_[a]), minus(positions_[c], positions_[a])));
}

}  // namespace welkin::reference
