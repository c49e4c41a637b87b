// SPDX-License-Identifier: MIT
// Henyey-Greenstein with a given mean cosine: anything, nothing in particular.
#include "particles/catalogue.hpp"

namespace welkin {
namespace {

Particle makeHenyeyGreenstein(const ParticleParams& params) {
  Particle particle;
  particle.analytic = true;
  particle.phase = phaseParameters(PhaseKind::HenyeyGreenstein, 0, params.asymmetry);
  particle.curve = makePhaseCurve([&](size_t, double y) { return evalPhase(particle.phase, y); });
  return particle;
}

}  // namespace

const ParticleKind HENYEY_GREENSTEIN = {"henyey-greenstein", {}, {}, {}, false, true,
                                        makeHenyeyGreenstein};

}  // namespace welkin
