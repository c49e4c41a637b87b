// SPDX-License-Identifier: MIT
// Air molecules: Rayleigh scattering, [R04] Eq. 1.
#include "particles/catalogue.hpp"

namespace welkin {
namespace {

Particle makeAir(const ParticleParams&) {
  Particle particle;
  particle.analytic = true;
  particle.phase = phaseParameters(PhaseKind::Rayleigh, 0, 0);
  particle.curve = makePhaseCurve([&](size_t, double y) { return evalPhase(particle.phase, y); });
  return particle;
}

}  // namespace

const ParticleKind AIR = {"air", {}, {}, {}, false, true, makeAir};

}  // namespace welkin
