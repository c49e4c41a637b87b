// SPDX-License-Identifier: MIT
// What the passes of a surface read: its constants, its mesh, and what its triangles cover.
#include "../interface/surface.glsl"
#include "texels.glsl"

layout(set = 0, binding = 1, std140) uniform Surface { SurfaceUniforms surfaceBlock; };
SurfaceUniforms surface = surfaceBlock;
// Positions and triangles, row by row. Images, as texels cost drivers such as lavapipe less than a
// word of a buffer does.
layout(set = 0, binding = 2, rgba32f) readonly uniform image2D vertices;
layout(set = 0, binding = 3, rgba32ui) readonly uniform uimage2D triangles;
layout(set = 0, binding = 4, std430) buffer CoverWords { uint surfaceWords[]; };
// The same buffer.
layout(set = 0, binding = 4, std430) buffer CoverRows { uvec4 surfaceRows[]; };
layout(set = 0, binding = 28) uniform usamplerBuffer coverTexels;
layout(set = 0, binding = 23) uniform sampler3D shellNoise;
// Of cells over the mesh's box: how deep they and their neighbours along x, y and both lie, see
// surface_shell.comp. Two such faces cost drivers such as lavapipe less than a linear filter.
layout(set = 0, binding = 25) uniform usamplerBuffer shellTexels;
layout(set = 0, binding = 27, std430) buffer ShellRows { uvec4 shellRows[]; };

ivec2 meshTexel(uint i) {
  return ivec2(uvec2(i % SURFACE_MESH_ROW, i / SURFACE_MESH_ROW));
}

vec3 surfaceVertex(uint i) {
  return imageLoad(vertices, meshTexel(i)).xyz;
}

uvec3 surfaceCorners(uint triangle) {
  return imageLoad(triangles, meshTexel(triangle)).xyz;
}

// A pixel's row, of an earlier dispatch.
uvec4 coverRow(uint at) {
  if (TEXELS) {
    return texelFetch(coverTexels, int(at));
  }
  return surfaceRows[at];
}

vec4 shellFace(int at) {
  if (TEXELS) {
    return uintBitsToFloat(texelFetch(shellTexels, at));
  }
  return uintBitsToFloat(shellRows[at]);
}

SurfaceCover coverOf(uint at) {
  uvec4 row = coverRow(at);
  uint leave = row[SURFACE_LEAVE] != 0u ? ~row[SURFACE_LEAVE] : 0u;
  uint enter = row[SURFACE_FRONT] != 0u ? ~row[SURFACE_FRONT] : 0u;
  return SurfaceCover(row[SURFACE_FRONT], row[SURFACE_LEAVE], max(row[SURFACE_FARTHEST], leave),
                      int(row[SURFACE_REST] + leave - enter));
}

// The word of a pixel behind those of all.
uint coverFurther(uint at) {
  ivec2 size = surface.rect.zw - surface.rect.xy;
  return SURFACE_COVER_WORDS * uint(size.x) * uint(size.y) + at;
}

// And what an earlier dispatch left there.
uint furtherWord(uint at) {
  uint word = coverFurther(at);
  if (TEXELS) {
    return coverRow(word / 4u)[word % 4u];
  }
  return surfaceWords[word];
}
