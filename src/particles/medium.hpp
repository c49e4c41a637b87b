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
  ParticleType type = ParticleType::Cloud;
  ParticleParams params;  // without a user's table

  // Light that goes straight on is neither scattered nor lost: volumes take it off, as
  // P = f delta + (1 - f) P', extinction' = (1 - albedo f) extinction,
  // albedo' = (1 - f) albedo / (1 - albedo f). Volumes have one extinction for all colours, so f
  // and the albedo next to it are means over them: white particles stay white. Exact for a grey
  // albedo and an f that all colours share.
  double extinctionFactor() const;
  std::array<double, RGB> scaledAlbedo() const;
};

// A medium of one type. Fails with std::bad_alloc only.
Medium makeMedium(ParticleType type, const ParticleParams& params,
                  const std::array<double, RGB>& albedo);

// 1 - the mean cosine of the scattering angle, over the colours.
double meanOneMinusCosine(const Particle& particle);

// P in 1/sr of a channel at a scattering angle in rad: the closed form where it is exact.
double evalParticle(const Particle& particle, size_t channel, double angle);

// The angle for a random number in [0, 1), by inversion.
double sampleParticle(const Particle& particle, size_t channel, double random);

}  // namespace welkin
