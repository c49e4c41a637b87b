// SPDX-License-Identifier: MIT
// Random scattering angles with the density of fog.glsl, as y = 1 - cos(angle), dimensionless, from
// one random number xi in [0, 1). xi counts energy from the forward end: xi = 0 is y = 0, y rises
// with xi, and small angles keep their relative precision.
// Inversion of Henyey-Greenstein and, in its cumulative distribution u as the coordinate, of Draine
// ([J23] Eq. 2), whose distribution is a rational function of u without any 1 / g.
//
// Rewritten, why: the published closed forms divide by g and subtract near-equal numbers; in float
// the quartic of Draine is off by up to 100 % below 1.5 um and not a number in up to 56 % of
// samples at alpha = 1000. Here: y in [0, 2] for every g in (-1, 1), alpha >= 0 and xi in [0, 1],
// and |CDF(y) - xi| <= 4e-6 in float for g in [-0.5, 0.9999], alpha <= 1000 (PhaseSample.*). Below
// -0.5, where y is near 2, its rounding moves energy: sampleFogPhaseAxis keeps the bound.

// 1 + g - 2 g u = gap + 2 g (1 - u), as a sum of positive terms.
real sampleDenominator(real g, real gap, real u) {
  return g < real(0.0f) ? (real(1.0f) + g) - real(2.0f) * g * u
                        : gap + real(2.0f) * g * (real(1.0f) - u);
}

// y up to which Henyey-Greenstein has scattered the part u in [0, 1].
real sampleHenyeyGreenstein(real g, real gap, real xi) {
  real rest = g < real(0.0f) ? (real(1.0f) + g) - g * xi : real(1.0f) + g * (real(1.0f) - xi);
  real ratio = gap / sampleDenominator(g, gap, xi);
  return min(real(2.0f) * ratio * ratio * xi * rest, real(2.0f));
}

// Draine, by bracketed Halley steps (cubic convergence; the density's slope is at hand). Worst over
// g in [-0.5, 0.9999]: alpha <= 32 needs 5 steps, 1000 needs 6, 10^4 needs 8; mean 4.
const int DRAINE_STEPS = 10;
const real DRAINE_DONE = real(2e-7);  // relative step after which nothing more is gained

real sampleDraine(real g, real gap, real alpha, real xi) {
  real target = xi * (real(1.0f) + alpha * (real(1.0f) + real(2.0f) * g * g) *
                                       real(0.333333333333333333));
  real low = real(0.0f);
  real high = real(1.0f);
  real u = xi;
  for (int i = 0; i < DRAINE_STEPS; ++i) {
    real width = sampleDenominator(g, gap, u);
    real e = u / width;
    real k = gap * gap * e;
    // Mean of mu^2 over [0, u].
    real square = real(1.0f) - real(2.0f) * k +
                  real(0.666666666666666667) * k * k * (real(2.0f) + g * e);
    real error = u * (real(1.0f) + alpha * square) - target;
    real mu = real(1.0f) - sampleHenyeyGreenstein(g, gap, u);
    real slope = real(1.0f) + alpha * mu * mu;
    real q = gap * (real(1.0f) + g) / width;  // dy/du = 2 q^2 / width
    real curvature = real(-4.0f) * alpha * mu * q * q / width;
    if (error > real(0.0f)) {
      high = u;
    } else {
      low = u;
    }
    real newton = slope * slope - real(0.5f) * error * curvature;
    real next = u - error * slope / max(newton, real(0.5f) * slope * slope);
    // Closed comparison: the step from an end that is the solution stays there.
    next = next >= low && next <= high ? next : real(0.5f) * (low + high);
    bool done = abs(next - u) <= DRAINE_DONE * u;
    u = next;
    if (done) {
      break;
    }
  }
  return sampleHenyeyGreenstein(g, gap, u);
}

// The blend of fogPhase; its density over the sphere is fogPhase(p, y). The lobe is drawn by xi,
// which is then stretched to [0, 1]: the peak first, so that its small angles keep their precision.
real sampleFogPhase(FogPhase p, real xi) {
  real weightHg = real(1.0f) - p.weightD;
  if (xi < weightHg) {
    return sampleHenyeyGreenstein(p.gHg, p.gapHg, min(xi / weightHg, real(1.0f)));
  }
  real bulk = p.weightD > real(0.0f) ? (xi - weightHg) / p.weightD : real(1.0f);
  return sampleDraine(p.gD, p.gapD, p.alpha, min(bulk, real(1.0f)));
}

// 1 - cos of the angle to the forward (side 1) or the backward direction (side -1).
struct AxisAngle {
  real y;
  real side;
};

// sampleFogPhase with backward peaks counted from behind: |CDF - xi| <= 4e-6 in float down to
// gHg = -0.9999. The direction is directionFromY(a.side * forward, a.y, azimuth).
AxisAngle sampleFogPhaseAxis(FogPhase p, real xi) {
  AxisAngle a;
  a.side = p.gHg < real(0.0f) && p.weightD <= real(0.0f) ? real(-1.0f) : real(1.0f);
  a.y = a.side < real(0.0f)
            ? sampleHenyeyGreenstein(-p.gHg, real(1.0f) + p.gHg, min(real(1.0f) - xi, real(1.0f)))
            : sampleFogPhase(p, xi);
  return a;
}

// Unit vector at y = 1 - cos from the unit vector forward; azimuth in rad from an arbitrary side.
// Basis of Duff et al. 2017, "Building an Orthonormal Basis, Revisited": stable everywhere.
vec3 directionFromY(vec3 forward, real y, real azimuth) {
  real s = forward.z < real(0.0f) ? real(-1.0f) : real(1.0f);
  real a = real(-1.0f) / (s + forward.z);
  real b = forward.x * forward.y * a;
  vec3 first = vec3(real(1.0f) + s * forward.x * forward.x * a, s * b, -s * forward.x);
  vec3 second = vec3(b, s + forward.y * forward.y * a, -forward.y);
  real sine = sqrt(max(y * (real(2.0f) - y), real(0.0f)));
  return (real(1.0f) - y) * forward + (sine * cos(azimuth)) * first +
         (sine * sin(azimuth)) * second;
}
