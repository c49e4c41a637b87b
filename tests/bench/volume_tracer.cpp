// SPDX-License-Identifier: MIT
#include "bench/volume_tracer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace bench {
namespace {

using welkin::reference::Point;
using welkin::reference::Random;

constexpr double PI = std::numbers::pi;
constexpr int EDGE = 8;  // voxels along a brick; only speed depends on it and on what follows
// Beyond this depth light survives with probability e^(SHADOW_DEPTH - depth).
constexpr double SHADOW_DEPTH = 5;
// Directions are drawn towards the sun too where the phase function is above this, 1/sr, and are
// kept at shares of 1 / (1 + LOBE_IMPORTANCE times the lobe's density).
constexpr double LOBE_FLOOR = 0.3;
constexpr double LOBE_IMPORTANCE = 3;

// Unit vector at 1 - cos = y from `axis`. The basis is that of T. Duff et al. 2017, Building an
// Orthonormal Basis, Revisited: no choice of a helper axis.
Point turned(const Point& axis, double y, Random& random) {
  double a = 0;
  double b = 0;
  double square = 0;
  do {  // a uniform point of the disk has a uniform azimuth
    a = 2 * random.uniform() - 1;
    b = 2 * random.uniform() - 1;
    square = a * a + b * b;
  } while (square > 1 || square < 1e-30);
  const double sine = std::sqrt(std::max(y * (2 - y), 0.0) / square);
  a *= sine;
  b *= sine;
  const double c = 1 - y;
  const double sign = std::copysign(1.0, axis[2]);
  const double k = -1 / (sign + axis[2]);
  const double m = axis[0] * axis[1] * k;
  Point d{axis[0] * c + a * (1 + sign * axis[0] * axis[0] * k) + b * m,
          axis[1] * c + a * sign * m + b * (sign + axis[1] * axis[1] * k),
          axis[2] * c - a * sign * axis[0] - b * axis[1]};
  // One step of Newton's method holds the length at 1 over thousands of turns.
  const double unit = 1.5 - 0.5 * welkin::reference::dot(d, d);
  return {d[0] * unit, d[1] * unit, d[2] * unit};
}

}  // namespace

double Sample::error() const {
  const double n = static_cast<double>(paths);
  const double m = mean();
  return std::sqrt(std::max(square / n - m * m, 0.0) / (n - 1));
}

VoxelBox::VoxelBox(const std::array<int, 3>& size, const Point& extent,
                   std::vector<float> extinction)
    : size_(size), extent_(extent), extinction_(std::move(extinction)) {
  const auto nx = static_cast<size_t>(size[0]);
  const auto ny = static_cast<size_t>(size[1]);
  const auto nz = static_cast<size_t>(size[2]);
  byColumn_.assign(nx * ny * nz, 0.0F);
  integral_.assign(nx * ny * nz, 0.0);
  for (size_t k = 0; k < 3; ++k) {
    scale_[k] = size[k] / extent[k];
    bricks_[k] = (size[k] + EDGE - 1) / EDGE;
  }
  const double step = 1 / scale_[2];
  for (size_t column = 0; column < nx * ny; ++column) {
    float* value = byColumn_.data() + column * nz;
    double* integral = integral_.data() + column * nz;
    for (size_t z = 0; z < nz; ++z) {
      value[z] = extinction_[column + nx * ny * z];
    }
    integral[nz - 1] = 0.5 * step * double{value[nz - 1]};
    for (size_t z = nz - 1; z > 0; --z) {
      integral[z - 1] = integral[z] + 0.5 * step * (double{value[z]} + double{value[z - 1]});
    }
  }
  findMajorants();
}

// Brick b covers the coordinates from b EDGE - 1/2 on: its voxels and one around them.
void VoxelBox::findMajorants() {
  const auto nx = static_cast<size_t>(size_[0]);
  const auto ny = static_cast<size_t>(size_[1]);
  for (int bz = 0; bz < bricks_[2]; ++bz) {
    for (int by = 0; by < bricks_[1]; ++by) {
      for (int bx = 0; bx < bricks_[0]; ++bx) {
        float most = 0;
        for (int z = bz * EDGE - 1; z <= (bz + 1) * EDGE; ++z) {
          for (int y = by * EDGE - 1; y <= (by + 1) * EDGE; ++y) {
            for (int x = bx * EDGE - 1; x <= (bx + 1) * EDGE; ++x) {
              const auto i = static_cast<size_t>(std::clamp(x, 0, size_[0] - 1));
              const auto j = static_cast<size_t>(std::clamp(y, 0, size_[1] - 1));
              const auto k = static_cast<size_t>(std::clamp(z, 0, size_[2] - 1));
              most = std::max(most, extinction_[i + nx * (j + ny * k)]);
            }
          }
        }
        majorant_.push_back(most * 1.000001F);  // above rounding
      }
    }
  }
}

