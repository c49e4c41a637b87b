// SPDX-License-Identifier: MIT
// Light of sky and ground inside volumes (shaders/pass/ambient*): what comes in from which
// direction, the grid's sizes and the numbers its passes read. Lengths in m.
#pragma once

#include <span>

#include "frame/plan.hpp"
#include "frame/scene.hpp"
#include "frame/transport.hpp"
#include "frame/uniforms.hpp"

namespace welkin {

// Radiance from a part of the sphere around a volume.
struct AmbientSample {
  glm::dvec3 from;  // unit vector to where it comes from
  double solidAngle;
  glm::dvec3 radiance;
};

// What comes in along the directions of the volume's grid, so that their sums have the moments of
// degree < 4 that `samples` have; nowhere below 0.
AmbientLight ambientThrough(const glm::dmat3& box, const TransportShape& shape,
                            std::span<const AmbientSample> samples);
// What an unshaded cell scatters of it in each direction by degrees over 3; `whole`: with the peak,
// which is seen as wide as the samples lie apart.
AmbientFine ambientFine(const TransportMedia& media, std::span<const AmbientSample> samples,
                        bool whole);
// Whether nothing comes in.
bool dark(const AmbientLight& light);

struct AmbientSizes {
  VkDeviceSize workBytes = 0;  // while light is computed; one volume at a time
  VkDeviceSize keptBytes = 0;  // of each volume
};
// What a grid is told by beside its uniforms: volume, its version, whether whole, engine's images.
constexpr size_t AMBIENT_IDS = 3 + size_t{WLK_MAX_FIELDS};
AmbientSizes ambientSizes(const std::array<uint32_t, 3>& cells);

void fillAmbient(const VolumeState& volume, const TransportShape& shape,
                 const VolumeAmbient& ambient, interface_::AmbientUniforms& out);

}  // namespace welkin
