// SPDX-License-Identifier: MIT
// surface_cover.glsl over plain buffers: uniforms, then vertices, then indices.
#version 460
#extension GL_GOOGLE_include_directive : require
#define real float
const bool AIR_ENABLED = true;
const bool FOG_ENABLED = true;
const bool ABSORBER_ENABLED = true;
layout(local_size_x = 64) in;
layout(constant_id = 0) const int VERTICES = 0;
#include "model/model.glsl"
#include "interface/surface.glsl"
layout(set = 0, binding = 0, std430) readonly buffer Input {
  SurfaceUniforms uniforms;
  float numbers[];
};
layout(set = 0, binding = 1, std430) buffer Output { uint surfaceWords[]; };

vec3 surfaceVertex(uint i) {
  return vec3(numbers[3u * i], numbers[3u * i + 1u], numbers[3u * i + 2u]);
}

uvec3 surfaceCorners(uint triangle) {
  uint first = 3u * (uint(VERTICES) + triangle);
  return floatBitsToUint(vec3(numbers[first], numbers[first + 1u], numbers[first + 2u]));
}

void surfaceCross(SurfaceUniforms s, ivec2 pixel, uint at, SurfaceCrossing crossing, uint triangle);
// Told in a word that the library leaves 0, main takes large triangles by themselves.
bool surfaceLater(uint triangle, uint pixels, uint strips) {
  return uniforms.triangle.w != 0u;
}
#include "pass/surface_cover.glsl"
#include "pass/surface_cross.glsl"

// In the word behind those of all pixels: how often a ray leaves less how often it enters.
void surfaceCross(SurfaceUniforms s, ivec2 pixel, uint at, SurfaceCrossing crossing,
                  uint triangle) {
  surfaceCount(at, crossing, surfaceStep(s, crossing.depth));
  uint pixels = uint((s.rect.z - s.rect.x) * (s.rect.w - s.rect.y));
  atomicAdd(surfaceWords[pixels * SURFACE_COVER_WORDS + at],
            crossing.facing > 0.0f ? 0xffffffffu : 1u);
}

// Groups along x only: of triangles, then strip by strip of each. The last word: strips but each
// one's first.
void main() {
  uint groups = (uniforms.triangle.x + SURFACE_LANES - 1u) / SURFACE_LANES;
  uint lane = gl_LocalInvocationIndex;
  if (gl_WorkGroupID.x < groups) {
    coverTriangles(uniforms, uvec2(gl_WorkGroupID.x, 0u), lane);
  } else {
    uint number = gl_WorkGroupID.x - groups;
    uint triangle = number % uniforms.triangle.x;
    uint strip = number / uniforms.triangle.x;
    SurfaceTriangle t = surfaceTriangle(uniforms, triangle);
    if (surfaceBoxSize(t.box) > SURFACE_MIDDLE && strip < surfaceStrips(t.box)) {
      coverLarge(uniforms, triangle, strip, lane);
      uvec2 size = uvec2(uniforms.rect.zw - uniforms.rect.xy);
      if (lane == 0u && strip > 0u) {
        atomicAdd(surfaceWords[size.x * size.y * (SURFACE_COVER_WORDS + 1u)], 1u);
      }
    }
  }
}
