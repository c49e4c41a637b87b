// SPDX-License-Identifier: MIT
#include "reference/body.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "reference/random.hpp"

namespace welkin::reference {
namespace {

constexpr Point TO_LIGHT = {0, 0, 1};

Point turned(const Point& p, double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {c * p[0] + s * p[2], p[1], c * p[2] - s * p[0]};
}

Point normalAt(const Solid& solid, const Point& at) {
  const Point p = turned(minus(at, solid.middle), solid.angle);
  Point normal{};
  if (solid.box) {
    size_t face = 0;
    for (size_t k = 1; k < 3; ++k) {
      if (std::abs(p[k]) - solid.half[k] > std::abs(p[face]) - solid.half[face]) {
        face = k;
      }
    }
    normal[face] = p[face] > 0 ? 1 : -1;
  } else {
    for (size_t k = 0; k < 3; ++k) {
      normal[k] = p[k] / (solid.half[k] * solid.half[k]);
    }
    normal = normalized(normal);
  }
  return turned(normal, -solid.angle);
}

// Whether the line is inside anywhere, and where.
bool crosses(const Solid& solid, const Point& origin, const Point& direction, double& begin,
             double& end) {
  const Point o = turned(minus(origin, solid.middle), solid.angle);
  const Point d = turned(direction, solid.angle);
  if (solid.box) {
    begin = -1e30;
    end = 1e30;
    for (size_t k = 0; k < 3; ++k) {
      const double slope = std::abs(d[k]) < 1e-12 ? 1e-12 : d[k];
      const double a = (-solid.half[k] - o[k]) / slope;
      const double b = (solid.half[k] - o[k]) / slope;
      begin = std::max(begin, std::min(a, b));
      end = std::min(end, std::max(a, b));
    }
    return end > begin;
  }
  Point os{};
  Point ds{};
  for (size_t k = 0; k < 3; ++k) {
    os[k] = o[k] / solid.half[k];
    ds[k] = d[k] / solid.half[k];
  }
  const double a = dot(ds, ds);
  const double b = dot(os, ds);
  const double root = b * b - a * (dot(os, os) - 1);
  if (root <= 0) {
    return false;
  }
  begin = (-b - std::sqrt(root)) / a;
  end = (-b + std::sqrt(root)) / a;
  return true;
}

double depthInside(const Body& body, const Point& origin, const Point& direction) {
  double depth = 0;
  for (const Stretch& stretch : body.inside(origin, direction)) {
    depth += stretch.end - stretch.begin;
  }
  return depth;
}

// Point at an optical depth along a ray; false if it leaves before.
bool reaches(const Body& body, const Point& direction, double depth, Point& at) {
  for (const Stretch& stretch : body.inside(at, direction)) {
    const double length = stretch.end - stretch.begin;
    if (depth <= length) {
      at = along(at, direction, stretch.begin + depth);
      return true;
    }
    depth -= length;
  }
  return false;
}

double tracePath(const Body& body, const PhaseFunction& phase, const BodyRay& ray, Random& random) {
  constexpr double DARK = 30;  // light depth that gives nothing
  Point at = ray.origin;
  Point direction = ray.direction;
  // The first collision is forced: what passes is not sampled.
  const double opacity = -std::expm1(-depthInside(body, at, direction));
  if (opacity <= 0) {
    return 0;
  }
  double depth = -std::log1p(-random.uniform() * opacity);
  double sum = 0;
  while (reaches(body, direction, depth, at)) {
    const double shade = depthInside(body, at, TO_LIGHT);
    if (shade < DARK) {
      sum += opacity * phase.value(0, oneMinusCosine(direction, TO_LIGHT)) * std::exp(-shade);
    }
    direction = deflected(direction, phase.sample(0, random.uniform()),
                          2 * std::numbers::pi * random.uniform());
    depth = random.exponential();
  }
  return sum;
}

}  // namespace

std::vector<Stretch> Body::inside(const Point& origin, const Point& direction) const {
  std::vector<Stretch> found;
  for (const Solid& solid : solids) {
    double begin = 0;
    double end = 0;
    if (crosses(solid, origin, direction, begin, end) && end > 0) {
      begin = std::max(begin, 0.0);
      found.push_back({begin, end, normalAt(solid, along(origin, direction, begin)),
                       normalAt(solid, along(origin, direction, end))});
    }
  }
  std::sort(found.begin(), found.end(),
            [](const Stretch& a, const Stretch& b) { return a.begin < b.begin; });
  std::vector<Stretch> merged;
  for (const Stretch& next : found) {
    if (merged.empty() || next.begin > merged.back().end) {
      merged.push_back(next);
    } else if (next.end > merged.back().end) {
      merged.back().end = next.end;
      merged.back().endNormal = next.endNormal;
    }
  }
  return merged;
}

Body makeBody(const std::string& name) {
  const size_t dash = name.find('-');
  const std::string kind = name.substr(0, dash);
  const double r = dash == std::string::npos ? 0 : std::stod(name.substr(dash + 1));
  const Point zero{};
  if (r > 0 && kind == "sphere") {
    return {{{false, zero, {r, r, r}, 0}}, 1.02 * r};
  }
  if (r > 0 && kind == "ellipsoid") {
    return {{{false, zero, {r, r, r / 3}, 0.6}}, 1.02 * r};
  }
  if (r > 0 && kind == "box") {
    return {{{true, zero, {r, r, r / 3}, 0.4}}, 1.45 * r};
  }
  if (r > 0 && kind == "pair") {
    return {{{false, {-0.6 * r, 0, 0}, {r, r, r}, 0},
             {false, {0.7 * r, 0, 0.5 * r}, {0.6 * r, 0.6 * r, 0.6 * r}, 0}},
            1.65 * r};
  }
  throw std::invalid_argument("no body " + name);
}

BodyRay bodyRay(const Body& body, double angle, double u, double v) {
  const Point toEye = {std::sin(angle), 0, -std::cos(angle)};
  const Point right = {std::cos(angle), 0, std::sin(angle)};
  BodyRay ray{};
  for (size_t k = 0; k < 3; ++k) {
    ray.origin[k] = body.half * (u * right[k] + (k == 1 ? v : 0.0) + 4 * toEye[k]);
    ray.direction[k] = -toEye[k];
  }
  return ray;
}

BodyEstimate traceBody(const Body& body, const PhaseFunction& phase, double angle, double u,
                       double v, double size, uint64_t paths, uint64_t seed) {
  double sum = 0;
  double squares = 0;
  for (uint64_t i = 0; i < paths; ++i) {
    Random random(seed, 0, i, 0);
    const double x = u + size * random.uniform();
    const double y = v + size * random.uniform();
    const double value = tracePath(body, phase, bodyRay(body, angle, x, y), random);
    sum += value;
    squares += value * value;
  }
  const auto n = static_cast<double>(paths);
  return {sum / n, squares / n - sum / n * sum / n};
}

}  // namespace welkin::reference
