// SPDX-License-Identifier: MIT
// The engine's opaque meshes.
#version 460

layout(push_constant) uniform Constants {
  mat4 clipFromWorld;
  vec4 toSun;
  vec4 sunIrradiance;
  vec4 skyIrradiance;
};

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 albedo;
layout(location = 0) out vec3 normalOut;
layout(location = 1) out vec3 albedoOut;

void main() {
  gl_Position = clipFromWorld * vec4(position, 1.0);
  normalOut = normal;
  albedoOut = albedo;
}
