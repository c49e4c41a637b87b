// SPDX-License-Identifier: MIT
// Light that a slab has scattered once, in closed form: the start of slab_orders. No Vulkan.
#pragma once

#include <array>
#include <span>

#include "tables/slab_medium.hpp"

namespace welkin {

// Integral over the stretch u in [0, length] of u^p e^(-a u - b (length - u)), p = 0 .. 2.
std::array<double, 3> twoEndedMoments(double a, double b, double length);

// Moments of the light scattered once, all modes. suns: cosines > 0, SLAB_LANES of them.
SlabMoments firstOrder(const SlabMedium& medium, std::span<const double, SLAB_LANES> suns);

}  // namespace welkin
