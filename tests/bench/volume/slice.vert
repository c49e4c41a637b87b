// SPDX-License-Identifier: MIT
// Corners of a slice polygon, to the picture or to the light buffer.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "scene.glsl"

layout(constant_id = 0) const bool TO_LIGHT = false;

layout(location = 0) in vec3 corner;  // in the unit box
layout(location = 0) out vec3 box;
layout(location = 1) out vec3 ray;  // from the eye, m
layout(location = 2) out vec2 uv;

void main() {
  vec4 p = vec4(corner, 1.0);
  box = corner;
  ray = vec3(dot(scene.eyeX, p), dot(scene.eyeY, p), dot(scene.eyeZ, p));
  uv = vec2(dot(scene.lightU, p), dot(scene.lightV, p));
  gl_Position = TO_LIGHT ? vec4(2.0 * uv - 1.0, 0.5, 1.0) : scene.clipFromBox * p;
}
