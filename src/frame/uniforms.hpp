// SPDX-License-Identifier: MIT
// Fills the constants of the passes from scene and plan.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>

#include "frame/scene.hpp"

namespace welkin {

// The GLSL structs of shaders/interface as C++: rows of vec4 and mat4.
namespace interface_ {
using vec4 = glm::vec4;
using ivec4 = glm::ivec4;
using mat4 = glm::mat4;
using uint = uint32_t;
#include "interface/frame.glsl"
#include "interface/shadow_map.glsl"
#include "interface/sky_table.glsl"
#include "interface/slices.glsl"
#include "interface/transport.glsl"
// Needs the one above.
#include "interface/ambient.glsl"
}  // namespace interface_
static_assert(interface_::MAX_LIGHTS == MAX_LIGHTS);

// A fog's phase function, also as the GPU reads it: RGB in 1/sr at the nodes of a PhaseCurve.
struct FogPhaseState {
  Particle particle;
  std::array<glm::vec4, kCurveNodes> curve{};
};

// The air the engine set, as the model wants it.
struct AirState {
  std::optional<WlkSky> sky;
  std::optional<WlkAbsorber> absorber;
  std::optional<WlkFog> fog;
  std::shared_ptr<const FogPhaseState> fogPhase;  // where there is fog
  WlkPlanet planet{};
  WlkAmbient ambient{};
  std::array<WlkLight, MAX_LIGHTS> lights{};
  uint32_t lightCount = 0;
};

// Whether the light's disk shows a phase.
bool litByAnother(const WlkLight& light);
// Whether its disk is not uniform.
bool hasShapedDisk(const WlkLight& light);

// The rows of a pass' constants that tell how the fields are kept.
template <typename Constants>
void fillBricks(const VolumeState& volume, Constants& out) {
  out.voxels = {volume.size[0], volume.size[1], volume.size[2], 0.0f};
  for (uint32_t i = 0; i < volume.fieldCount; ++i) {
    if (volume.fields[i].bricks()) {
      const VkExtent3D& texels = volume.fields[i].image.info().extent;
      out.atlas[i] = {1.0f / static_cast<float>(texels.width),
                      1.0f / static_cast<float>(texels.height),
                      1.0f / static_cast<float>(texels.depth), 0.0f};
    }
  }
}

// What multiplies radiance at 680, 550 and 440 nm, relative to sunlight, to WLK_COLOR_*.
using ColorRows = std::array<std::array<float, 3>, 3>;
ColorRows colorRows(uint32_t colorSpace);

void fillFrame(const AirState& air, const SkyLightState& sky, const ViewState& view,
               interface_::FrameUniforms& out);
// Whether the eye is so high that its table is too coarse for the edge of night below.
bool seenFromSpace(const SkyLightConstants& sky, double altitude);
// Sets space, allLight, where a table of all light is about as exact as evaluating every pixel, and
// skyZeniths of the plan.
void chooseSkyTable(const SkyLightConstants& sky, double planetRadius, const PlanetFrame& eye,
                    Plan& plan);
// The numbers a sky table depends on.
SkyTableKey skyTableKeyOf(const interface_::FrameUniforms& frame);
void fillVolume(const VolumeState& volume, const PlannedVolume& planned, const glm::dvec3& eye,
                const SliceQuality& quality, interface_::VolumeUniforms& out);

// Largest finite value of a target format.
float targetLimit(uint32_t welkinFormat);

}  // namespace welkin
