// SPDX-License-Identifier: MIT
// The source of each cell in each direction, after the correction that the coarser level found.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "ambient.glsl"

layout(local_size_x = 64) in;

void main() {
  int level = int(push.level);
  int cell = int(gl_GlobalInvocationID.x);
  if (cell >= volume.size[level].w) {
    return;
  }
  bool corrected = late((push.flags & AMBIENT_COARSER) != 0u);
  ivec3 coarse = corrected ? volume.size[level + 1].xyz : ivec3(1);
  ivec3 stride = strideOf(coarse);
  vec3 at = 0.5f * (vec3(cellOf(volume.size[level].xyz, cell)) + 0.5f) - 0.5f;
  vec3 f = at - floor(at);
  ivec3 low = max(ivec3(floor(at)), ivec3(0));
  ivec3 high = min(ivec3(floor(at)) + 1, coarse - 1);
  vec3 source[TRANSPORT_TERMS];
  for (int term = 0; term < TRANSPORT_TERMS; ++term) {
    int own = sourceAt(level, term, cell);
    source[term] = kept[own].xyz;
    if (corrected) {
      vec3 sum = vec3(0.0f);
      for (int corner = 0; corner < 8; ++corner) {
        ivec3 side = ivec3(corner & 1, (corner >> 1) & 1, corner >> 2);
        ivec3 c = low + side * (high - low);
        vec3 w = mix(1.0f - f, f, vec3(side));
        int index = c.x * stride.x + c.y * stride.y + c.z * stride.z;
        sum += w.x * w.y * w.z * kept[sourceAt(level + 1, term, index)].xyz;
      }
      source[term] += sum;
      kept[own] = vec4(source[term], 0.0f);
    }
    source[term] += work[driveAt(level, term, cell)].xyz;
  }
  int direction = 0;
  do {
    vec3 sum = vec3(0.0f);
    for (int row = 0; row < 4; ++row) {
      vec4 y = volume.harmonics[direction * 4 + row];
      sum += y.x * source[row * 4] + y.y * source[row * 4 + 1] + y.z * source[row * 4 + 2] +
             y.w * source[row * 4 + 3];
    }
    work[directedAt(level, direction, cell)] = vec4(sum, 0.0f);
    direction += 1;
  } while (direction < AMBIENT_DIRECTIONS);
}
