// SPDX-License-Identifier: MIT
#include "reference/raymarch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace welkin::reference {
namespace {

constexpr double INFINITE = std::numeric_limits<double>::infinity();

// Inverse of a row-major 3x4 by cofactors.
std::array<double, 12> inverted(const std::array<double, 12>& m) {
  const auto minorOf = [&m](size_t a, size_t b, size_t c, size_t d) {
    return m[a] * m[d] - m[b] * m[c];
  };
  std::array<double, 12> r{};
  r[0] = minorOf(5, 6, 9, 10);
  r[1] = -minorOf(1, 2, 9, 10);
  r[2] = minorOf(1, 2, 5, 6);
  r[4] = -minorOf(4, 6, 8, 10);
  r[5] = minorOf(0, 2, 8, 10);
  r[6] = -minorOf(0, 2, 4, 6);
  r[8] = minorOf(4, 5, 8, 9);
  r[9] = -minorOf(0, 1, 8, 9);
  r[10] = minorOf(0, 1, 4, 5);
  const double determinant = m[0] * r[0] + m[1] * r[4] + m[2] * r[8];
  for (double& x : r) {
    x /= determinant;
  }
  for (size_t i = 0; i < 3; ++i) {
    r[4 * i + 3] = -(r[4 * i] * m[3] + r[4 * i + 1] * m[7] + r[4 * i + 2] * m[11]);
  }
  return r;
}

}  // namespace

// A line in voxel coordinates, where voxel i has its centre at i; position origin + t direction.
struct RayMarch::Line {
  std::array<double, 3> origin;
  std::array<double, 3> direction;
  double begin;
  double end;  // not above begin if the line misses the box
};

namespace {

// Calls visit(from, to) for every piece of the line between planes through voxel centres.
template <typename L, typename Visit>
void eachPiece(const L& line, const std::array<int, 3>& size, Visit visit) {
  std::array<double, 3> next{INFINITE, INFINITE, INFINITE};
  std::array<int, 3> plane{};
  const auto reach = [&](size_t k) {
    const bool inside = plane[k] >= 0 && plane[k] < size[k];
    next[k] = inside ? (plane[k] - line.origin[k]) / line.direction[k] : INFINITE;
  };
  for (size_t k = 0; k < 3; ++k) {
    if (line.direction[k] == 0) {
      continue;
    }
    const double at = line.origin[k] + line.begin * line.direction[k];
    const bool up = line.direction[k] > 0;
    plane[k] = static_cast<int>(up ? std::floor(at) + 1 : std::ceil(at) - 1);
    plane[k] = up ? std::max(plane[k], 0) : std::min(plane[k], size[k] - 1);
    reach(k);
  }
  double from = line.begin;
  while (from < line.end) {
    size_t k = next[0] < next[1] ? 0 : 1;
    k = next[2] < next[k] ? 2 : k;
    const double to = std::min(next[k], line.end);
    if (to > from) {
      visit(from, to);
      from = to;
    }
    if (next[k] <= line.end) {
      plane[k] += line.direction[k] > 0 ? 1 : -1;
      reach(k);
    }
  }
}

}  // namespace

RayMarch::RayMarch(const VoxelField& field)
    : field_(field), boxFromWorld_(inverted(field.worldFromBox)) {}

RayMarch::Line RayMarch::lineOf(const Point& origin, const Point& direction, double length) const {
  Line line{};
  line.begin = 0;
  line.end = length;
  for (size_t k = 0; k < 3; ++k) {
    const double* row = &boxFromWorld_[4 * k];
    const double n = field_.size[k];
    const double o = row[0] * origin[0] + row[1] * origin[1] + row[2] * origin[2] + row[3];
    const double d = row[0] * direction[0] + row[1] * direction[1] + row[2] * direction[2];
    if (d == 0) {
      line.end = o < 0 || o > 1 ? 0 : line.end;
    } else {
      line.begin = std::max(line.begin, std::min(-o / d, (1 - o) / d));
      line.end = std::min(line.end, std::max(-o / d, (1 - o) / d));
    }
    line.origin[k] = o * n - 0.5;
    line.direction[k] = d * n;
  }
  return line;
}

