// SPDX-License-Identifier: MIT
// Snow: crystals as long as wide whose facets are tilted so much that no halo is left.
#include "particles/phase_table.hpp"
#include "particles/types/spectrum.hpp"

namespace welkin {
namespace {

Particle makeSnow(const ParticleParams& params) {
  return tableParticle(SNOW_TABLE, true, params, [&](double, double) { return params.roughness; });
}

}  // namespace

const ParticleKind SNOW = {"snow", {}, {}, {0.3, 0.6, 0.45}, true, false, makeSnow};

}  // namespace welkin
