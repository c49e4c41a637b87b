// SPDX-License-Identifier: MIT
#include "reference/voxels.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace welkin::reference {
namespace {

constexpr int EDGE = 4;  // voxels along a brick; only speed depends on it

// Inverse of a row-major 3x4 through the cross products of its columns.
std::array<double, 12> inverse(const std::array<double, 12>& m) {
  const Point x{m[0], m[4], m[8]};
  const Point y{m[1], m[5], m[9]};
  const Point z{m[2], m[6], m[10]};
  const Point origin{m[3], m[7], m[11]};
  const double volume = dot(x, cross(y, z));
  if (!std::isfinite(1 / volume)) {
    throw std::invalid_argument("voxels: the box is flat");
  }
  std::array<double, 12> result{};
  const std::array<Point, 3> rows{cross(y, z), cross(z, x), cross(x, y)};
  for (size_t i = 0; i < 3; ++i) {
    for (size_t k = 0; k < 3; ++k) {
      result[4 * i + k] = rows[i][k] / volume;
    }
    result[4 * i + 3] = -dot(rows[i], origin) / volume;
  }
  return result;
}

// Steps through the planes at integers of coordinates that grow linearly with t.
struct Walk {
  std::array<int, 3> cell{};
  std::array<int, 3> step{};
  std::array<double, 3> next{};
  std::array<double, 3> stride{};

  Walk(const Point& origin, const Point& direction, double t) {
    for (size_t k = 0; k < 3; ++k) {
      const double d = direction[k];
      cell[k] = static_cast<int>(std::floor(origin[k] + t * d));
      step[k] = d > 0 ? 1 : -1;
      stride[k] = d == 0 ? FAR : 1 / std::fabs(d);
      next[k] = d == 0 ? FAR : (cell[k] + (d > 0 ? 1 : 0) - origin[k]) / d;
    }
  }
  size_t nearest() const {
    const size_t k = next[0] < next[1] ? 0 : 1;
    return next[2] < next[k] ? 2 : k;
  }
  void advance(size_t k) {
    cell[k] += step[k];
    next[k] += stride[k];
  }
};

}  // namespace

// In voxel coordinates, where voxel i has its centre at i.
struct VoxelVolume::Line {
  Point origin;
  Point direction;
  double begin;
  double end;  // not above begin if the line misses the box
};

VoxelVolume::VoxelVolume(const std::array<int, 3>& size, const std::array<double, 12>& worldFromBox,
                         std::vector<ParticleField> fields)
    : size_(size), bricks_{}, boxFromWorld_(inverse(worldFromBox)), fields_(std::move(fields)) {
  size_t voxels = 1;
  size_t bricks = 1;
  for (size_t k = 0; k < 3; ++k) {
    if (size[k] < 1) {
      throw std::invalid_argument("voxels: an edge has none");
    }
    bricks_[k] = (size[k] + EDGE - 1) / EDGE;
    voxels *= static_cast<size_t>(size[k]);
    bricks *= static_cast<size_t>(bricks_[k]);
  }
  if (fields_.empty()) {
    throw std::invalid_argument("voxels: no field");
  }
  for (const ParticleField& field : fields_) {
    if (field.values.size() != voxels) {
      throw std::invalid_argument("voxels: a field has another size");
    }
  }
  // Brick b covers the coordinates from b EDGE - 1/2 on: its voxels and one around them.
  majorant_.resize(bricks);
  size_t index = 0;
  for (int z = 0; z < size[2]; ++z) {
    for (int y = 0; y < size[1]; ++y) {
      for (int x = 0; x < size[0]; ++x, ++index) {
        std::array<float, 3> sum{};
        for (size_t c = 0; c < 3; ++c) {
          double exact = 0;
          for (const ParticleField& field : fields_) {
            exact += static_cast<double>(field.values[index]) * field.extinctionScale[c];
          }
          // 1e-6: above the rounding to float and that of the interpolation.
          sum[c] = static_cast<float>(exact * (1 + 1e-6));
        }
        const auto first = [](int i) { return std::max(i - 1, 0) / EDGE; };
        const auto last = [&](int i, size_t k) { return std::min((i + 1) / EDGE, bricks_[k] - 1); };
        for (int bz = first(z); bz <= last(z, 2); ++bz) {
          for (int by = first(y); by <= last(y, 1); ++by) {
            for (int bx = first(x); bx <= last(x, 0); ++bx) {
              std::array<float, 3>& m =
                  majorant_[static_cast<size_t>((bz * bricks_[1] + by) * bricks_[0] + bx)];
              for (size_t c = 0; c < 3; ++c) {
                m[c] = std::max(m[c], sum[c]);
              }
            }
          }
        }
      }
    }
  }
}

