// SPDX-License-Identifier: MIT
// Extinction, light and moments of the cells, from 8 parts of each; coarser levels from the finer.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "transport.glsl"

layout(local_size_x = 64) in;
layout(constant_id = 3) const uint FIELD_COUNT = 1;
layout(set = 0, binding = 3) uniform sampler3D field0;
layout(set = 0, binding = 4) uniform sampler3D field1;
layout(set = 0, binding = 5) uniform sampler3D field2;
layout(set = 0, binding = 6) uniform sampler3D field3;
layout(set = 0, binding = 10) uniform sampler3D pages;
#include "fields.glsl"

float depthAt(int index) {
  return swept[radianceAt(0, 0, index)];
}

void storeMoments(int level, int cell, vec4 moments, float fourth) {
  kept[momentAt(level, 4, cell)] = fourth;
  for (int degree = 0; degree < 4; ++degree) {
    kept[momentAt(level, degree, cell)] = moments[degree];
  }
}

vec4 momentsOf(int level, int cell) {
  return vec4(kept[momentAt(level, 0, cell)], kept[momentAt(level, 1, cell)],
              kept[momentAt(level, 2, cell)], kept[momentAt(level, 3, cell)]);
}

void finest(int cell) {
  ivec3 size = 2 * volume.size[0].xyz;
  ivec3 corner = 2 * cellOf(volume.size[0].xyz, cell);
  uint taps = uint(late(int(volume.peak.y)));
  vec4 beta = vec4(0.0f);
  float lit = 0.0f;
  float light = 0.0f;
  vec4 scattered = vec4(volume.fieldMoments[0].x, volume.fieldMoments[1].x,
                        volume.fieldMoments[2].x, volume.fieldMoments[3].x);
  for (int part = 0; part < 8; ++part) {
    ivec3 fine = corner + ivec3(part & 1, (part >> 1) & 1, part >> 2);
    vec4 here = vec4(0.0f);
    for (uint tap = 0u; tap < taps * taps * taps; ++tap) {
      vec3 offset = (vec3(tap % taps, (tap / taps) % taps, tap / (taps * taps)) + 0.5f) /
                    float(taps);
      here += fieldExtinction(boxOf((vec3(fine) + offset) / vec3(size)));
    }
    here /= float(taps * taps * taps);
    Rays rays = raysAround(volume.light, size, fine);
    float depth = rays.weight.x * depthAt(rays.index.x) + rays.weight.y * depthAt(rays.index.y) +
                  rays.weight.z * depthAt(rays.index.z) + rays.weight.w * depthAt(rays.index.w);
    // Mean over the part's own depth, of which one half lies before its middle.
    float own = dot(here, vec4(1.0f)) * volume.light.step_.z * volume.peak.x;
    float before = max(depth * volume.peak.x - 0.5f * own, 0.0f);
    float mean = own > 1.0e-2f ? (1.0f - exp(-own)) / own : 1.0f - own * (0.5f - own / 6.0f);
    float passed = mean * exp(-min(before, 80.0f));
    beta += here;
    lit += dot(here, scattered) * passed;
    light += passed;
  }
  beta *= 0.125f;
  float sum = beta.x + beta.y + beta.z + beta.w;
  // An empty cell next to a cloud takes part in interpolation: it has the light of its place.
  float first = sum > 1.0e-12f ? 0.125f * lit / sum : 0.125f * light * scattered.x;
  vec4 moments = volume.fieldMoments[0];
  float fourth = volume.fieldFourth.x;
  if (sum > 1.0e-12f) {
    fourth = dot(volume.fieldFourth, beta) / sum;
    moments = (volume.fieldMoments[0] * beta.x + volume.fieldMoments[1] * beta.y +
               volume.fieldMoments[2] * beta.z + volume.fieldMoments[3] * beta.w) / sum;
  }
  kept[extinctionAt(0, cell)] = sum * volume.peak.x;
  kept[lightAt(0, cell)] = first;
  storeMoments(0, cell, moments, fourth);
}

void coarser(int level, int cell) {
  ivec3 size = volume.size[level - 1].xyz;
  ivec3 corner = 2 * cellOf(volume.size[level].xyz, cell);
  ivec3 stride = strideOf(size);
  float beta = 0.0f;
  float lit = 0.0f;
  float light = 0.0f;
  vec4 moments = vec4(0.0f);
  vec4 plain = vec4(0.0f);
  vec2 fourth = vec2(0.0f);  // weighted, plain
  for (int part = 0; part < 8; ++part) {
    ivec3 fine = corner + ivec3(part & 1, (part >> 1) & 1, part >> 2);
    int index = fine.x * stride.x + fine.y * stride.y + fine.z * stride.z;
    float here = kept[extinctionAt(level - 1, index)];
    vec4 own = momentsOf(level - 1, index);
    float first = kept[lightAt(level - 1, index)];
    beta += here;
    lit += here * first;
    light += first;
    moments += here * own;
    plain += own;
    fourth += vec2(here, 1.0f) * kept[momentAt(level - 1, 4, index)];
  }
  kept[extinctionAt(level, cell)] = 0.125f * beta;
  kept[lightAt(level, cell)] = beta > 1.0e-12f ? lit / beta : 0.125f * light;
  storeMoments(level, cell, beta > 1.0e-12f ? moments / beta : 0.125f * plain,
               beta > 1.0e-12f ? fourth.x / beta : 0.125f * fourth.y);
}

void main() {
  int cell = threadOfStep();
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
