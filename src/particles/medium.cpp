// SPDX-License-Identifier: MIT
#include "particles/medium.hpp"

#include <algorithm>
#include <cmath>

#include "model/model.hpp"
#include "particles/types/spectrum.hpp"

namespace welkin {
namespace {

namespace text = model::f64;

text::FogPhase toText(const FogPhaseParams& p) {
  text::FogPhase result;
  result.gHg = p.gHg;
  result.gapHg = p.gapHg;
  result.gD = p.gD;
  result.gapD = p.gapD;
  result.alpha = p.alpha;
  result.weightD = p.weightD;
  return result;
}

double meanOf(const std::array<double, RGB>& values) {
  return (values[0] + values[1] + values[2]) / 3;
}

}  // namespace

double Medium::extinctionFactor() const {
  return 1 - meanOf(particle->optics.delta) * meanOf(albedo);
}

std::array<double, RGB> Medium::scaledAlbedo() const {
  const double scattered = 1 - meanOf(particle->optics.delta);
  std::array<double, RGB> scaled{};
  for (size_t c = 0; c < RGB; ++c) {
    scaled[c] = std::clamp(albedo[c] * scattered / extinctionFactor(), 0.0, 1.0);
  }
  return scaled;
}

Medium makeMedium(ParticleType type, const ParticleParams& params,
                  const std::array<double, RGB>& albedo) {
  Medium medium;
  medium.particle = std::make_shared<const Particle>(particleKind(type).make(params));
  medium.albedo = albedo;
  medium.type = type;
  medium.params = params;
  medium.params.userAngle = medium.params.userPhase = {};
  return medium;
}

double meanOneMinusCosine(const Particle& particle) {
  double sum = 0;
  for (size_t c = 0; c < RGB; ++c) {
    sum +=
        particle.analytic ? 1 - meanCosine(particle.phase) : meanOneMinusCosine(particle.curve, c);
  }
  return sum / RGB;
}

double evalParticle(const Particle& particle, size_t channel, double angle) {
  const double half = std::sin(0.5 * angle);
  const double y = 2 * half * half;
  return particle.analytic ? evalPhase(particle.phase, y)
                           : evalPhaseCurve(particle.curve, channel, y);
}

double sampleParticle(const Particle& particle, size_t channel, double random) {
  const double y = particle.analytic ? text::sampleFogPhase(toText(particle.phase), random)
                                     : samplePhaseCurve(particle.curve, channel, random);
  return angleOf(y);
}

}  // namespace welkin
