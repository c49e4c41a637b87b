// SPDX-License-Identifier: MIT
// From scene-referred radiance to the display. The swapchain's sRGB format encodes.
#version 460

// 1: Welkin left the engine's picture alone and wrote its layer to two images.
layout(constant_id = 0) const bool SEPARATE = false;

layout(set = 0, binding = 0) uniform sampler2D scene;
layout(set = 0, binding = 1) uniform sampler2D layerRadiance;
layout(set = 0, binding = 2) uniform sampler2D layerTransmittance;
layout(push_constant) uniform Constants { float exposure; };
layout(location = 0) out vec4 display;

// Filmic curve: K. Narkowicz, "ACES filmic tone mapping curve", 2015.
vec3 filmic(vec3 x) {
  return min(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), vec3(1.0));
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec3 color = texelFetch(scene, pixel, 0).xyz;
  if (SEPARATE) {
    color = color * texelFetch(layerTransmittance, pixel, 0).xyz +
            texelFetch(layerRadiance, pixel, 0).xyz;
  }
  display = vec4(filmic(color * exposure), 1.0);
}
