// SPDX-License-Identifier: MIT
// Arithmetic of a tabulated phase function (src/particles/phase_curve.hpp), in 1/sr: CURVE_NODES
// values, linear in y = 1 - cos(angle) between nodes that are dense at both ends. A path tracer
// includes this file and feeds it from its own buffers, y, p and cdf of one channel:
//
//   // value, which is also the density of the samples
//   int i = clamp(int(phaseCoordinate(y) * (CURVE_NODES - 1)), 0, CURVE_NODES - 2);
//   if (y < Y[i] && i > 0) --i;                    // float may be one cell off
//   if (y > Y[i + 1] && i < CURVE_NODES - 2) ++i;
//   float p = curveCellValue(Y[i], Y[i + 1], P[i], P[i + 1], y);
//   // sample: the cell with C[i] <= xi < C[i + 1] by binary search, 11 steps
//   float q = (xi - C[i]) / (C[i + 1] - C[i]);
//   // forward half
//   float y = curveCellInvert(Y[i], Y[i + 1], P[i], P[i + 1], q);
//   vec3 next = directionFromY(forward, y, 2 pi * another random number);
//   // backward half, i >= CURVE_NODES / 2: the nodes lie in mirror image, y counts from behind
//   int k = CURVE_NODES - 1 - i;
//   float y = curveCellInvert(Y[k], Y[k - 1], P[i], P[i + 1], q);
//   vec3 next = directionFromY(-forward, y, 2 pi * another random number);
const int CURVE_NODES = 2048;

// y at table coordinate s in [0, 0.5]; by symmetry 2 - y at 1 - s.
// With a = sqrt(sin(t/2)), b = sqrt(cos(t/2)): c = a - b = 2 s - 1 and a^4 + b^4 = 1 give a + b,
// and 2 a = ((a + b)^2 - c^2) / ((a + b) - c), where 1 - c^2 = 4 s (1 - s) is not a difference.
real curveEnd(real s) {
  real c = real(2.0f) * s - real(1.0f);
  real c2 = c * c;
  real root = sqrt(real(8.0f) * (real(1.0f) + c2 * c2));
  real sum = sqrt(root - real(3.0f) * c2);
  real a = real(16.0f) * s * (real(1.0f) - s) * (real(1.0f) + c2) /
           ((root + real(4.0f) * c2) * (sum - c));
  return real(2.0f) * (a * a) * (a * a);
}

// y at table coordinate s in [0, 1]; inverse of phaseCoordinate. Node i stands at i / (nodes - 1).
// Relative error <= 2e-6 in float, of 2 - y in the backward half but for the rounding of y.
real curveNode(real s) {
  return s < real(0.5f) ? curveEnd(s) : real(2.0f) - curveEnd(real(1.0f) - s);
}

// Energy of a cell: integral over its part of the sphere.
real curveCellEnergy(real y0, real y1, real p0, real p1) {
  return real(3.14159265358979324) * (p0 + p1) * abs(y1 - y0);
}

// Value at y of the cell [y0, y1]; y outside counts as the nearer end, an empty cell as its end.
real curveCellValue(real y0, real y1, real p0, real p1, real y) {
  real width = y1 - y0;
  real t = width > real(0.0f) ? clamp((y - y0) / width, real(0.0f), real(1.0f)) : real(1.0f);
  return p0 * (real(1.0f) - t) + p1 * t;
}

// y that has the part q in [0, 1] of the cell's energy between y0 and itself. With the cell swapped
// (y1, y0, p1, p0) it counts from the other end. No cancellation: the quadratic in terms of q has
// the discriminant (1 - q) p0^2 + q p1^2.
real curveCellInvert(real y0, real y1, real p0, real p1, real q) {
  real root = sqrt((real(1.0f) - q) * p0 * p0 + q * p1 * p1);
  real t = q * (p0 + p1) / max(p0 + root, real(1e-30));
  return y0 + (y1 - y0) * min(t, real(1.0f));
}
