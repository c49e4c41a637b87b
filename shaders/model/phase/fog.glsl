// SPDX-License-Identifier: MIT
// Phase function of fog and cloud droplets, in 1/sr, with integral 1 over the sphere: a blend of
// Henyey-Greenstein (forward peak) and Draine (bulk). Follows [J23] Jendersie and d'Eon 2023,
// "An Approximate Mie Scattering Function for Fog and Cloud Rendering".
//
// Rewritten, why: at 50 um g is 0.998, and 1 + g^2 - 2 g cos(theta) from a rounded dot product is
// 11 % wrong in float. Here the angle comes as y = 1 - cos(theta) = |a - b|^2 / 2 and the peak's
// width as gap = 1 - g, held as its own number, so no two nearly equal numbers are subtracted.
// Float against double of this text, directions included: <= 2e-6 relative for 5..50 um and every
// angle (FogPhase.FloatMatchesDoubleForEveryDiameterAndAngle); below 5 um, where gap is 1 minus the
// rounded g, <= 5e-6 (SmallDroplets.AreNormalisedAndAccurateInFloat).
const real PHASE_INV_4PI = real(0.0795774715459476679);

// Four fits, joined by bands in which the parameters pass from one to the next, so that P is
// continuous in the diameter: the fits as published jump, by 4 % at 0.1 um and by 64 % forward at
// 1.5 um. Outside the bands the published fits alone. In the bands P stays within 5 % of the range
// of both fits, and as close to Mie theory as they are (SmallDroplets.*).
const real FOG_DIAMETER_MIN = real(0.0f);   // um; Rayleigh within 2e-4
const real FOG_DIAMETER_MAX = real(50.0f);  // um
const real FOG_TINY_END = real(0.1);       // um; bands: 0.1..0.13, 1.2..1.5, 4..5
const real FOG_SMALL_BEGIN = real(0.13);
const real FOG_SMALL_END = real(1.2);
const real FOG_MIDDLE_BEGIN = real(1.5f);
const real FOG_MIDDLE_END = real(4.0f);
const real FOG_LARGE_BEGIN = real(5.0f);  // below, Eq. 4 is not a fit of anything

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

// From the two g. gapHg loses 1 / (1 - g) of an ulp: these fits have g < 0.97, so 33 at most.
FogPhase fogPhaseOf(real gHg, real gD, real alpha, real weightD) {
  FogPhase p;
  p.gHg = gHg;
  p.gapHg = real(1.0f) - gHg;
  p.gD = gD;
  p.gapD = real(1.0f) - gD;
  p.alpha = alpha;
  p.weightD = weightD;
  return p;
}

// The fits, d in um and l = ln d; below 5 um those of [J23], supplemental, Eq. 7-22.
FogPhase fogFitTiny(real d) {
  // d^4.3, which is 1e-13 at the guard against ln 0.
  real power = exp(real(4.3) * log(max(d, real(0.001))));
  real gD = real(1.1456) * d * sin(real(9.29044) * d);
  return fogPhaseOf(real(13.8) * d * d, gD, real(250.0f), real(0.252977) - real(312.983) * power);
}

FogPhase fogFitSmall(real l) {
  real gHg = real(0.862) - real(0.143) * l * l;
  real inner = (l - real(0.238604)) * (l + real(1.00667)) / (real(0.507522) - real(0.15677) * l);
  real angle = real(1.19692) * cos(inner) + real(1.37932) * l + real(0.0625835);
  real gD = real(0.379685) * cos(angle) + real(0.344213);
  real wave = real(0.146209) * cos(real(3.38707) * l + real(2.11193));
  return fogPhaseOf(gHg, gD, real(250.0f), wave + real(0.316072) + real(0.0778917) * l);
}

// For l > 0. Rewritten: tan l is sin l / cos l, multiplied out: no pole at l = pi / 2 (4.81 um).
FogPhase fogFitMiddle(real l) {
  real logL = log(l);
  real c = cos(l);
  real pole = sin(l) + (real(1.27551) - real(2.0f) * l) * c;
  real gD = real(0.500411) - real(0.081287) * c / pole;
  real wave = l - cos(real(5.68947) * (logL - real(0.0292149)));
  return fogPhaseOf(real(0.0604931) * logL + real(0.940256), gD,
                    real(7.30354) * l + real(6.31675), real(0.026914) * wave + real(0.376475));
}

// [J23] Eq. 4-7.
FogPhase fogFitLarge(real d) {
  real depthHg = FOG_G_HG_A / (d - FOG_G_HG_B);
  real depthD = FOG_G_D_A / (d + FOG_G_D_B) + FOG_G_D_C;
  FogPhase p;
  p.gHg = exp(-depthHg);
  p.gapHg = oneMinusExp(depthHg);
  p.gD = exp(-depthD);
  p.gapD = oneMinusExp(depthD);
  p.alpha = exp(FOG_ALPHA_A - FOG_ALPHA_B / (d + FOG_ALPHA_C));
  p.weightD = exp(-FOG_W_D_A / (d - FOG_W_D_B) - FOG_W_D_C);
  return p;
}

// Smooth step from a to b over [begin, end] in ln d. alpha passes by 1 / alpha, near the bulk's
// share at 90 degrees, from 250 to 10: P stays within 4 % of the range of the two, by alpha itself
// it left it by 32 %.
FogPhase fogBlend(FogPhase a, FogPhase b, real l, real begin, real end) {
  real logBegin = log(begin);
  real s = clamp((l - logBegin) / (log(end) - logBegin), real(0.0f), real(1.0f));
  real t = s * s * (real(3.0f) - real(2.0f) * s);
  FogPhase p;
  p.gHg = mix(a.gHg, b.gHg, t);
  p.gapHg = mix(a.gapHg, b.gapHg, t);
  p.gD = mix(a.gD, b.gD, t);
  p.gapD = mix(a.gapD, b.gapD, t);
  p.alpha = real(1.0f) / mix(real(1.0f) / a.alpha, real(1.0f) / b.alpha, t);
  p.weightD = mix(a.weightD, b.weightD, t);
  return p;
}

// Parameters for a median droplet diameter in um, clamped to the range of the fits.
FogPhase fogPhaseFromDiameter(real d) {
  real x = clamp(d, FOG_DIAMETER_MIN, FOG_DIAMETER_MAX);
  if (x >= FOG_LARGE_BEGIN) {
    return fogFitLarge(x);
  }
  if (x <= FOG_TINY_END) {
    return fogFitTiny(x);
  }
  real l = log(x);
  if (x < FOG_SMALL_BEGIN) {
    return fogBlend(fogFitTiny(x), fogFitSmall(l), l, FOG_TINY_END, FOG_SMALL_BEGIN);
  }
  if (x <= FOG_SMALL_END) {
    return fogFitSmall(l);
  }
  if (x < FOG_MIDDLE_BEGIN) {
    return fogBlend(fogFitSmall(l), fogFitMiddle(l), l, FOG_SMALL_END, FOG_MIDDLE_BEGIN);
  }
  if (x <= FOG_MIDDLE_END) {
    return fogFitMiddle(l);
  }
  return fogBlend(fogFitMiddle(l), fogFitLarge(x), l, FOG_MIDDLE_END, FOG_LARGE_BEGIN);
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
