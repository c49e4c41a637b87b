// SPDX-License-Identifier: MIT
// Geometry of slabs through a volume, [R04] 4.2 and Kniss et al. Lengths in m.

// Axis across which slabs lie for half-angle slicing: between the light's travel direction and the
// view, or between it and the reversed view when they are obtuse. Never degenerate: the sum of two
// unit vectors at most 90 degrees apart has length >= sqrt(2).
vec3 halfAngleAxis(vec3 lightTravel, vec3 view) {
  real side = dot(lightTravel, view) < real(0.0f) ? real(-1.0f) : real(1.0f);
  return normalize(lightTravel + view * side);
}

// Opacity of a stretch of optical depth x: 1 - e^-x. [R04] Eq. 26 as corrected: beta * Delta would
// exceed 1.
real slabOpacity(real x) {
  return oneMinusExp(x);
}
