// SPDX-License-Identifier: MIT
// Fog droplets. [J23] covers 5 to 50 um, its supplement less.
#include "particles/types/droplet.hpp"

namespace welkin {

const ParticleKind FOG = {"fog", {0.1, 50, 10}, {0.05, 0.5, DROPLET_SPREAD}, {}, true,
                          true,  makeDroplets};

}  // namespace welkin
