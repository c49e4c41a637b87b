// SPDX-License-Identifier: MIT
// Hexagonal ice columns and plates, much larger than the wavelength: no size enters.
#include "particles/phase_table.hpp"
#include "particles/types/spectrum.hpp"

namespace welkin {
namespace {

Particle makeColumns(const ParticleParams& params) {
  return tableParticle(ICE_COLUMN_TABLE, true, params,
                       [&](double, double) { return params.roughness; });
}

Particle makePlates(const ParticleParams& params) {
  return tableParticle(ICE_PLATE_TABLE, true, params,
                       [&](double, double) { return params.roughness; });
}

}  // namespace

const ParticleKind ICE_COLUMN = {"ice-column", {}, {}, {0, 0.2, 0}, true, false, makeColumns};
const ParticleKind ICE_PLATE = {"ice-plate", {}, {}, {0, 0.2, 0}, true, false, makePlates};

}  // namespace welkin
