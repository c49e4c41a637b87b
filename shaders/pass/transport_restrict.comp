// SPDX-License-Identifier: MIT
// The change of the finer level's source drives the coarser level, which starts from nothing.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "transport.glsl"

layout(local_size_x = 64) in;

void main() {
  int level = int(push.level);  // the coarser one
  int cell = int(gl_GlobalInvocationID.x);
  int term = rowOfStep();
  if (cell >= volume.size[level].w) {
    return;
  }
  ivec3 corner = 2 * cellOf(volume.size[level].xyz, cell);
  ivec3 stride = strideOf(volume.size[level - 1].xyz);
  float sum = 0.0f;
  float weight = 0.0f;
  for (int part = 0; part < 8; ++part) {
    ivec3 fine = corner + ivec3(part & 1, (part >> 1) & 1, part >> 2);
    int index = fine.x * stride.x + fine.y * stride.y + fine.z * stride.z;
    float here = kept[extinctionAt(level - 1, index)] + 1.0e-12f;
    weight += here;
    sum += here * work[changeAt(level - 1, term, index)];
  }
  work[driveAt(level, term, cell)] = sum / weight;
  kept[sourceAt(level, term, cell)] = 0.0f;
}
