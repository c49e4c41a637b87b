// SPDX-License-Identifier: MIT
// A slice seen from the eye: radiance per unit irradiance and phase function, and transmittance,
// for blending. Light at the middle of the slab, opacity 1 - e^-x: with the light before the slab
// and x itself, as first published, errors are ten times larger.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "scene.glsl"

layout(set = 0, binding = 2) uniform sampler2D lightBuffer;  // optical depth
layout(location = 0) in vec3 box;
layout(location = 1) in vec3 ray;
layout(location = 2) in vec2 uv;
layout(location = 0) out vec4 color;

void main() {
  float beta = textureLod(density, box, 0.0).x * scene.optics.x;
  float tau = textureLod(lightBuffer, uv, 0.0).x + 0.5 * beta * scene.optics.y;
  float path = scene.axis.w * length(ray) / abs(dot(ray, scene.axis.xyz));
  float through = exp(-beta * path);
  color = vec4(vec3((1.0 - through) * exp(-tau)), through);
}
