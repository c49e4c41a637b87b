// SPDX-License-Identifier: MIT
// Eye buffer to picture: the light comes from one direction, so the phase function (1/sr) is a
// constant of the pixel and is applied once.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "scene.glsl"

layout(set = 0, binding = 3) uniform sampler2D eyeBuffer;
layout(location = 0) out vec4 color;

void main() {
  vec4 seen = texelFetch(eyeBuffer, ivec2(gl_FragCoord.xy), 0);
  float g = scene.optics.z;
  float cosine = dot(pixelRay(gl_FragCoord.xy - 0.5), scene.toLight.xyz);
  float base = 1.0 + g * g - 2.0 * g * cosine;
  float phase = 0.0795774715459477 * (1.0 - g * g) / (base * sqrt(base));
  color = vec4(seen.xyz * phase, seen.w);
}
