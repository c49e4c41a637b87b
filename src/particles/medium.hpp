// SPDX-License-Identifier: MIT
// A medium as volumes and fog see it: what its particles do to light, and its albedo. No Vulkan.
#pragma once

#include <array>
#include <memory>

#include "particles/catalogue.hpp"

namespace welkin {

struct Medium {
  std::shared_ptr<const Particle> particle;
  std::array<double, RGB> albedo{1, 1, 1};  // single-scattering, [0, 1]

  // Light that goes straight on is neither scattered nor lost: volumes take it off, as
  // P = f delta + (1 - f) P', extinction' = (1 - albedo f) extinction,
  // albedo' = (1 - f) albedo / (1 - albedo f). Colours differ by less than 1e-2 in f: the
  // extinction is that of their mean, the albedo makes up for it.
  double extinctionFactor() const;
  std::array<double, RGB> scaledAlbedo() const;
};

// A medium of one type. Fails with std::bad_alloc only.
Medium makeMedium(ParticleType type, const ParticleParams& params,
                  const std::array<double, RGB>& albedo);

// P in 1/sr of a channel at a scattering angle in rad: the closed form where it is exact.
double evalParticle(const Particle& particle, size_t channel, double angle);

// The angle for a random number in [0, 1), by inversion.
double sampleParticle(const Particle& particle, size_t channel, double random);

}  // namespace welkin
