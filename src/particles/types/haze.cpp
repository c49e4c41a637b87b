// SPDX-License-Identifier: MIT
// Wet haze: droplets about the size of the wavelength.
#include "particles/types/droplet.hpp"

namespace welkin {

const ParticleKind HAZE = {"haze", {0.1, 5, 0.6}, {0.05, 0.5, DROPLET_SPREAD}, {}, true,
                           true,   makeDroplets};

}  // namespace welkin
