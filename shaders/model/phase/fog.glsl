// SPDX-License-Identifier: MIT
// Phase function of fog and cloud droplets, in 1/sr, with integral 1 over the sphere: a blend of
// Henyey-Greenstein (forward peak) and Draine (bulk). Follows [J23] Jendersie and d'Eon 2023,
// "An Approximate Mie Scattering Function for Fog and Cloud Rendering".
//
// Rewritten, why: at 50 um g is 0.998, and 1 + g^2 - 2 g cos(theta) from a rounded dot product is
// 11 % wrong in float. Here the angle comes as y = 1 - cos(theta) = |a - b|^2 / 2 and the peak's
// width as gap = 1 - g, held as its own number, so no two nearly equal numbers are subtracted.
// Float against double of this text, directions included: <= 2e-6 relative for 5..50 um and every
// angle (FogPhase.FloatMatchesDoubleForEveryDiameterAndAngle).
const real PHASE_INV_4PI = real(0.0795774715459476679);

const real FOG_DIAMETER_MIN = real(5.0f);   // um; below, Eq. 4 is not a fit of anything
const real FOG_DIAMETER_MAX = real(50.0f);  // um

const real FOG_G_HG_A = real(0.0990567);  // [J23] Eq. 4
const real FOG_G_HG_B = real(1.67154);
const real FOG_G_D_A = real(2.20679);     // [J23] Eq. 5
const real FOG_G_D_B = real(3.91029);
const real FOG_G_D_C = real(0.428934);
const real FOG_ALPHA_A = real(3.62489);   // [J23] Eq. 6
const real FOG_ALPHA_B = real(8.29288);
const real FOG_ALPHA_C = real(5.52825);
const real FOG_W_D_A = real(0.599085);    // [J23] Eq. 7
const real FOG_W_D_B = real(0.641583);
const real FOG_W_D_C = real(0.665888);

// Parameters of the blend; gap = 1 - g. One struct serves every medium.
struct FogPhase {
  real gHg;
  real gapHg;
  real gD;
  real gapD;
  real alpha;
  real weightD;
};

// Parameters for a median droplet diameter in um, clamped to the range of the fit. [J23] Eq. 4-7.
FogPhase fogPhaseFromDiameter(real d) {
  real x = clamp(d, FOG_DIAMETER_MIN, FOG_DIAMETER_MAX);
  real depthHg = FOG_G_HG_A / (x - FOG_G_HG_B);
  real depthD = FOG_G_D_A / (x + FOG_G_D_B) + FOG_G_D_C;
  FogPhase p;
  p.gHg = exp(-depthHg);
  p.gapHg = oneMinusExp(depthHg);
  p.gD = exp(-depthD);
  p.gapD = oneMinusExp(depthD);
  p.alpha = exp(FOG_ALPHA_A - FOG_ALPHA_B / (x + FOG_ALPHA_C));
  p.weightD = exp(-FOG_W_D_A / (x - FOG_W_D_B) - FOG_W_D_C);
  return p;
}

// Henyey-Greenstein alone, mean cosine g in (-1, 1).
FogPhase henyeyGreensteinOnly(real g) {
  FogPhase p;
  p.gHg = g;
  p.gapHg = real(1.0f) - g;
  p.gD = real(0.0f);
  p.gapD = real(1.0f);
  p.alpha = real(0.0f);
  p.weightD = real(0.0f);
  return p;
}

// Rayleigh as Draine with g = 0, alpha = 1, [J23] after Eq. 2.
FogPhase rayleighAsDraine() {
  FogPhase p;
  p.gHg = real(0.0f);
  p.gapHg = real(1.0f);
  p.gD = real(0.0f);
  p.gapD = real(1.0f);
  p.alpha = real(1.0f);
  p.weightD = real(1.0f);
  return p;
}

// Henyey-Greenstein: (1 - g^2) / (4 pi (1 + g^2 - 2 g cos)^(3/2)), [J23] Eq. 2 with alpha = 0.
// 1 + g^2 - 2 g cos = h^2 + 2 |g| z with h = 1 - |g| and z = 1 - cos from the peak's own direction,
// forward or backward: a sum of positive terms, so finite and positive for any |g| < 1. y may pass
// 2 by the rounding of its vectors, hence the max. A backward peak is as accurate as 2 - y.
// x sqrt(x), not pow: pow is 9 ulp on lavapipe.
real henyeyGreenstein(real g, real gap, real y) {
  real h = g < real(0.0f) ? real(1.0f) + g : gap;
  real z = g < real(0.0f) ? max(real(2.0f) - y, real(0.0f)) : y;
  real q = h * h + real(2.0f) * abs(g) * z;
  return PHASE_INV_4PI * gap * (real(1.0f) + g) / (q * sqrt(q));
}

// Draine, [J23] Eq. 2.
real drainePhase(real g, real gap, real alpha, real y) {
  real mu = real(1.0f) - y;
  real norm = real(1.0f) + alpha * (real(1.0f) + real(2.0f) * g * g) * real(0.333333333333333333);
  return henyeyGreenstein(g, gap, y) * ((real(1.0f) + alpha * mu * mu) / norm);
}

// 1 - cos of the angle between unit vectors, accurate for any angle: the difference of two close
// vectors is exact, where 1 - dot(a, b) would leave eps / (1 - cos).
real oneMinusCosine(vec3 a, vec3 b) {
  vec3 c = a - b;
  return real(0.5f) * dot(c, c);
}

// Droplet phase function at y = 1 - cos(scattering angle), y in [0, 2]. [J23] Eq. 3.
real fogPhase(FogPhase p, real y) {
  real peak = henyeyGreenstein(p.gHg, p.gapHg, y);
  real bulk = drainePhase(p.gD, p.gapD, p.alpha, y);
  return (real(1.0f) - p.weightD) * peak + p.weightD * bulk;
}
