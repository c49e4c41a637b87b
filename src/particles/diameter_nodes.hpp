// SPDX-License-Identifier: MIT
// Droplets of a medium at diameters in even steps of their logarithm, over the whole range of its
// kind: what volumes with a diameter per voxel look up. No Vulkan.
#pragma once

#include <array>

#include "particles/medium.hpp"

namespace welkin {

constexpr size_t DIAMETER_NODES = 24;  // 1 + LAST_DIAMETER of shaders/pass/volume_source.glsl

struct DiameterNodes {
  double low_um = 0;
  double high_um = 0;
  double own_um = 0;  // the medium's
  std::array<Particle, DIAMETER_NODES> particles;

  // Place among the nodes, [0, DIAMETER_NODES - 1]: of the nearest diameter in the range; of what
  // is no diameter (0, negative, NaN, infinite) the medium's own.
  double place(double diameter_um) const;
  // Extinction cross-section of a mass of water, mean of the colours, m^2/kg:
  // 0.75 Q / (density * effective radius), Q between nodes geometric.
  double extinctionPerMass(double diameter_um) const;
};

// Droplets of the tables' spread and the closed form: other spreads take Mie theory at each node.
bool variesInDiameter(const Medium& medium);

// Fails with std::bad_alloc only.
DiameterNodes makeDiameterNodes(const Medium& medium);

}  // namespace welkin
