// SPDX-License-Identifier: MIT
// One half of the window: the view's picture through a filmic curve.
#version 460

layout(set = 0, binding = 0) uniform sampler2D picture;
layout(push_constant) uniform Constants {
  ivec2 origin;  // of the half in the window
  float exposure;
};
layout(location = 0) out vec4 display;

// K. Narkowicz, "ACES filmic tone mapping curve", 2015.
vec3 filmic(vec3 x) {
  return min(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), vec3(1.0));
}

void main() {
  vec3 color = texelFetch(picture, ivec2(gl_FragCoord.xy) - origin, 0).xyz;
  display = vec4(filmic(color * exposure), 1.0);
}
