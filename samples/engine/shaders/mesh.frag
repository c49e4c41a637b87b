// SPDX-License-Identifier: MIT
// Lambertian surface under the sun and a uniform sky: radiance that leaves it.
#version 460

layout(push_constant) uniform Constants {
  mat4 clipFromWorld;
  vec4 toSun;
  vec4 sunIrradiance;
  vec4 skyIrradiance;
};

layout(location = 0) in vec3 normal;
layout(location = 1) in vec3 albedo;
layout(location = 0) out vec4 radiance;

void main() {
  vec3 n = normalize(normal);
  vec3 sun = sunIrradiance.xyz * max(dot(n, toSun.xyz), 0.0);
  vec3 sky = skyIrradiance.xyz * (0.5 + 0.5 * n.y);
  radiance = vec4(albedo * (sun + sky) / 3.14159265, 1.0);
}
