// SPDX-License-Identifier: MIT
// How much of each cell over a mesh's box is cloud, from a picture along the cells' columns: what a
// crossing adds to its cell and to the one before, for surface_shell.comp to sum from the far end.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common.glsl"

layout(local_size_x = 64) in;
#include "surface_mesh.glsl"
layout(set = 0, binding = 24, std430) buffer Cells { int cells[]; };

void surfaceCross(SurfaceUniforms s, ivec2 pixel, uint at, SurfaceCrossing crossing,
                  uint triangle);
#include "surface_large.glsl"

void surfaceCross(SurfaceUniforms s, ivec2 pixel, uint at, SurfaceCrossing crossing,
                  uint triangle) {
  ivec3 count = ivec3(s.cells.xyz);
  float depth = clamp(crossing.depth, 0.0f, float(count.y) - 0.001f);
  int cell = int(depth);
  int part = int((depth - float(cell)) * float(SHELL_FULL) + 0.5f);
  int sign_ = crossing.facing > 0.0f ? -1 : 1;
  ivec2 column = pixel / int(SHELL_PIXELS);
  int index = (column.y * count.y + cell) * count.x + column.x;
  atomicAdd(cells[index], sign_ * part);
  if (cell > 0) {
    atomicAdd(cells[index - count.x], sign_ * (int(SHELL_FULL) - part));
  }
}

void main() {
  coverSurface();
}
