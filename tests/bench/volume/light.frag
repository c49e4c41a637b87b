// SPDX-License-Identifier: MIT
// A slice seen from the light: its optical depth, which blending adds to the light buffer in place.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "scene.glsl"

layout(location = 0) in vec3 box;
layout(location = 0) out float depth;

void main() {
  depth = textureLod(density, box, 0.0).x * scene.optics.x * scene.optics.y;
}
