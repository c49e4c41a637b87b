// SPDX-License-Identifier: MIT
// Tables of one kind of particle that every volume with such particles reads: each is made where it
// is asked for first, and kept. No Vulkan.
#pragma once

#include <array>
#include <memory>

#include "particles/diameter_nodes.hpp"
#include "tables/scattering_orders.hpp"
#include "tables/transport_phase.hpp"

namespace welkin {

// Poisson counts of scatterings, the paper's whole numbers, and the first order with its peak
// blurred.
constexpr uint32_t SCATTERING_FORMS = 3;

// Of mixtures of a phase function and the same turned.
constexpr size_t TURNED_STEPS = 16;

class ParticleTables {
 public:
  // All of one object take the same particle. 10 to 500 ms the first time; 0.4 MB.
  const SourceRows& rows(const Particle& particle, uint32_t form);
  const TransportPhase& transport(const Particle& particle);  // 0.1 ms; 32 KB
  const TransportPhase& turned(const Particle& particle);     // turnedPhase: 0.3 to 40 ms; 32 KB
  // Of a volume of these particles alone, of which a part turned, in steps of 1 / TURNED_STEPS. 14
  // ms and 14 KB each.
  const TransportPairs& pairs(const Particle& particle, double turned);

  // Tables made so far.
  uint32_t made() const { return made_; }

 private:
  std::array<std::unique_ptr<const SourceRows>, SCATTERING_FORMS> rows_;
  std::unique_ptr<const TransportPhase> transport_;
  std::unique_ptr<const TransportPhase> turned_;
  std::array<std::unique_ptr<const TransportPairs>, TURNED_STEPS + 1> pairs_;
  uint32_t made_ = 0;
};

// Of a medium, and of its droplets at the diameters of its nodes.
struct MediumTables {
  ParticleTables own;
  std::array<ParticleTables, DIAMETER_NODES> nodes;
};

}  // namespace welkin
