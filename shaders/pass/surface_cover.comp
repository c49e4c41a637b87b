// SPDX-License-Identifier: MIT
// What a surface's triangles cover in a picture: first, last and total depth in each pixel.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common.glsl"

layout(local_size_x = 64) in;
// Rays may end before: surface_ends.comp.
layout(constant_id = 5) const bool ENDS = true;

#include "surface_mesh.glsl"

void surfaceCross(SurfaceUniforms s, ivec2 pixel, uint at, SurfaceCrossing crossing,
                  uint triangle);
#include "surface_large.glsl"
#include "surface_cross.glsl"

void surfaceCross(SurfaceUniforms s, ivec2 pixel, uint at, SurfaceCrossing crossing,
                  uint triangle) {
  uint end = ENDS ? ~furtherWord(at) : 0xffffffffu;
  surfaceCount(at, crossing, min(surfaceStep(s, crossing.depth), end));
}

void main() {
  coverSurface();
}
