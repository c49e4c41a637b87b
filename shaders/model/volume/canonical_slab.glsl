// SPDX-License-Identifier: MIT
// Canonical transport of light in a slab ([B08] section 5): coordinates of its tables, and radiance
// per unit irradiance facing the sun from their numbers. Lengths and depths are optical, those of
// the medium without its forward peak (src/tables/canonical_phase.hpp). The tables hold
// ln(radiance / (mu_L (1 - e^-length) P)): the mean source along the ray, which is smooth to the
// slab's faces, over the light's cosine and the phase function of the set.
const real CANONICAL_THINNEST = real(0.0625f);  // outside, the limits are followed
const real CANONICAL_THICKEST = real(128.0f);
const real CANONICAL_COSINE = real(0.01);  // least of a direction
const real CANONICAL_FACE = real(0.1);     // depth below a face where nodes begin to spread

// [0, 1] for t between the thinnest and the thickest.
real canonicalThickness(real t) {
  return log(clamp(t, CANONICAL_THINNEST, CANONICAL_THICKEST) / CANONICAL_THINNEST) *
         (real(1.0f) / log(CANONICAL_THICKEST / CANONICAL_THINNEST));
}

// ln(1 + depth below a face).
real canonicalSpread(real d) {
  return log(real(1.0f) + d * (real(1.0f) / CANONICAL_FACE));
}

// [0, 1] from the lit face to the other, dense at both; d in [0, t].
real canonicalDepth(real d, real t) {
  real near = real(1.0f) + d * (real(1.0f) / CANONICAL_FACE);
  real far = real(1.0f) + (t - d) * (real(1.0f) / CANONICAL_FACE);
  return real(0.5f) + real(0.5f) * log(near / far) / canonicalSpread(t);
}

// [0, 1] for |cosine| between the least and 1. Never below 0, of which nodes are counted, where a
// device's root of the least is not the constant's.
real canonicalCosine(real mu) {
  real least = sqrt(CANONICAL_COSINE);
  real root = sqrt(clamp(mu, CANONICAL_COSINE, real(1.0f)));
  return max(root - least, real(0.0f)) * (real(1.0f) / (real(1.0f) - least));
}

// Weights of four nodes at -1, 0, 1, 2 for x in [0, 1]: the cubic through all four.
vec4 canonicalCubic(real x) {
  real a = x + real(1.0f);
  real b = x - real(1.0f);
  real c = x - real(2.0f);
  return vec4(-x * b * c / real(6.0f), a * b * c / real(2.0f), -a * x * c / real(2.0f),
              a * x * b / real(6.0f));
}

// A slab outside of the table by the one inside that stands for it: thickness and depth. Thinner
// ones scale; in thicker ones the same distance lies to the nearer face.
vec2 canonicalInside(real t, real d) {
  real inside = clamp(t, CANONICAL_THINNEST, CANONICAL_THICKEST);
  if (t < CANONICAL_THINNEST) {
    return vec2(inside, t > real(0.0f) ? d / t * inside : real(0.0f));
  }
  real middle = real(0.5f) * inside;
  return vec2(inside, min(d, middle) + max(min(inside - (t - d), inside) - middle, real(0.0f)));
}

// Length of the ray that ends at depth d, to the face where it begins; mu > 0 travels downwards.
real canonicalLength(real d, real t, real mu) {
  return (mu > real(0.0f) ? d : t - d) / max(abs(mu), real(1e-6));
}

// Radiance of the mean source along a ray.
real canonicalRadiance(real logSource, real phase, real muLight, real length) {
  return muLight * phase * safeExp(logSource) * oneMinusExp(length);
}
