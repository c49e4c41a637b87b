// SPDX-License-Identifier: MIT
// Horizontal layers that scatter and absorb: exponential in altitude over a plane or a sphere, and
// uniform between two planes; and one that absorbs only. Optical depths along a ray and distances
// to collisions, in m and 1/m.
#pragma once

#include "reference/globe.hpp"
#include "reference/phase_function.hpp"
#include "reference/random.hpp"

namespace welkin::reference {

// Extinction e^(-(altitude - base) / scaleHeight) times that at the base, above and below it.
struct ExponentialLayer {
  double base = 0;
  double scaleHeight = 8000;
  Rgb extinction{};
  Rgb albedo{1, 1, 1};
  PhaseFunction phase = PhaseFunction::isotropic();

  // Depth over the first `length` metres, which may be infinite; the planet is transparent. Closed
  // form over a plane, else 16 Gauss nodes on each side of the lowest point: relative error below
  // 1e-9 (Layers.DepthAgreesWithFineQuadrature).
  double opticalDepth(const Climb& ray, size_t channel, double length) const;

  // Distance to a collision, FAR if there is none within `length`. Exact: a curved ray lies above
  // its tangent, so that the layer over a plane is a majorant, which has a closed form.
  double collision(const Climb& ray, size_t channel, double length, Random& random) const;
};

// Between two altitudes over a plane.
struct UniformLayer {
  double bottom = 0;
  double top = 1;
  Rgb extinction{};
  Rgb albedo{1, 1, 1};
  PhaseFunction phase = PhaseFunction::isotropic();

  // The part of the first `length` metres that is inside.
  Climb::Interval within(const Climb& ray, double length) const;
  double opticalDepth(const Climb& ray, size_t channel, double length) const;
  double collision(const Climb& ray, size_t channel, double length, Random& random) const;
};

// A gas that scatters nothing, over a plane or a sphere. Density rises linearly from 0 at peak -
// halfWidth to 1 at the peak, falls linearly to 0 at peak + halfWidth, and is 0 below sea level.
struct AbsorbingLayer {
  double peak = 25000;
  double halfWidth = 15000;  // > 0
  Rgb extinction{};          // at the peak

  // As above; the planet is transparent. 16 Gauss nodes between knots: exact over a plane, over a
  // sphere 1e-12 of the depth that the same length would have at the peak, for tops up to a tenth
  // of the planet's radius (AbsorbingLayer.DepthAgreesWithItsClosedForm).
  double opticalDepth(const Climb& ray, size_t channel, double length) const;
};

}  // namespace welkin::reference
