// SPDX-License-Identifier: MIT
// Light inside volumes on a grid of cells (shaders/pass/transport*): its sizes, what it depends on
// and the numbers its passes read. Lengths in m.
#pragma once

#include "frame/plan.hpp"
#include "frame/scene.hpp"
#include "frame/transport_shape.hpp"
#include "frame/uniforms.hpp"

namespace welkin {

// Cells per level, and bytes of the lists.
struct TransportSizes {
  std::array<uint32_t, interface_::TRANSPORT_LEVELS> cells{};
  // While light is computed, one volume at a time: sources, and radiance.
  VkDeviceSize workBytes = 0;
  VkDeviceSize sweptBytes = 0;
  VkDeviceSize keptBytes = 0;  // of each volume
};
TransportSizes transportSizes(const std::array<uint32_t, 3>& cells);
// In which light travels there.
uint32_t transportDirections(uint32_t level, const TransportShape& shape);

constexpr size_t TRANSPORT_DEGREES = 4;  // of the moments
constexpr size_t FINE_NODES = 256;       // of kernels, at sin(angle / 2) = i / 255

// Numbers of a volume's media: what transport takes for the peak, and the rest's moments.
struct TransportMedia {
  double peak = 0;  // albedo * energy in the peak, mean of the fields
  std::array<glm::vec4, WLK_MAX_FIELDS> fieldMoments{};
  glm::vec4 fieldFourth{0};  // of degree 4
  std::array<std::array<glm::vec4, TRANSPORT_DEGREES>, WLK_MAX_FIELDS> colorMoments{};  // RGB
  // Albedo times phase function without the peak, its degrees under 4 taken off, 1/sr, RGB.
  std::array<glm::dvec3, FINE_NODES> fineKernel{};
  std::array<glm::vec4, 24> products{};
  std::vector<float> response;  // RGBA, see PAIR_TABLE_NODES
  // Of the fields in the extinction, by which all these are means; all 0: nothing was there yet.
  std::array<double, WLK_MAX_FIELDS> shares{};
  // Of the turns by the peak that an endless medium would add between two others (turnedPhase), in
  // steps of 1 / TURNED_STEPS.
  double turned = 1;
};
TransportMedia transportMedia(const VolumeState& volume);
// The largest change of a field's share, or of the turns', since the volume's media were made.
double mediaChange(const VolumeState& volume);
// Mean over the colours of a function of the pair table at a scattering angle.
double transportPair(const TransportMedia& media, size_t function, double angle);

// Extinction (1/m) at value 1; 0 without an image.
float extinctionAtOne(const FieldState& field);
// Samples per half cell and axis: one for each voxel, 1 to 4.
float transportTaps(const VolumeState& volume, const TransportShape& shape);

void fillTransport(const VolumeState& volume, const glm::dvec3& toLight,
                   const TransportShape& shape, interface_::TransportUniforms& out);

}  // namespace welkin
