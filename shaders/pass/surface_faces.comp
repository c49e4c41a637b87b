// SPDX-License-Identifier: MIT
// Which triangle each texel of a light map shows on the lit side and on the other: of several at
// one depth the last.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common.glsl"

layout(local_size_x = 64) in;
#include "surface_mesh.glsl"
layout(set = 0, binding = 8, std430) buffer Faces { uint faceWords[]; };

void surfaceCross(SurfaceUniforms s, ivec2 pixel, uint at, SurfaceCrossing crossing,
                  uint triangle);
#include "surface_large.glsl"

void surfaceCross(SurfaceUniforms s, ivec2 pixel, uint at, SurfaceCrossing crossing,
                  uint triangle) {
  uint step_ = surfaceStep(s, crossing.depth);
  bool enters = crossing.facing > 0.0f;
  SurfaceCover cover = coverOf(at);
  if (enters ? cover.front == ~step_ : cover.back == step_) {
    atomicMax(faceWords[2u * at + (enters ? 0u : 1u)], triangle + 1u);
  }
}

void main() {
  coverSurface();
}
