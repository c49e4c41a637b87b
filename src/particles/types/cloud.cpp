// SPDX-License-Identifier: MIT
// Cloud droplets; radius 10 um by default ([R04] Table 2: 2 pi r^2 = 6.28e-10 m^2).
#include "particles/types/droplet.hpp"

namespace welkin {

const ParticleKind CLOUD = {"cloud", {5, 50, 20}, {0.05, 0.5, DROPLET_SPREAD}, {}, true,
                            true,    makeDroplets};

}  // namespace welkin
