// SPDX-License-Identifier: MIT
#include "particles/catalogue.hpp"

namespace welkin {

const ParticleKind& particleKind(ParticleType type) {
  static constexpr std::array<const ParticleKind*, PARTICLE_TYPES> KINDS = {
      &CLOUD, &FOG, &HAZE, &RAIN, &ICE_COLUMN, &ICE_PLATE, &SNOW, &AIR, &HENYEY_GREENSTEIN, &USER};
  return *KINDS[static_cast<size_t>(type)];
}

}  // namespace welkin