VoxelBox::Cell VoxelBox::cellOf(const Point& p) const {
  std::array<size_t, 3> low{};
  std::array<size_t, 3> high{};
  Point f{};
  for (size_t k = 0; k < 3; ++k) {
    const int top = size_[k] - 1;
    const double x = std::clamp(p[k], 0.0, static_cast<double>(top));
    const int i = static_cast<int>(x);
    low[k] = static_cast<size_t>(i);
    high[k] = static_cast<size_t>(std::min(i + 1, top));
    f[k] = x - i;
  }
  const auto nx = static_cast<size_t>(size_[0]);
  const auto nz = static_cast<size_t>(size_[2]);
  Cell cell;
  cell.column = {nz * (low[0] + nx * low[1]), nz * (high[0] + nx * low[1]),
                 nz * (low[0] + nx * high[1]), nz * (high[0] + nx * high[1])};
  cell.weight = {(1 - f[0]) * (1 - f[1]), f[0] * (1 - f[1]), (1 - f[0]) * f[1], f[0] * f[1]};
  cell.low = low[2];
  cell.high = high[2];
  cell.f = f[2];
  return cell;
}

Point VoxelBox::voxelsFrom(const Point& position) const {
  Point p{};
  for (size_t k = 0; k < 3; ++k) {
    p[k] = position[k] * scale_[k] + 0.5 * (size_[k] - 1);
  }
  return p;
}

double VoxelBox::at(const Point& p) const {
  const Cell cell = cellOf(p);
  double a = 0;
  double b = 0;
  for (size_t k = 0; k < 4; ++k) {
    a += cell.weight[k] * double{byColumn_[cell.column[k] + cell.low]};
    b += cell.weight[k] * double{byColumn_[cell.column[k] + cell.high]};
  }
  return a + cell.f * (b - a);
}

double VoxelBox::depthAlongZ(const Point& p) const {
  const Cell cell = cellOf(p);
  double a = 0;
  double b = 0;
  double rest = 0;
  for (size_t k = 0; k < 4; ++k) {
    a += cell.weight[k] * double{byColumn_[cell.column[k] + cell.low]};
    b += cell.weight[k] * double{byColumn_[cell.column[k] + cell.high]};
    rest += cell.weight[k] * integral_[cell.column[k] + cell.high];
  }
  const double step = 1 / scale_[2];
  if (p[2] < 0) {  // constant before the first centre
    return rest + step * ((cell.high > 0 ? 0.5 * (a + b) : 0.0) - p[2] * a);
  }
  if (cell.low == cell.high) {  // behind the last one
    return rest - step * (p[2] - static_cast<double>(cell.high)) * b;
  }
  const double here = a + cell.f * (b - a);
  return rest + step * (1 - cell.f) * 0.5 * (here + b);
}

VolumeTracer::VolumeTracer(const VoxelBox& box, const welkin::reference::PhaseFunction& phase,
                           const Point& sun)
    : box_(box), phase_(phase), sun_(sun) {
  if (sun[2] < 1) {
    welkin::reference::ParticleField field;
    field.values = box.extinction_;
    field.extinctionScale.fill(1);
    const Point& e = box.extent_;
    slanted_.emplace(
        box.size_,
        std::array<double, 12>{e[0], 0, 0, -e[0] / 2, 0, e[1], 0, -e[1] / 2, 0, 0, e[2], -e[2] / 2},
        std::vector{field});
  }
  for (double y = 5e-9; y < 2; y *= 1.01) {
    lobeEdge_ = phase.value(0, y) > LOBE_FLOOR ? y : lobeEdge_;
  }
  double low = 0;
  double high = 1;
  for (int i = 0; i < 60 && lobeEdge_ > 0; ++i) {
    const double middle = 0.5 * (low + high);
    (phase.sample(0, middle) < lobeEdge_ ? low : high) = middle;
  }
  lobeEnergy_ = low;
  lobeEdge_ = lobeEdge_ > 0 ? phase.sample(0, low) : 0;
}

double VolumeTracer::lobeDensity(double y) const {
  return y < lobeEdge_ ? phase_.value(0, y) / lobeEnergy_ : 0.0;
}

// Exact up to `enough`, above it anything above.
double VolumeTracer::depthToSun(const Point& position, double enough) const {
  if (!slanted_) {
    return box_.depthAlongZ(position);
  }
  Point p{};
  for (size_t k = 0; k < 3; ++k) {
    p[k] = (position[k] - 0.5 * (box_.size_[k] - 1)) / box_.scale_[k];
  }
  return slanted_->opticalDepth(p, sun_, 0, welkin::reference::FAR, enough);
}

