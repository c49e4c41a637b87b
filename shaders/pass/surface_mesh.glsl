// SPDX-License-Identifier: MIT
// What the passes of a surface read: its constants, its mesh, and what its triangles cover.
#include "../interface/surface.glsl"

layout(set = 0, binding = 1, std140) uniform Surface { SurfaceUniforms surface; };
// Positions and triangles, row by row. Images, as texels cost drivers such as lavapipe less than a
// word of a buffer does.
layout(set = 0, binding = 2, rgba32f) readonly uniform image2D vertices;
layout(set = 0, binding = 3, rgba32ui) readonly uniform uimage2D triangles;
layout(set = 0, binding = 4, std430) buffer Cover { SurfaceCover surfaceCover[]; };
// The same buffer.
layout(set = 0, binding = 4, std430) buffer CoverWords { uint surfaceWords[]; };
layout(set = 0, binding = 23) uniform sampler3D shellNoise;
layout(set = 0, binding = 25) uniform sampler3D shellField;

ivec2 meshTexel(uint i) {
  return ivec2(uvec2(i % SURFACE_MESH_ROW, i / SURFACE_MESH_ROW));
}

vec3 surfaceVertex(uint i) {
  return imageLoad(vertices, meshTexel(i)).xyz;
}

uvec3 surfaceCorners(uint triangle) {
  return imageLoad(triangles, meshTexel(triangle)).xyz;
}

// The word of a pixel behind those of all.
uint coverFurther(uint at) {
  ivec2 size = surface.rect.zw - surface.rect.xy;
  return SURFACE_COVER_WORDS * uint(size.x) * uint(size.y) + at;
}
