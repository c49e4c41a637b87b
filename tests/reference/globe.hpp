// SPDX-License-Identifier: MIT
// Altitudes along a straight ray over a sphere, or over a plane (radius infinite): one form for
// both, without differences of radii. m.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "reference/vector.hpp"

namespace welkin::reference {

constexpr double FAR = std::numeric_limits<double>::infinity();

// Where a ray is and how it climbs. With r the distance from the centre, r(t)^2 = r^2 + 2 r mu t +
// t^2; divided by r, only altitude, cosine and 1 / r are left.
struct Climb {
  double altitude;
  double mu;         // cosine with the local up
  double curvature;  // 1 / r; 0 over a plane

  // Altitude after t minus the altitude.
  double rise(double t) const { return t * (2 * mu + curvature * t) / (1 + stretch(t)); }
  Climb after(double t) const {
    const double s = stretch(t);
    return {altitude + rise(t), std::clamp((mu + curvature * t) / s, -1.0, 1.0), curvature / s};
  }

  // Distances at which the ray passes below `top`; begin >= end if never.
  struct Interval {
    double begin;
    double end;
  };
  Interval below(double top) const {
    const double g = (altitude - top) * (1 + 0.5 * curvature * (top - altitude));
    const double inside = mu * mu - 2 * curvature * g;
    if (g >= 0 && (mu >= 0 || inside <= 0)) {
      return {0, 0};
    }
    const double root = std::sqrt(std::max(inside, 0.0));
    if (mu > 0) {
      return {0, -2 * g / (mu + root)};
    }
    const double end = curvature > 0 ? (root - mu) / curvature : FAR;
    return {g > 0 ? 2 * g / (root - mu) : 0.0, end};
  }

  // Distance to altitude 0 from above, FAR if the ray passes. From below: 0 if it sinks.
  double ground() const {
    const double e = altitude - 0.5 * curvature * altitude * altitude;
    const double inside = mu * mu - 2 * curvature * e;
    if (mu >= 0 || inside < 0) {
      return FAR;
    }
    return std::max(2 * e / (std::sqrt(inside) - mu), 0.0);
  }

 private:
  // r(t) / r.
  double stretch(double t) const {
    const double kt = curvature * t;
    return std::sqrt(std::max(1 + kt * (2 * mu + kt), 0.0));
  }
};

struct Globe {
  Point seaLevelPoint{0, 0, 0};
  Point up{0, 1, 0};
  double radius = FAR;

  Climb climb(const Point& position, const Point& direction) const {
    const Point d = minus(position, seaLevelPoint);
    const double height = dot(d, up);
    if (radius == FAR) {
      return {height, dot(direction, up), 0};
    }
    const double square = dot(d, d);
    const double r = std::sqrt(radius * radius + (2 * radius * height + square));
    const double altitude = (2 * radius * height + square) / (radius + r);
    const double mu = (dot(d, direction) + radius * dot(up, direction)) / r;
    return {altitude, std::clamp(mu, -1.0, 1.0), 1 / r};
  }

  Point upAt(const Point& position) const {
    if (radius == FAR) {
      return up;
    }
    return normalized(along(minus(position, seaLevelPoint), up, radius));
  }
};

}  // namespace welkin::reference
