// SPDX-License-Identifier: MIT
// Phase function of hexagonal ice crystals in random orientation, in 1/sr, as seen in the light of
// the sun: geometric optics (ice_tracer) averaged over the sun's disk. No Vulkan.
//
// Diffraction is not in it. It is half of the extinction and, for crystals over 100 um, narrower
// than the sun: the caller treats it as light that goes straight on, together with the light that
// passes parallel faces. Of the extinction, 0.5 + 0.5 deltaTransmission goes straight on and the
// rest is scattered by `phase`. Any roughness > 0 moves the light of parallel faces into `phase`,
// where it is a forward peak of the roughness times 0.44 rad (rms per axis at normal incidence).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "particles/ice_tracer.hpp"

namespace welkin {

struct IceSettings {
  size_t rays = 4'000'000;
  bool solarDisk = true;           // average over the disk of SUN_RADIUS
  double smoothing = 0.001745329;  // rad, rms of the Gaussian on top of it; [5e-4, 0.05], 0.1 deg
  uint64_t seed = 0;               // of the rays: another seed shows the noise
};

struct IcePhase {
  std::vector<double> phase;     // 1/sr at each angle, integral 1 over the sphere
  double deltaTransmission = 0;  // share of the light that geometric optics sends straight on
  double asymmetry = 0;          // mean cosine of phase, without what goes straight on
};

// index as traceIce; angles in rad, [0, pi], in any order. Same bits for the same arguments.
// Linear between nodes 0.025 degrees apart. Where the curve allows it, it is blurred up to 1.6
// degrees wide; the edges of both halos stay where they are (within 0.01 degrees).
// Noise (1 sd, rms over 5-170 degrees): at 4e6 rays 0.4 % (rough) to 0.75 % (smooth), at 5e5 rays
// 1.2 to 3.3 %. At 4e6 up to 1.3 % in 115-178 degrees, 0.3 to 7 % below 0.5 and above 178.
IcePhase icePhase(const IceCrystal& crystal, double index, std::span<const double> angles,
                  const IceSettings& settings);

}  // namespace welkin
