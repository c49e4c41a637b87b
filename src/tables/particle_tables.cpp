// SPDX-License-Identifier: MIT
#include "tables/particle_tables.hpp"

#include <array>
#include <cmath>

namespace welkin {
namespace {

SourceRows makeRows(const Particle& particle, uint32_t form) {
  const PhaseCurve& curve = particle.curve;
  const SourceForm kind = form == 1 ? SourceForm::Integer : SourceForm::Poisson;
  if (form == 2) {
    return peakRows(curve);
  }
  return particle.analytic && kind == SourceForm::Poisson
             ? closedSourceRows(curve.y, particle.phase)
             : sourceRows(curve.y, {curve.value[0], curve.value[1], curve.value[2]}, kind);
}

}  // namespace

const SourceRows& ParticleTables::rows(const Particle& particle, uint32_t form) {
  std::unique_ptr<const SourceRows>& kept = rows_[form];
  if (!kept) {
    kept = std::make_unique<const SourceRows>(makeRows(particle, form));
    ++made_;
  }
  return *kept;
}

const TransportPhase& ParticleTables::transport(const Particle& particle) {
  if (!transport_) {
    transport_ = std::make_unique<const TransportPhase>(transportPhase(particle.curve));
    ++made_;
  }
  return *transport_;
}

const TransportPhase& ParticleTables::turned(const Particle& particle) {
  if (!turned_) {
    turned_ =
        std::make_unique<const TransportPhase>(turnedPhase(particle.curve, transport(particle)));
    ++made_;
  }
  return *turned_;
}

const TransportPairs& ParticleTables::pairs(const Particle& particle, double turned) {
  const auto step = static_cast<size_t>(std::lround(turned * TURNED_STEPS));
  std::unique_ptr<const TransportPairs>& kept = pairs_[step];
  if (!kept) {
    const std::array phases = {&transport(particle), &this->turned(particle)};
    const double part = static_cast<double>(step) / TURNED_STEPS;
    const std::array weights = {1 - part, part};
    kept = std::make_unique<const TransportPairs>(transportPairs(phases, weights));
    ++made_;
  }
  return *kept;
}

}  // namespace welkin
