// SPDX-License-Identifier: MIT
// What the passes of a surface read: its constants, its mesh, and what its triangles cover.
#include "../interface/surface.glsl"

layout(set = 0, binding = 1, std140) uniform Surface { SurfaceUniforms surface; };
layout(set = 0, binding = 2, std430) readonly buffer Vertices { float vertices[]; };
layout(set = 0, binding = 3, std430) readonly buffer Indices { uint indices[]; };
layout(set = 0, binding = 4, std430) buffer Cover { SurfaceCover surfaceCover[]; };
// The same buffer.
layout(set = 0, binding = 4, std430) buffer CoverWords { uint surfaceWords[]; };
layout(set = 0, binding = 23) uniform sampler3D shellNoise;
layout(set = 0, binding = 25) uniform sampler3D shellField;

vec3 surfaceVertex(uint i) {
  return vec3(vertices[3u * i], vertices[3u * i + 1u], vertices[3u * i + 2u]);
}

uint surfaceIndex(uint k) {
  return indices[k];
}
