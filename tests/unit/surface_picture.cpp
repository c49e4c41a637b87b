// SPDX-License-Identifier: MIT
#include "unit/surface_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <numbers>

#include "model/model.hpp"

namespace welkin::test {
namespace {

using namespace model::f64;

constexpr reference::Point TO_LIGHT = {0, 0, 1};
constexpr int PIXELS = 20;
constexpr int RAYS = 4;
constexpr size_t MAP_SIZE = 256;
constexpr int STRETCHES = 12;

vec3 vec(const reference::Point& p) {
  return {p[0], p[1], p[2]};
}

double lengthOf(const std::vector<reference::Stretch>& stretches) {
  double length = 0;
  for (const reference::Stretch& stretch : stretches) {
    length += stretch.end - stretch.begin;
  }
  return length;
}

}  // namespace

void LightTexel::add(const LightTexel& other, double weight) {
  coverage += weight * other.coverage;
  through += weight * other.through;
  top += weight * other.top;
  for (size_t k = 0; k < 3; ++k) {
    lit[k] += weight * other.lit[k];
    shaded[k] += weight * other.shaded[k];
  }
}

namespace {

std::vector<LightTexel> texelsOf(const reference::Body& body, size_t size) {
  std::vector<LightTexel> texels;
  const double edge = 2 * body.half / static_cast<double>(size);
  const double above = 10 * body.half;
  for (size_t i = 0; i < size * size; ++i) {
    LightTexel texel;
    const double x = (static_cast<double>(i % size) + 0.5) * edge - body.half;
    const double y = (static_cast<double>(i / size) + 0.5) * edge - body.half;
    const auto inside = body.inside({x, y, above}, {0, 0, -1});
    if (!inside.empty()) {
      texel = {1, lengthOf(inside), above - inside.front().begin, inside.front().beginNormal,
               inside.back().endNormal};
    }
    texels.push_back(texel);
  }
  return texels;
}

}  // namespace

LightMap::LightMap(const reference::Body& body, size_t size)
    : LightMap(texelsOf(body, size), body.half) {}

LightMap::LightMap(std::vector<LightTexel> texels, double half)
    : size_(static_cast<size_t>(std::lround(std::sqrt(static_cast<double>(texels.size()))))),
      half_(half),
      texel_(2 * half / static_cast<double>(size_)) {
  levels_.push_back(std::move(texels));
  for (size_t n = size_; n > 1; n /= 2) {
    const std::vector<LightTexel>& fine = levels_.back();
    std::vector<LightTexel> coarse(n * n / 4);
    for (size_t i = 0; i < n * n; ++i) {
      coarse[i / n / 2 * (n / 2) + i % n / 2].add(fine[i], 0.25);
    }
    levels_.push_back(coarse);
  }
}

LightTexel LightMap::linear(size_t level, double x, double y) const {
  const auto n = static_cast<int>(size_ >> level);
  const double u = (x / half_ + 1) / 2 * n - 0.5;
  const double v = (y / half_ + 1) / 2 * n - 0.5;
  LightTexel result;
  for (int k = 0; k < 4; ++k) {
    const int i = static_cast<int>(std::floor(u)) + k % 2;
    const int j = static_cast<int>(std::floor(v)) + k / 2;
    if (i >= 0 && j >= 0 && i < n && j < n) {
      result.add(levels_[level][static_cast<size_t>(j * n + i)],
                 (1 - std::abs(u - i)) * (1 - std::abs(v - j)));
    }
  }
  return result;
}

LightTexel LightMap::at(double x, double y, double level) const {
  const auto last = static_cast<double>(levels_.size() - 1);
  const double inside = std::clamp(level, 0.0, last);
  // The map has no level that wide: the last one spread over more.
  const double thin = std::pow(0.25, std::max(level - last, 0.0));
  const auto low = static_cast<size_t>(inside);
  LightTexel result;
  result.add(linear(low, x, y), thin * (1 - (inside - static_cast<double>(low))));
  if (low + 1 < levels_.size()) {
    result.add(linear(low + 1, x, y), thin * (inside - static_cast<double>(low)));
  }
  return result;
}

double surfaceRadiance(const reference::Body& body, const LightMap& map,
                       const SurfaceSource& source, const reference::BodyRay& ray,
                       const SurfaceCloud& cloud) {
  const auto inside = body.inside(ray.origin, ray.direction);
  const double chord = lengthOf(inside);
  if (chord <= 0) {
    return 0;
  }
  const vec3 toEye = -vec(ray.direction);
  ChordLight once = emptyChord();
  for (const reference::Stretch& stretch : inside) {
    const double length = stretch.end - stretch.begin;
    const auto shade = [&](double at) {
      return lengthOf(
          body.inside(reference::along(ray.origin, ray.direction, stretch.begin + at), TO_LIGHT));
    };
    for (int i = 0; i < STRETCHES; ++i) {
      const double begin = chordDepth(static_cast<double>(i) / STRETCHES, length);
      const double end = chordDepth((i + 1.0) / STRETCHES, length);
      once = chordStretch(once, shade(begin), shade(end), end - begin);
    }
  }
  // Light scattered more often, all from one point.
  const double scaled = cloud.scale * chord;
  double depth = chordDepth(SURFACE_SAMPLE, scaled) / cloud.scale;
  reference::Point at = ray.origin;
  for (const reference::Stretch& stretch : inside) {
    at = reference::along(ray.origin, ray.direction, std::min(stretch.begin + depth, stretch.end));
    if (depth <= stretch.end - stretch.begin) {
      break;
    }
    depth -= stretch.end - stretch.begin;
  }
  const LightTexel here = map.at(at[0], at[1], 0);
  if (here.coverage <= 0) {
    return once.inscatter * cloud.phase(1 + dot(toEye, vec(TO_LIGHT)));
  }
  const double through = footprintMean(here.through, here.coverage);
  const double shade = lengthOf(body.inside(at, TO_LIGHT));
  const double share = lightDepthShare(shade, through);
  const LightTexel some =
      map.at(at[0], at[1], footprintLevel(LOCAL_SPREAD / cloud.scale, map.texel()));
  const double across = cloud.scale * footprintMean(some.through, some.coverage);
  const TangentSlab local =
      tangentSlab(across, depthInSlab(across, share, cloud.scale * through),
                  directionOr(vec(some.lit), vec(TO_LIGHT)), vec(TO_LIGHT), toEye);
  double sum = 0;
  for (int set = 0; set < SURFACE_SETS; ++set) {
    const double spread = footprintSpread(set, local) / cloud.scale;
    const LightTexel wide = map.at(at[0], at[1], footprintLevel(spread, map.texel()));
    // Heights towards the light, not depths.
    const double rise = at[2] + shade - footprintMean(wide.top, wide.coverage);
    const LightFootprint around = {wide.coverage, cloud.scale * wide.through, vec(wide.lit),
                                   vec(wide.shaded), cloud.scale * rise};
    const SurfaceSlab found =
        surfaceSlab(set, around, share, cloud.scale * through, vec(TO_LIGHT), toEye);
    sum += found.inside * surfaceSourceAt(source, static_cast<size_t>(set),
                                          {found.slab.thickness, found.slab.depth,
                                           found.slab.muLight, found.slab.muView, found.slab.phi});
  }
  return once.inscatter * cloud.phase(1 + dot(toEye, vec(TO_LIGHT))) + oneMinusExp(scaled) * sum;
}

std::vector<SurfaceTruth> readSurfaceTruth(const std::string& file) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  std::vector<SurfaceTruth> rows;
  while (std::getline(stream, line)) {
    std::array<char, 32> name{};
    SurfaceTruth row{};
    if (std::sscanf(line.c_str(), "%31[^,],%d,%d,%d,%lf,%lf", name.data(), &row.angle, &row.x,
                    &row.y, &row.radiance, &row.error) == 6) {
      row.body = name.data();
      rows.push_back(row);
    }
  }
  return rows;
}

