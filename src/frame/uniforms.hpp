// SPDX-License-Identifier: MIT
// Fills the constants of the passes from scene and plan.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "frame/scene.hpp"

namespace welkin {

// The GLSL structs of shaders/interface as C++: rows of vec4 and mat4.
namespace interface_ {
using vec4 = glm::vec4;
using mat4 = glm::mat4;
using uint = uint32_t;
#include "interface/frame.glsl"
#include "interface/slices.glsl"
}  // namespace interface_

// The air the engine set, as the model wants it.
struct AirState {
  std::optional<WlkSky> sky;
  std::optional<WlkFog> fog;
  WlkPlanet planet{};
  std::optional<WlkLight> light;
};

void fillFrame(const AirState& air, const ViewState& view, interface_::FrameUniforms& out);
void fillVolume(const VolumeState& volume, const PlannedVolume& planned, const glm::dvec3& eye,
                const SliceQuality& quality, interface_::VolumeUniforms& out);

// Largest finite value of a target format.
float targetLimit(uint32_t welkinFormat);

}  // namespace welkin
