// SPDX-License-Identifier: MIT
// Depth under the surface of a mesh's cells, in cells and SHELL_OUTSIDE more, so that it is 0 in
// the outermost: sums along columns, then means over neighbours.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 3) const bool MEANS = false;
#include "surface_mesh.glsl"
layout(set = 0, binding = 24, std430) buffer Cells { int cells[]; };
layout(set = 0, binding = 27, std430) writeonly buffer ShellWords { uint shellWords[]; };

float filledAt(ivec3 cell, ivec3 count, int all_) {
  bool there = all(greaterThanEqual(cell, ivec3(0))) && all(lessThan(cell, count));
  int index = (cell.z * count.y + cell.y) * count.x + cell.x;
  return there ? intBitsToFloat(cells[all_ + index]) : 0.0f;
}

void main() {
  ivec3 count = ivec3(surface.cells.xyz);
  int all_ = count.x * count.y * count.z;
  ivec3 at = ivec3(gl_GlobalInvocationID);
  if (!MEANS) {
    if (at.x < count.x && at.y < count.z) {
      const float SCALE = 1.0f / float(SHELL_FULL * SHELL_PIXELS * SHELL_PIXELS);
      int sum = 0;
      for (int y = count.y - 1; y >= 0; --y) {
        int index = (at.y * count.y + y) * count.x + at.x;
        sum += cells[index];
        cells[all_ + index] = floatBitsToInt(clamp(float(sum) * SCALE, 0.0f, 1.0f));
      }
    }
    return;
  }
  if (all(lessThan(at, count))) {
    float sum = 0.0f;
    for (int z = -1; z <= 1; ++z) {
      for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
          ivec3 to = ivec3(x, y, z);
          ivec3 weight = 2 - abs(to);
          sum += float(weight.x * weight.y * weight.z) * filledAt(at + to, count, all_);
        }
      }
    }
    uint index = uint((at.z * count.y + at.y) * count.x + at.x);
    uint row = uint(count.x);
    uint depth = floatBitsToUint(SHELL_OUTSIDE + shellDepth(sum / 64.0f));
    shellWords[4u * index] = depth;
    if (at.x > 0) {
      shellWords[4u * (index - 1u) + 1u] = depth;
    }
    if (at.y > 0) {
      shellWords[4u * (index - row) + 2u] = depth;
    }
    if (at.x > 0 && at.y > 0) {
      shellWords[4u * (index - row - 1u) + 3u] = depth;
    }
  }
}