// Delta tracking from brick to brick; false if the path leaves the box.
bool VolumeTracer::collide(Path& path, Random& random) const {
  Point d{};
  Point next{};
  Point stride{};
  std::array<int, 3> brick{};
  std::array<int, 3> step{};
  double end = std::numeric_limits<double>::infinity();
  double t = 0;
  for (size_t k = 0; k < 3; ++k) {
    d[k] = path.direction[k] * box_.scale_[k];
    const double low = (-0.5 - path.position[k]) / d[k];
    const double high = (box_.size_[k] - 0.5 - path.position[k]) / d[k];
    if (d[k] == 0) {
      if (path.position[k] < -0.5 || path.position[k] > box_.size_[k] - 0.5) {
        return false;
      }
    } else {
      t = std::max(t, std::min(low, high));
      end = std::min(end, std::max(low, high));
    }
  }
  if (end <= t) {
    return false;
  }
  for (size_t k = 0; k < 3; ++k) {
    const double x = (path.position[k] + t * d[k] + 0.5) / EDGE;
    brick[k] = std::clamp(static_cast<int>(std::floor(x)), 0, box_.bricks_[k] - 1);
    step[k] = d[k] > 0 ? 1 : -1;
    if (d[k] == 0) {
      stride[k] = next[k] = std::numeric_limits<double>::infinity();
    } else {
      stride[k] = EDGE / std::fabs(d[k]);
      const int face = (brick[k] + (d[k] > 0 ? 1 : 0)) * EDGE;
      next[k] = (face - 0.5 - path.position[k]) / d[k];
    }
  }
  double free = random.exponential();  // optical, in the majorant
  while (t < end) {
    size_t k = next[0] < next[1] ? 0 : 1;
    k = next[2] < next[k] ? 2 : k;
    const double to = std::min(next[k], end);
    const auto index =
        static_cast<size_t>((brick[2] * box_.bricks_[1] + brick[1]) * box_.bricks_[0] + brick[0]);
    const double m = double{box_.majorant_[index]};
    while (free < m * (to - t)) {
      t += free / m;
      const Point p = welkin::reference::along(path.position, d, t);
      if (random.uniform() * m < box_.at(p)) {
        path.position = p;
        return true;
      }
      free = random.exponential();
    }
    free -= m * std::max(to - t, 0.0);
    t = to;
    next[k] += stride[k];
    brick[k] += step[k];
    if (brick[k] < 0 || brick[k] >= box_.bricks_[k]) {
      return false;
    }
  }
  return false;
}

bool VolumeTracer::keep(Path& path, double share, double lobe, Random& random) const {
  path.share *= share;
  const double wanted = 1 / (1 + LOBE_IMPORTANCE * lobe);
  if (path.share < wanted) {
    if (random.uniform() * wanted > path.share) {
      return false;
    }
    path.share = wanted;
  }
  return true;
}

// Each collision sees the sun; then the path goes on in a direction drawn from the phase function P
// and branches into one drawn from the lobe K around the sun, with shares P / (P + K) of each.
Sample VolumeTracer::trace(const std::function<TracerRay(Random&)>& ray, uint64_t count,
                           uint64_t seed, uint64_t pixel) const {
  Sample result;
  std::vector<Path> paths;
  for (uint64_t sample = 0; sample < count; ++sample) {
    Random random(seed, pixel, sample, 0);
    const TracerRay eye = ray(random);
    Path first;
    first.direction = eye.direction;
    first.position = box_.voxelsFrom(eye.origin);
    paths.assign(1, first);
    double sum = 0;
    while (!paths.empty()) {
      Path path = paths.back();
      paths.pop_back();
      while (collide(path, random)) {
        const double y = std::min(welkin::reference::oneMinusCosine(path.direction, sun_), 2.0);
        const double enough = SHADOW_DEPTH + random.exponential();
        const double depth = depthToSun(path.position, enough);
        if (depth < enough) {
          sum += path.share * phase_.value(0, y) * std::exp(-std::min(depth, SHADOW_DEPTH));
        }
        if (lobeEdge_ > 0) {
          Path branch = path;
          const double toSun = phase_.sample(0, random.uniform() * lobeEnergy_);
          branch.direction = turned(sun_, toSun, random);
          const double density = phase_.value(
              0,
              std::min(welkin::reference::oneMinusCosine(path.direction, branch.direction), 2.0));
          const double lobe = lobeDensity(toSun);
          if (keep(branch, density / (density + lobe), lobe, random)) {
            paths.push_back(branch);
          }
        }
        const double turn = phase_.sample(0, random.uniform());
        path.direction = turned(path.direction, turn, random);
        const double lobe = lobeDensity(welkin::reference::oneMinusCosine(path.direction, sun_));
        const double density = phase_.value(0, turn);
        if (!keep(path, density / (density + lobe), lobe, random)) {
          break;
        }
      }
    }
    result.value += sum;
    result.square += sum * sum;
  }
  result.paths = count;
  return result;
}

}  // namespace bench
