// SPDX-License-Identifier: MIT
// Water droplets of 0.1 to 50 um, which cloud, fog and haze share. No Vulkan.
#pragma once

#include "particles/catalogue.hpp"

namespace welkin {

// [J23] 1.1: the spread of the tables and of the closed form.
constexpr double DROPLET_SPREAD = 0.25;

// By the closed form, the shipped tables, or, for another spread, Mie theory then and there.
Particle makeDroplets(const ParticleParams& params);

}  // namespace welkin
