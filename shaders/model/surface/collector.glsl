// SPDX-License-Identifier: MIT
// Collectors of a surface cloud ([B08] 6.1 and 7): the search for where a pixel's light came in,
// and how footprints are read from mipmaps of light maps. Rewritten: the plain iteration runs in
// circles of two steps where the map turns back (1 - x never leaves its start), so each step goes
// half the way; and a step is judged by what remains, in widths.

const real COLLECTOR_DAMPING = real(0.5f);

// Length of a step in widths: [B08] limits it to 1.
real collectorResidual(vec2 centre, vec2 found, real width) {
  vec2 step = found - centre;
  return sqrt(dot(step, step)) / max(width, real(1e-6));
}

// The next centre from the one at hand and the collector that the transport gives there.
vec2 collectorStep(vec2 centre, vec2 found, real width) {
  real residual = collectorResidual(centre, found, width);
  return centre + (found - centre) * (COLLECTOR_DAMPING / max(COLLECTOR_DAMPING * residual,
                                                              real(1.0f)));
}

// Level whose texels, filtered linearly, spread as a Gaussian on one axis: a texel of width w has
// the variance w^2 / 12 and the filter adds w^2 / 6, so w = 2 sigma. `texel`: width at level 0, in
// the unit of sigma.
const real GAUSSIAN_TEXEL = real(2.0f);
const real LEVELS_PER_E_FOLD = real(1.4426950408889634);
real footprintLevel(real sigma, real texel) {
  return LEVELS_PER_E_FOLD *
         log(max(sigma * (GAUSSIAN_TEXEL / max(texel, real(1e-20))), real(1.0f)));
}

// Quotients by what several have in common are products with its inverse, which compilers then make
// once.
//
// Mean over the cloud of what a mipmap weighted with its coverage holds: `sum` over all of the
// footprint, [B08] 7 as Z / A; 0 where there is no cloud.
const real COVERAGE_LEAST = real(1e-6);
real footprintMean(real sum, real coverage) {
  return coverage > COVERAGE_LEAST ? sum * (real(1.0f) / coverage) : real(0.0f);
}
