// SPDX-License-Identifier: MIT
// Light inside volumes on a grid of cells (shaders/pass/transport*): its sizes, what it depends on
// and the numbers its passes read. Lengths in m.
#pragma once

#include "frame/plan.hpp"
#include "frame/scene.hpp"
#include "frame/uniforms.hpp"

namespace welkin {

// Levels of a grid with `cells` cells along every axis of the box, a multiple of 4.
struct TransportSizes {
  std::array<uint32_t, interface_::TRANSPORT_LEVELS> cells{};  // in all, per level
  VkDeviceSize workBytes = 0;  // while light is computed; one volume at a time
  VkDeviceSize keptBytes = 0;  // of each volume
};
TransportSizes transportSizes(uint32_t cells);

// Numbers of a volume's media: what transport takes for the peak, and the rest's moments.
struct TransportMedia {
  double peak = 0;  // albedo * energy in the peak, mean of the fields
  std::array<glm::vec4, WLK_MAX_FIELDS> fieldMoments{};
  std::array<glm::vec4, 12> first{};
  std::vector<float> response;  // RGBA, see PAIR_TABLE_NODES
};
TransportMedia transportMedia(const VolumeState& volume);

void fillTransport(const VolumeState& volume, const glm::dvec3& toLight, uint32_t cells,
                   interface_::TransportUniforms& out);

}  // namespace welkin
