// SPDX-License-Identifier: MIT
// Where the volumes of a view are seen: per pixel the mean distance from the eye (m), weighted by
// what is hidden there, and how much of the background they hide in all. 0 and 0 without volumes.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0, std140) uniform Frame { FrameUniforms frameBlock; };
FrameUniforms frame = frameBlock;
layout(set = 0, binding = 1, std430) readonly buffer Distances { vec4 distances[]; };
layout(set = 0, binding = 2) uniform writeonly image2D target;

#include "half_float.glsl"

const float LARGEST_HALF = 65504.0f;

void main() {
  uvec2 pixel = gl_GlobalInvocationID.xy;
  if (pixel.x >= uint(frame.viewport.x) || pixel.y >= uint(frame.viewport.y)) {
    return;
  }
  vec2 p = vec2(pixel);
  vec2 hidden = vec2(0.0f);
  if (p.x >= frame.volumeRect.x && p.y >= frame.volumeRect.y && p.x < frame.volumeRect.z &&
      p.y < frame.volumeRect.w) {
    hidden = distances[pixel.y * uint(frame.viewport.x) + pixel.x].xy;
  }
  vec2 value = vec2(hidden.x / max(hidden.y, 1.0e-30f), min(hidden.y, 1.0f));
  if (frame.froxelRange.z > 0.0f) {
    value = roundedToHalf(vec3(min(value, vec2(LARGEST_HALF)), 0.0f)).xy;
  }
  imageStore(target, ivec2(pixel), vec4(value, 0.0f, 0.0f));
}
