// SPDX-License-Identifier: MIT
// The picture: colour * transmittance + radiance, from the froxels where the engine drew something,
// else from the sky's table. No sun disk.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "air.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 3) uniform sampler2D skyTable;
layout(set = 0, binding = 4) uniform sampler3D froxels;
layout(set = 0, binding = 5) uniform sampler2D depthImage;
layout(set = 0, binding = 6) uniform sampler2D colorInput;
layout(set = 0, binding = 11) uniform writeonly image2D target;

// The light's azimuth as the sine of half the angle, so that half a turn is enough.
vec3 skyAlong(vec3 direction) {
  float flatness = max(length(direction.xz), 1e-6f);
  float cosine = dot(direction.xz, scene.horizon.zw) / flatness;
  float angle = atan(flatness, direction.y);
  float x = sqrt(clamp(0.5f - 0.5f * cosine, 0.0f, 1.0f));
  float y = angle < scene.horizon.x
                ? 0.5f - 0.5f * sqrt(1.0f - angle / scene.horizon.x)
                : 0.5f + 0.5f * sqrt(min((angle - scene.horizon.x) / scene.horizon.y, 1.0f));
  return textureLod(skyTable, toTexture(vec2(x, y), SKY_SIZE), 0.0f).xyz;
}

void main() {
  uvec2 pixel = gl_GlobalInvocationID.xy;
  if (pixel.x >= uint(scene.size.x) || pixel.y >= uint(scene.size.y)) {
    return;
  }
  vec2 at = (vec2(pixel) + 0.5f) * scene.size.zw;
  vec2 ndc = 2.0f * at - 1.0f;
  vec3 ray = scene.forward.xyz + scene.right.xyz * ndc.x - scene.up.xyz * ndc.y;
  float depth = texelFetch(depthImage, ivec2(pixel), 0).x;
  vec3 color = vec3(0.0f);
  if (depth > 0.0f) {
    // Nearer than the first froxel's middle the volume fades to nothing.
    float slice = FROXELS * length(ray) * scene.forward.w / (depth * scene.light.w);
    vec4 air = textureLod(froxels, vec3(at, max(slice, 0.5f) / FROXELS), 0.0f);
    float share = min(2.0f * slice, 1.0f);
    vec3 behind = texelFetch(colorInput, ivec2(pixel), 0).xyz;
    color = behind * (1.0f - share * (1.0f - air.w)) + share * air.xyz;
  } else {
    color = skyAlong(normalize(ray));
  }
  imageStore(target, ivec2(pixel), vec4(color, 1.0f));
}
