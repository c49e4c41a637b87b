// SPDX-License-Identifier: MIT
// Compositing of premultiplied radiance and transmittance. Dimensionless transmittance, radiance in
// the unit of the light.

// Value for a target: finite, never negative, at most `limit`. Comparison form: min and max on NaN
// are undefined in SPIR-V.
real finiteValue(real x, real limit) {
  return x > real(0.0f) ? (x < limit ? x : limit) : real(0.0f);
}

// Radiance of a layer (premultiplied) with transmittance t over what lies behind it.
vec3 compositeOver(vec3 layer, real t, vec3 behind) {
  return layer + behind * t;
}
