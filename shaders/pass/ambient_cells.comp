// SPDX-License-Identifier: MIT
// Extinction and moments of the cells, from 8 parts of each; coarser levels from the finer. On the
// finest level the source begins as if the mean of the light outside were everywhere.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "ambient.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 3) const uint FIELD_COUNT = 1;
layout(set = 0, binding = 3) uniform sampler3D field0;
layout(set = 0, binding = 4) uniform sampler3D field1;
layout(set = 0, binding = 5) uniform sampler3D field2;
layout(set = 0, binding = 6) uniform sampler3D field3;
layout(set = 0, binding = 9) uniform sampler3D pages;
#include "fields.glsl"

const float EMPTY = 1.0e-12f;  // 1/m

void store(int level, int cell, float extinction, vec3 moments[4]) {
  for (int degree = 0; degree < 4; ++degree) {
    kept[momentAt(level, degree, cell)] =
        vec4(moments[degree], degree == 0 ? extinction : 0.0f);
  }
}

void finest(int cell) {
  ivec3 size = 2 * volume.size[0].xyz;
  ivec3 corner = 2 * cellOf(volume.size[0].xyz, cell);
  uint taps = uint(late(int(volume.peak.y)));
  vec4 beta = vec4(0.0f);
  for (int part = 0; part < 8; ++part) {
    ivec3 fine = corner + ivec3(part & 1, (part >> 1) & 1, part >> 2);
    for (uint tap = 0u; tap < taps * taps * taps; ++tap) {
      vec3 offset = (vec3(tap % taps, (tap / taps) % taps, tap / (taps * taps)) + 0.5f) /
                    float(taps);
      beta += fieldExtinction(boxOf((vec3(fine) + offset) / vec3(size)));
    }
  }
  beta /= float(8 * taps * taps * taps);
  float sum = beta.x + beta.y + beta.z + beta.w;
  // An empty cell next to a cloud takes part in interpolation.
  vec4 share = sum > EMPTY ? beta / sum : vec4(1.0f, 0.0f, 0.0f, 0.0f);
  vec3 moments[4];
  for (int degree = 0; degree < 4; ++degree) {
    moments[degree] =
        share.x * volume.moments[degree].xyz + share.y * volume.moments[4 + degree].xyz +
        share.z * volume.moments[8 + degree].xyz + share.w * volume.moments[12 + degree].xyz;
  }
  store(0, cell, sum * volume.peak.x, moments);
  vec3 mean = vec3(0.0f);
  for (int direction = 0; direction < AMBIENT_DIRECTIONS; ++direction) {
    mean += directionAt(0, direction).step_.w * volume.incoming[direction].xyz;
  }
  for (int term = 0; term < TRANSPORT_TERMS; ++term) {
    kept[sourceAt(0, term, cell)] = vec4(term == 0 ? moments[0] * mean : vec3(0.0f), 0.0f);
    work[driveAt(0, term, cell)] = vec4(0.0f);
  }
}

void coarser(int level, int cell) {
  ivec3 size = volume.size[level - 1].xyz;
  ivec3 corner = 2 * cellOf(volume.size[level].xyz, cell);
  ivec3 stride = strideOf(size);
  float beta = 0.0f;
  vec3 moments[4];
  for (int degree = 0; degree < 4; ++degree) {
    moments[degree] = vec3(0.0f);
  }
  for (int part = 0; part < 8; ++part) {
    ivec3 fine = corner + ivec3(part & 1, (part >> 1) & 1, part >> 2);
    int index = fine.x * stride.x + fine.y * stride.y + fine.z * stride.z;
    float here = kept[momentAt(level - 1, 0, index)].w + EMPTY;
    beta += here;
    for (int degree = 0; degree < 4; ++degree) {
      moments[degree] += here * kept[momentAt(level - 1, degree, index)].xyz;
    }
  }
  for (int degree = 0; degree < 4; ++degree) {
    moments[degree] /= beta;
  }
  store(level, cell, 0.125f * beta, moments);
}

void main() {
  int cell = int(gl_GlobalInvocationID.x);
  int level = int(push.level);
  if (cell >= volume.size[level].w) {
    return;
  }
  if (late(level == 0)) {
    finest(cell);
  } else {
    coarser(level, cell);
  }
}
