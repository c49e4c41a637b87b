// SPDX-License-Identifier: MIT
// Elementary functions that GLSL lacks. Dimensionless. Error bounds are those of correctly rounded
// exp and division; on a GPU add the error of its exp. tests/unit/numeric_test.cpp holds them.

// Below this argument an exponential counts as 0: e^-46 = 1e-20. Such tails would reach subnormal
// numbers, which cost up to 22 times as much on CPU drivers.
const real EXP_CUT = real(46.0f);

// e^x for x clamped to [-80, 80], and 0 below -46. Relative error that of exp.
real safeExp(real x) {
  return x < -EXP_CUT ? real(0.0f) : exp(clamp(x, real(-80.0f), real(80.0f)));
}

vec3 safeExp3(vec3 x) {
  return vec3(safeExp(x.x), safeExp(x.y), safeExp(x.z));
}

// ((x/2) coth(x/2) - 1) / x^2 as a function of z = x^2 in [0, 0.26], within 1.2e-15 (Chebyshev
// fit). Even in x, so that 1 - e^-x needs half the terms of its Taylor series.
const real COTH_0 = real(0.083333333333332127);
const real COTH_1 = real(-0.0013888888886568838);
const real COTH_2 = real(0.00003306877592523016);
const real COTH_3 = real(-8.266425285116268e-7);
const real COTH_4 = real(2.053692748537582e-8);
real cothSeries(real z) {
  return COTH_0 + z * (COTH_1 + z * (COTH_2 + z * (COTH_3 + z * COTH_4)));
}

// (1 - e^-x) / x for |x| <= 0.5: 1 / (x/2 + (x/2) coth(x/2)).
real phi1Small(real x) {
  real z = x * x;
  return real(1.0f) / (real(1.0f) + real(0.5f) * x + z * cothSeries(z));
}

// (1 - e^-x) / x with phi1(0) = 1, for x >= -80, infinity included. Relative error <= 3e-7 in
// float and 1e-15 in double for x >= -1; below, that of exp.
real phi1(real x) {
  return abs(x) < real(0.5f) ? phi1Small(x)
                             : (real(1.0f) - exp(clamp(-x, real(-80.0f), real(80.0f)))) / x;
}

// 1 - e^-x for x >= -80, infinity included, without cancellation. Same bounds as phi1.
real oneMinusExp(real x) {
  return abs(x) < real(0.5f) ? x * phi1Small(x)
                             : real(1.0f) - exp(clamp(-x, real(-80.0f), real(80.0f)));
}

// Mean of e^t for t from x to y, (e^x - e^y) / (x - y), from p = e^x, q = e^y and d = x - y. Where
// |d| < 1/2 the mean of p and q times tanh(d/2) / (d/2), by a polynomial within 3e-9. Beyond,
// errors of p and q count at most 4 times. Relative error <= 1e-6 in float for exact p and q.
real meanExp(real p, real q, real d) {
  real z = real(0.25f) * d * d;
  real series = real(1.0f) + z * (real(-0.33333240598976704) +
                                  z * (real(0.1332426296841829) +
                                       z * real(-0.05143305070494996)));
  return abs(d) < real(0.5f) ? real(0.5f) * (p + q) * series : (p - q) / d;
}

// Scaled complementary error function e^(x^2) erfc(x), x >= 0: t p(2t - 1) with t = 1/(1 + 0.36 x)
// and p of degree 9 by Lawson-weighted least squares on the relative error (method of Shepherd and
// Laframboise 1981): no exponential, error <= 4e-8, in float <= 4.1e-7 after rounding.
const real ERFCX_SCALE = real(0.36);
const real ERFCX_0 = real(0.3838412174204189);
const real ERFCX_1 = real(0.30675346510082624);
const real ERFCX_2 = real(0.19227730834420512);
const real ERFCX_3 = real(0.08989938550690993);
const real ERFCX_4 = real(0.02728093506658592);
const real ERFCX_5 = real(0.0023873725170896823);
const real ERFCX_6 = real(-0.0019527807514385376);
const real ERFCX_7 = real(-0.0006678930387976345);
const real ERFCX_8 = real(0.00010746613629208923);
const real ERFCX_9 = real(0.00007355890296101286);
real erfcxPositive(real x) {
  real t = real(1.0f) / (real(1.0f) + ERFCX_SCALE * x);
  real s = real(2.0f) * t - real(1.0f);
  real p = ERFCX_6 + s * (ERFCX_7 + s * (ERFCX_8 + s * ERFCX_9));
  p = ERFCX_2 + s * (ERFCX_3 + s * (ERFCX_4 + s * (ERFCX_5 + s * p)));
  return t * (ERFCX_0 + s * (ERFCX_1 + s * p));
}