double RayMarch::valueAt(const Line& line, double t) const {
  std::array<size_t, 3> low{};
  std::array<size_t, 3> high{};
  std::array<double, 3> f{};
  for (size_t k = 0; k < 3; ++k) {
    const double top = field_.size[k] - 1;
    const double x = std::clamp(line.origin[k] + t * line.direction[k], 0.0, top);
    const double i = std::floor(x);
    low[k] = static_cast<size_t>(i);
    high[k] = static_cast<size_t>(std::min(i + 1, top));
    f[k] = x - i;
  }
  const size_t nx = static_cast<size_t>(field_.size[0]);
  const size_t ny = static_cast<size_t>(field_.size[1]);
  const auto row = [&](size_t y, size_t z) {
    const double* p = &field_.extinction[(z * ny + y) * nx];
    return p[low[0]] + f[0] * (p[high[0]] - p[low[0]]);
  };
  const auto layer = [&](size_t z) {
    const double a = row(low[1], z);
    return a + f[1] * (row(high[1], z) - a);
  };
  const double a = layer(low[2]);
  return a + f[2] * (layer(high[2]) - a);
}

double RayMarch::opticalDepth(const Point& origin, const Point& direction, double length) const {
  const Line line = lineOf(origin, direction, length);
  double sum = 0;
  double left = line.end > line.begin ? valueAt(line, line.begin) : 0;
  eachPiece(line, field_.size, [&](double from, double to) {
    const double right = valueAt(line, to);
    const double middle = valueAt(line, (from + to) / 2);
    sum += (left + 4 * middle + right) * (to - from) / 6;
    left = right;
  });
  return sum;
}

void RayMarch::nodes(const Point& origin, const Point& direction, double length,
                     const Point& toLight, int refinement, std::vector<MarchNode>& out) const {
  out.clear();
  const Line line = lineOf(origin, direction, length);
  const double offset = std::sqrt(0.6);
  const std::array<double, 3> place{0.5 - offset / 2, 0.5, 0.5 + offset / 2};
  const std::array<double, 3> weight{5.0 / 18, 8.0 / 18, 5.0 / 18};
  double depth = 0;  // at the start of the stretch
  const auto simpson = [&](double a, double b) {
    return (valueAt(line, a) + 4 * valueAt(line, (a + b) / 2) + valueAt(line, b)) * (b - a) / 6;
  };
  eachPiece(line, field_.size, [&](double from, double to) {
    const double whole = simpson(from, to);
    const int count = static_cast<int>(std::ceil(4 * refinement * whole + 1e-12));
    for (int i = 0; i < count; ++i) {
      const double dt = (to - from) / count;
      const double start = from + i * dt;
      for (size_t g = 0; g < 3; ++g) {
        const double t = start + place[g] * dt;
        const double beta = valueAt(line, t);
        const double before = depth + simpson(start, t);
        Point p{};
        for (size_t k = 0; k < 3; ++k) {
          p[k] = origin[k] + t * direction[k];
        }
        out.push_back({t, beta * std::exp(-before) * weight[g] * dt, opticalDepth(p, toLight)});
      }
      depth += simpson(start, start + dt);
    }
  });
}

MarchResult RayMarch::march(const Point& origin, const Point& direction, double length,
                            const Point& toLight, int refinement) const {
  std::vector<MarchNode> list;
  nodes(origin, direction, length, toLight, refinement, list);
  MarchResult result{0, std::exp(-opticalDepth(origin, direction, length))};
  for (const MarchNode& node : list) {
    result.scattered += node.absorbed * std::exp(-node.lightDepth);
  }
  return result;
}

}  // namespace welkin::reference
