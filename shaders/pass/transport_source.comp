// SPDX-License-Identifier: MIT
// The source of each cell in each direction, after the correction that the coarser level found.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "transport.glsl"

layout(local_size_x = 64) in;

void main() {
  int level = int(push.level);
  int cell = threadOfStep();
  if (cell >= volume.size[level].w) {
    return;
  }
  int directions = volume.place[level].y;
  if (late((push.flags & TRANSPORT_SECOND_SWEEP) != 0u)) {
    bool layer = isLayer();
    vec4 a = vec4(kept[firstAt(0, cell)], kept[firstAt(1, cell)], kept[firstAt(2, cell)],
                  kept[firstAt(3, cell)]);
    vec4 b = vec4(kept[firstAt(4, cell)], kept[firstAt(5, cell)], kept[firstAt(6, cell)],
                  kept[firstAt(7, cell)]);
    vec4 c = vec4(kept[firstAt(8, cell)], kept[firstAt(9, cell)], kept[firstAt(10, cell)],
                  kept[firstAt(11, cell)]);
    c.yzw = layer ? c.yzw : vec3(0.0f);
    float scattered = kept[momentAt(level, 0, cell)];
    int of = 0;
    do {
      vec4 x = volume.rows[FIRST_ROWS + of * 3];
      vec4 y = volume.rows[FIRST_ROWS + of * 3 + 1];
      vec4 z = volume.rows[FIRST_ROWS + of * 3 + 2];
      if (layer) {
        int at = responseAt(RESPONSE_NODES + of, 0);
        x = vec4(kept[at], kept[at + 1], kept[at + 2], kept[at + 3]);
        y = vec4(kept[at + 4], kept[at + 5], kept[at + 6], kept[at + 7]);
        z = vec4(kept[at + 8], kept[at + 9], kept[at + 10], kept[at + 11]);
      }
      work[directedAt(level, of, cell)] =
          max(scattered * (dot(a, x) + dot(b, y) + dot(c, z)), 0.0f);
      of += 1;
    } while (of < directions);
    return;
  }
  bool corrected = late((push.flags & TRANSPORT_COARSER) != 0u);
  ivec3 coarse = corrected ? volume.size[level + 1].xyz : ivec3(1);
  ivec3 stride = strideOf(coarse);
  vec3 at = 0.5f * (vec3(cellOf(volume.size[level].xyz, cell)) + 0.5f) - 0.5f;
  vec3 f = at - floor(at);
  ivec3 low = max(ivec3(floor(at)), ivec3(0));
  ivec3 high = min(ivec3(floor(at)) + 1, coarse - 1);
  float source[TRANSPORT_TERMS];
  for (int term = 0; term < TRANSPORT_TERMS; ++term) {
    int own = sourceAt(level, term, cell);
    source[term] = kept[own];
    if (corrected) {
      float sum = 0.0f;
      for (int corner = 0; corner < 8; ++corner) {
        ivec3 side = ivec3(corner & 1, (corner >> 1) & 1, corner >> 2);
        ivec3 c = low + side * (high - low);
        vec3 w = mix(1.0f - f, f, vec3(side));
        int index = c.x * stride.x + c.y * stride.y + c.z * stride.z;
        sum += w.x * w.y * w.z * kept[sourceAt(level + 1, term, index)];
      }
      source[term] += sum;
      kept[own] = source[term];
    }
    source[term] += work[driveAt(level, term, cell)];
  }
  int direction = 0;
  do {
    float sum = 0.0f;
    for (int row = 0; row < 4; ++row) {
      vec4 y = volume.rows[direction * 4 + row];
      sum += y.x * source[row * 4] + y.y * source[row * 4 + 1] + y.z * source[row * 4 + 2] +
             y.w * source[row * 4 + 3];
    }
    work[directedAt(level, direction, cell)] = sum;
    direction += 1;
  } while (direction < directions);
}