VoxelVolume::Line VoxelVolume::lineOf(const Point& origin, const Point& direction,
                                      double length) const {
  Line line{};
  line.begin = 0;
  line.end = length;
  for (size_t k = 0; k < 3; ++k) {
    const double* row = &boxFromWorld_[4 * k];
    const double n = size_[k];
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

// Calls visit(from, to, majorants) for each brick on the line until it returns false.
template <typename Visit>
void VoxelVolume::eachBrick(const Line& line, Visit visit) const {
  if (line.end <= line.begin) {
    return;
  }
  Point origin{};
  Point direction{};
  for (size_t k = 0; k < 3; ++k) {
    origin[k] = (line.origin[k] + 0.5) / EDGE;
    direction[k] = line.direction[k] / EDGE;
  }
  Walk walk(origin, direction, line.begin);
  double from = line.begin;
  while (from < line.end) {
    const size_t k = walk.nearest();
    const double to = std::min(walk.next[k], line.end);
    if (to > from) {
      // Rounding at the box's faces may step over them by nothing.
      const int x = std::clamp(walk.cell[0], 0, bricks_[0] - 1);
      const int y = std::clamp(walk.cell[1], 0, bricks_[1] - 1);
      const int z = std::clamp(walk.cell[2], 0, bricks_[2] - 1);
      const auto index = static_cast<size_t>((z * bricks_[1] + y) * bricks_[0] + x);
      if (!visit(from, to, majorant_[index])) {
        return;
      }
      from = to;
    }
    walk.advance(k);
  }
}

double VoxelVolume::valueAt(const ParticleField& field, const Point& position) const {
  std::array<size_t, 3> low{};
  std::array<size_t, 3> high{};
  Point f{};
  for (size_t k = 0; k < 3; ++k) {
    const int top = size_[k] - 1;
    const double x = std::clamp(position[k], 0.0, static_cast<double>(top));
    const int i = static_cast<int>(x);
    low[k] = static_cast<size_t>(i);
    high[k] = static_cast<size_t>(std::min(i + 1, top));
    f[k] = x - i;
  }
  const auto nx = static_cast<size_t>(size_[0]);
  const auto ny = static_cast<size_t>(size_[1]);
  const auto row = [&](size_t y, size_t z) {
    const float* v = field.values.data() + (z * ny + y) * nx;
    const double a = static_cast<double>(v[low[0]]);
    return a + f[0] * (static_cast<double>(v[high[0]]) - a);
  };
  const double a = row(low[1], low[2]) * (1 - f[1]) + row(high[1], low[2]) * f[1];
  const double b = row(low[1], high[2]) * (1 - f[1]) + row(high[1], high[2]) * f[1];
  return a * (1 - f[2]) + b * f[2];
}

double VoxelVolume::extinctionAt(const Line& line, size_t channel, double t) const {
  const Point position = along(line.origin, line.direction, t);
  double sum = 0;
  for (const ParticleField& field : fields_) {
    sum += field.extinctionScale[channel] * valueAt(field, position);
  }
  return sum;
}

double VoxelVolume::depthInBrick(const Line& line, size_t channel, double from, double to) const {
  const double offset = 0.5 / std::sqrt(3.0);
  Walk walk(line.origin, line.direction, from);
  double sum = 0;
  while (from < to) {
    const size_t k = walk.nearest();
    const double end = std::min(walk.next[k], to);
    if (end > from) {
      const double middle = 0.5 * (from + end);
      const double shift = offset * (end - from);
      sum += 0.5 * (end - from) *
             (extinctionAt(line, channel, middle - shift) +
              extinctionAt(line, channel, middle + shift));
      from = end;
    }
    walk.advance(k);
  }
  return sum;
}

double VoxelVolume::opticalDepth(const Point& origin, const Point& direction, size_t channel,
                                 double length, double enough) const {
  const Line line = lineOf(origin, direction, length);
  double depth = 0;
  eachBrick(line, [&](double from, double to, const std::array<float, 3>& majorant) {
    if (majorant[channel] > 0) {
      depth += depthInBrick(line, channel, from, to);
    }
    return depth <= enough;
  });
  return depth;
}

double VoxelVolume::ratioTracking(const Point& origin, const Point& direction, size_t channel,
                                  double length, Random& random) const {
  const Line line = lineOf(origin, direction, length);
  double transmittance = 1;
  eachBrick(line, [&](double t, double to, const std::array<float, 3>& majorant) {
    const double m = static_cast<double>(majorant[channel]);
    while (m > 0) {
      t += random.exponential() / m;
      if (!(t < to)) {
        break;
      }
      transmittance *= 1 - extinctionAt(line, channel, t) / m;
    }
    return true;
  });
  return transmittance;
}

VoxelCollision VoxelVolume::collision(const Point& origin, const Point& direction, size_t channel,
                                      double length, Random& random) const {
  const Line line = lineOf(origin, direction, length);
  VoxelCollision result{FAR, 0};
  double free = random.exponential();  // optical, in the majorant
  eachBrick(line, [&](double t, double to, const std::array<float, 3>& majorant) {
    const double m = static_cast<double>(majorant[channel]);
    while (free < m * (to - t)) {
      t += free / m;
      free = random.exponential();
      double rest = random.uniform() * m;
      const Point position = along(line.origin, line.direction, t);
      for (size_t f = 0; f < fields_.size(); ++f) {
        rest -= fields_[f].extinctionScale[channel] * valueAt(fields_[f], position);
        if (rest < 0) {
          result = {t, f};
          return false;
        }
      }
    }
    free -= m * (to - t);
    return true;
  });
  return result;
}

}  // namespace welkin::reference
