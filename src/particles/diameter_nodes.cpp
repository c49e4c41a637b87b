// SPDX-License-Identifier: MIT
#include "particles/diameter_nodes.hpp"

#include <algorithm>
#include <cmath>

namespace welkin {
namespace {

constexpr double LAST = DIAMETER_NODES - 1.0;
constexpr double WATER_DENSITY = 999.7;  // kg/m^3, at 10 degrees as the index of refraction
constexpr double M_PER_um = 1e-6;

double meanEfficiency(const Particle& particle) {
  const auto& q = particle.optics.efficiency;
  return (q[0] + q[1] + q[2]) / 3;
}

}  // namespace

double DiameterNodes::place(double diameter_um) const {
  const bool valid = diameter_um > 0 && std::isfinite(diameter_um);
  const double diameter = std::clamp(valid ? diameter_um : own_um, low_um, high_um);
  return LAST * std::log(diameter / low_um) / std::log(high_um / low_um);
}

double DiameterNodes::extinctionPerMass(double diameter_um) const {
  const double at = place(diameter_um);
  const size_t low = std::min(static_cast<size_t>(at), DIAMETER_NODES - 2);
  const double t = at - static_cast<double>(low);
  const double efficiency = std::pow(meanEfficiency(particles[low]), 1 - t) *
                            std::pow(meanEfficiency(particles[low + 1]), t);
  // The spread is the same at all nodes: radii go as the diameter.
  const double radius =
      particles[0].optics.effectiveRadius_um * std::pow(high_um / low_um, at / LAST) * M_PER_um;
  return 0.75 * efficiency / (WATER_DENSITY * radius);
}

bool variesInDiameter(const Medium& medium) {
  const ParticleKind& kind = particleKind(medium.type);
  const bool droplets = medium.type == ParticleType::Cloud || medium.type == ParticleType::Fog ||
                        medium.type == ParticleType::Haze || medium.type == ParticleType::Rain;
  return droplets && medium.params.spread == kind.spread.initial;
}

DiameterNodes makeDiameterNodes(const Medium& medium) {
  const ParticleRange& range = particleKind(medium.type).diameter_um;
  DiameterNodes nodes;
  nodes.low_um = range.low;
  nodes.high_um = range.high;
  nodes.own_um = medium.params.diameter_um;
  for (size_t i = 0; i < DIAMETER_NODES; ++i) {
    ParticleParams params = medium.params;
    // Rounding must not leave the range.
    params.diameter_um = std::min(
        range.low * std::pow(range.high / range.low, static_cast<double>(i) / LAST), range.high);
    nodes.particles[i] = particleKind(medium.type).make(params);
  }
  return nodes;
}

}  // namespace welkin
