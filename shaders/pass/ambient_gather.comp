// SPDX-License-Identifier: MIT
// Harmonics of the radiance in each cell, and the source they scatter into.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "ambient.glsl"

layout(local_size_x = 64) in;

int degreeOf(int term) {
  return term >= 9 ? 3 : (term >= 4 ? 2 : (term >= 1 ? 1 : 0));
}

void main() {
  int level = int(push.level);
  int cell = int(gl_GlobalInvocationID.x);
  ivec3 size = volume.size[level].xyz;
  if (cell >= volume.size[level].w) {
    return;
  }
  ivec3 place = cellOf(size, cell);
  vec3 sum[TRANSPORT_TERMS];
  for (int term = 0; term < TRANSPORT_TERMS; ++term) {
    sum[term] = vec3(0.0f);
  }
  int direction = 0;
  do {
    TransportDirection d = directionAt(level, direction);
    Rays rays = raysAround(d, size, place);
    vec4 weight = rays.weight * d.step_.w;
    vec3 radiance = weight.x * work[radianceAt(level, direction, rays.index.x)].xyz +
                    weight.y * work[radianceAt(level, direction, rays.index.y)].xyz +
                    weight.z * work[radianceAt(level, direction, rays.index.z)].xyz +
                    weight.w * work[radianceAt(level, direction, rays.index.w)].xyz;
    for (int row = 0; row < 4; ++row) {
      vec4 y = volume.harmonics[direction * 4 + row];
      sum[row * 4 + 0] += y.x * radiance;
      sum[row * 4 + 1] += y.y * radiance;
      sum[row * 4 + 2] += y.z * radiance;
      sum[row * 4 + 3] += y.w * radiance;
    }
    direction += 1;
  } while (direction < AMBIENT_DIRECTIONS);

  if (late((push.flags & AMBIENT_ALONE) != 0u)) {
    vec3 mean = vec3(0.0f);
    for (int i = 0; i < AMBIENT_DIRECTIONS; ++i) {
      mean += directionAt(0, i).step_.w * volume.incoming[i].xyz;
    }
    kept[openAt(cell)] = vec4(min(sum[0] / max(mean, vec3(1.0e-30f)), vec3(1.0f)), 0.0f);
    return;
  }
  // The peak is a part of the whole phase function whose moments are all 1.
  float rest = late((push.flags & AMBIENT_WHOLE) != 0u) ? volume.peak.x : 1.0f;
  vec3 moments[4];
  for (int degree = 0; degree < 4; ++degree) {
    moments[degree] = rest * kept[momentAt(level, degree, cell)].xyz + (1.0f - rest);
  }
  for (int term = 0; term < TRANSPORT_TERMS; ++term) {
    vec3 now = moments[degreeOf(term)] * sum[term];
    int at = sourceAt(level, term, cell);
    work[changeAt(level, term, cell)] = vec4(now - kept[at].xyz, 0.0f);
    kept[at] = vec4(now, 0.0f);
  }
}