std::vector<SurfaceError> surfaceErrors(const std::vector<SurfaceTruth>& truth,
                                        const SurfaceCloud& cloud) {
  const SurfaceSource source = surfaceSource(decodeCanonical(shippedCanonical()));
  std::vector<SurfaceError> errors;
  for (size_t i = 0; i < truth.size();) {
    const std::string name = truth[i].body;
    const reference::Body body = reference::makeBody(name);
    const LightMap map(body, MAP_SIZE);
    while (i < truth.size() && truth[i].body == name) {
      SurfaceError error = {truth[i].body, truth[i].angle, 0, 0};
      double sum = 0;
      double squares = 0;
      double difference = 0;
      for (; i < truth.size() && truth[i].body == name && truth[i].angle == error.angle; ++i) {
        double value = 0;
        for (int k = 0; k < RAYS * RAYS; ++k) {
          const double u = 2 * (truth[i].x + (k % RAYS + 0.5) / RAYS) / PIXELS - 1;
          const double v = 2 * (truth[i].y + (k / RAYS + 0.5) / RAYS) / PIXELS - 1;
          const auto ray = reference::bodyRay(body, error.angle * std::numbers::pi / 180, u, v);
          value += surfaceRadiance(body, map, source, ray, cloud) / (RAYS * RAYS);
        }
        error.total += value;
        sum += truth[i].radiance;
        squares += truth[i].radiance * truth[i].radiance;
        difference += (value - truth[i].radiance) * (value - truth[i].radiance) -
                      truth[i].error * truth[i].error;
      }
      error.total /= sum;
      error.rms = std::sqrt(std::max(difference, 0.0) / squares);
      errors.push_back(error);
    }
  }
  return errors;
}

}  // namespace welkin::test
