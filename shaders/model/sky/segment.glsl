// SPDX-License-Identifier: MIT
// Single scattering along one stretch of a ray through an exponential layer, per unit irradiance,
// phase function and albedo (dimensionless). Follows [R04] 4.1, Eq. 11-15; rewritten: Eq. 15 lacks
// the factor exp(-beta_eye / (gamma p)), and its closed form is singular at p = 0 and p = l. Here
// the stretch is described by optical depths at its two ends: light depth a at the near end, and
// b = light depth at the far end + depth of the stretch. The integral is the depth times the
// logarithmic mean of e^-a and e^-b: symmetric, never negative, without a singular case, exact in a
// flat exponential layer, and of second order where the layer is not (tests/unit/sky_test.cpp).

struct Segment {
  real opticalDepth;
  real inscatter;
};

// Cap on optical depths, so that infinite ones never meet as inf - inf.
const real DEPTH_CAP = real(1e30);

// tau exp(-min(a, b)) phi1(|b - a|); light below e^-46 counts as none. Flat layers: relative error
// <= 1e-12 in double and 5e-5 in float down to that cut.
real segmentInscatter(real nearSunDepth, real farSunDepth, real opticalDepth) {
  real tau = min(opticalDepth, DEPTH_CAP);
  real a = min(nearSunDepth, DEPTH_CAP);
  real b = min(farSunDepth + tau, DEPTH_CAP);
  return tau * safeExp(-min(a, b)) * phi1(abs(b - a));
}

// Highest exponent of the density's growth along a downward ray, which ends there: what lies deeper
// is opaque in any case, e^40 = 2e17.
const real GROWTH_CAP = real(40.0f);

// Optical depth of `distance` (<= DEPTH_CAP) m with extinction (1/m) at the near end, heightRatio =
// rise / scale height: [R04] Eq. 11 as beta K phi1(gamma p K), free of 0/0 for horizontal rays.
real exponentialDepth(real extinction, real heightRatio, real distance) {
  real reach = heightRatio < -GROWTH_CAP ? distance * (-GROWTH_CAP / heightRatio) : distance;
  return min(extinction * reach * phi1(max(heightRatio, -GROWTH_CAP)), DEPTH_CAP);
}

// [R04] Eq. 11-15 as corrected, flat Earth: extinctionAtEye and inverseScaleHeight (> 0) in 1/m,
// viewSlope p and lightSlope l the vertical components of the directions to the far end and to the
// light, distance in m, may be infinite. l <= 0 gives no light: a flat Earth has no twilight.
Segment flatExponentialSegment(real extinctionAtEye, real inverseScaleHeight, real viewSlope,
                               real lightSlope, real distance) {
  real length = min(distance, DEPTH_CAP);
  real rise = inverseScaleHeight * viewSlope * length;
  real nearDepth = extinctionAtEye / (inverseScaleHeight * max(lightSlope, DIRECTION_FLOOR));
  Segment result;
  result.opticalDepth = exponentialDepth(extinctionAtEye, rise, length);
  real lit = segmentInscatter(nearDepth, nearDepth * safeExp(min(-rise, GROWTH_CAP)), result.opticalDepth);
  result.inscatter = lightSlope > real(0.0f) ? lit : real(0.0f);
  return result;
}
