// SPDX-License-Identifier: MIT
// Directions and functions in which light travels through a layer, a volume much wider than it is
// high. There light depends on the angle to the layer's plane, on whose two sides it differs, far
// more than harmonics of a low degree can follow; so rings of directions around the layer's normal
// stand for it. Lengths in m.
#pragma once

#include "frame/transport.hpp"

namespace welkin {

struct TransportLayer {
  static constexpr size_t RINGS = 2 * size_t{interface_::LAYER_RINGS};  // of both sides
  static constexpr size_t TURNS = interface_::LAYER_TURNS;
  static constexpr size_t COUNT = RINGS * TURNS;
  // World to the layer's frame, rows: towards the light's azimuth, across, the normal.
  std::array<glm::dvec3, 3> frame;
  glm::dvec3 travel;                        // of the light, in the frame
  std::array<glm::dvec3, COUNT> direction;  // in the world
  std::array<glm::dvec3, COUNT> local;      // in the frame
  std::array<double, COUNT> weight;         // sum 1
};
// Of the layer's plane, in the world.
glm::dvec3 layerNormal(const glm::dmat3& box, int thinAxis);
TransportLayer transportLayer(const glm::dmat3& box, int thinAxis, const glm::dvec3& travel);

// Y(4, 0), Y(4, 1), Y(4, 2) of a direction in the frame, mean square 1.
std::array<double, 3> layerFourth(const glm::dvec3& v);

// Rows of TransportUniforms from FIRST_ROWS and SECOND_ROWS. `twice`: the phase function of two
// turns in each direction, any scale.
void fillLayerRows(const TransportLayer& layer,
                   const std::array<double, TransportLayer::COUNT>& twice, glm::vec4* rows);

}  // namespace welkin
