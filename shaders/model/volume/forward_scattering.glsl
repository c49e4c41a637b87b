// SPDX-License-Identifier: MIT
// Forward multiple scattering in a volume: where the tables of src/tables/multiscatter.hpp are
// looked up, and the rate at which the light buffer loses light. Follows [R04] 4.2, Eq. 20-25.
//
// Rewritten, why: [R04] Eq. 20-22 convolve the phase function n times with n = albedo * optical
// depth rounded up; scattering counts are Poisson distributed with mean n instead, which is smooth
// in n and exact per Legendre order. Light that has come to depth n has the moments
// exp(-n (1 - chi_l)); scattered once more towards the eye, chi_l exp(-n (1 - chi_l)). The table
// holds ln of that per colour; n = 0 is single scattering.

// Depth axis: ln(1 + n / N0), from 0 at n = 0 to 1 at NMAX. Of N0 = 1/4, 1/2 and 1, 1 has the
// least error between 32 nodes over 5..50 um. At NMAX those media are isotropic within 0.3 %; pure
// Henyey-Greenstein above g = 0.95 is not (F = 0.53 at 0.95), and stays as it is there beyond.
const real SCATTERING_DEPTH_N0 = real(1.0f);
const real SCATTERING_DEPTH_NMAX = real(64.0f);
const real SCATTERING_DEPTH_SCALE = real(0.239556115747018568);  // 1 / ln(1 + NMAX / N0)

// Table coordinate in [0, 1] of y = 1 - cos(scattering angle t): s = (sqrt(sin(t/2)) + 1 -
// sqrt(cos(t/2))) / 2, dense at both ends, where the phase functions peak. Clamped; float error
// <= 2e-7 in s for a given y.
real phaseCoordinate(real y) {
  real h = clamp(real(0.5f) * y, real(0.0f), real(1.0f));
  real sine = sqrt(h);
  real cosine = sqrt(real(1.0f) - h);
  return real(0.5f) * (sqrt(sine) + real(1.0f) - sqrt(cosine));
}

// Table coordinate in [0, 1] of a scattering depth n; clamped outside [0, SCATTERING_DEPTH_NMAX].
real depthCoordinate(real n) {
  real x = max(n, real(0.0f)) / SCATTERING_DEPTH_N0;
  return clamp(log(real(1.0f) + x) * SCATTERING_DEPTH_SCALE, real(0.0f), real(1.0f));
}

// Rate at which light directed away from its source is lost per optical depth: dI/dtau =
// -(1 - albedo F(n)) I. [R04] Eq. 25 as corrected: as printed its loss per slab is of second order
// in the slab's depth, so the light of a thick cloud grows without bound as slabs get thinner.
real forwardLoss(real albedo, real forwardFraction) {
  return real(1.0f) - albedo * forwardFraction;
}
