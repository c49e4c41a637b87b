// SPDX-License-Identifier: MIT
// Homogeneous bodies of extinction 1 per unit length in a parallel beam that travels along -z:
// where rays are inside, and the radiance that comes back along one, by Monte Carlo. Per unit
// irradiance on a surface facing the beam.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "reference/phase_function.hpp"
#include "reference/vector.hpp"

namespace welkin::reference {

struct Solid {
  bool box;  // else an ellipsoid
  Point middle;
  Point half;    // semi-axes, half edges
  double angle;  // about y, rad
};

struct Stretch {
  double begin, end;
  Point beginNormal, endNormal;  // outwards
};

struct Body {
  std::vector<Solid> solids;
  double half;  // of the square that holds its pictures
  // Stretches inside, merged, in order.
  std::vector<Stretch> inside(const Point& origin, const Point& direction) const;
};

// "sphere-R", "ellipsoid-R" (3:1, oblate), "box-R" (3:1), "pair-R" (two spheres that overlap); the
// tilted ones about y. R: largest optical radius. Throws std::invalid_argument.
Body makeBody(const std::string& name);

struct BodyRay {
  Point origin, direction;
};

// Ray of the pixel at u, v in [-1, 1] of a view from the direction that light scattered by `angle`
// (rad) travels in; parallel projection.
BodyRay bodyRay(const Body& body, double angle, double u, double v);

struct BodyEstimate {
  double radiance, variance;  // of one path
};

// Mean over `paths` paths through random points of the pixel [u, u + size] x [v, v + size].
BodyEstimate traceBody(const Body& body, const PhaseFunction& phase, double angle, double u,
                       double v, double size, uint64_t paths, uint64_t seed);

}  // namespace welkin::reference
