// SPDX-License-Identifier: MIT
// Phase function of air molecules, in 1/sr, with integral 1 over the sphere. [R04] Eq. 1.
const real RAYLEIGH_NORM = real(0.0596831036594607509);  // 3 / (16 pi)

// Phase at y = 1 - cos(scattering angle), y in [0, 2]. No cancellation: the sum is never below 1.
real rayleighPhase(real y) {
  real mu = real(1.0f) - y;
  return RAYLEIGH_NORM * (real(1.0f) + mu * mu);
}
