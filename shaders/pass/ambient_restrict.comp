// SPDX-License-Identifier: MIT
// What a round has changed on the finer level drives the coarser one: the mean over its cells, by
// extinction.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "ambient.glsl"

layout(local_size_x = 64) in;

void main() {
  int level = int(push.level);  // the coarser one
  int cell = int(gl_GlobalInvocationID.x);
  int term = int(gl_WorkGroupID.y);
  if (cell >= volume.size[level].w) {
    return;
  }
  ivec3 corner = 2 * cellOf(volume.size[level].xyz, cell);
  ivec3 stride = strideOf(volume.size[level - 1].xyz);
  vec3 sum = vec3(0.0f);
  float weight = 0.0f;
  for (int part = 0; part < 8; ++part) {
    ivec3 fine = corner + ivec3(part & 1, (part >> 1) & 1, part >> 2);
    int index = fine.x * stride.x + fine.y * stride.y + fine.z * stride.z;
    float here = kept[momentAt(level - 1, 0, index)].w + 1.0e-12f;
    weight += here;
    sum += here * work[changeAt(level - 1, term, index)].xyz;
  }
  work[driveAt(level, term, cell)] = vec4(sum / weight, 0.0f);
  kept[sourceAt(level, term, cell)] = vec4(0.0f);
}
