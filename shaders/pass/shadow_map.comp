// SPDX-License-Identifier: MIT
// Optical depth of one volume along the light, for each texel that it may cover, added to that of
// the volumes before it: Beer and Lambert's law, by the midpoint rule, one sample per voxel. For
// layers also mean and spread of the depth d at which the extinction lies, merged as in Chan, Golub
// and LeVeque (1983): nothing cancels.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common.glsl"
#include "../interface/shadow_map.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 3) const uint FIELD_COUNT = 1;

layout(set = 0, binding = 0, std140) uniform Volume { ShadowVolume volumeBlock; };
ShadowVolume volume = volumeBlock;
// Per texel the optical depth, or that, mean of d and optical depth times variance of d, and, if
// asked for, the optical depth of absorption.
layout(set = 0, binding = 1, std430) buffer Sums { float sums[]; };
layout(set = 0, binding = 3) uniform sampler3D field0;
layout(set = 0, binding = 4) uniform sampler3D field1;
layout(set = 0, binding = 5) uniform sampler3D field2;
layout(set = 0, binding = 6) uniform sampler3D field3;
layout(set = 0, binding = 7) uniform sampler3D pages;
layout(push_constant) uniform Push { ShadowConstants mapBlock; };
ShadowConstants map = mapBlock;

#include "fields.glsl"

// Optical depth that one sample of a layer counts at most: opaque, and times the square of any
// distance a float.
const float LAYER_OPAQUE = 1.0e6f;

void main() {
  uvec2 offset = tileOf(gl_WorkGroupID.xy, gl_NumWorkGroups.xy) * 8u + gl_LocalInvocationID.xy;
  uvec2 texel = uvec2(volume.rect.xy) + offset;
  if (texel.x >= uint(volume.rect.z) || texel.y >= uint(volume.rect.w)) {
    return;
  }
  vec2 uv = (vec2(texel) + 0.5f) / vec2(float(map.width), float(map.height));
  vec3 base = volume.origin.xyz + uv.x * volume.acrossU.xyz + uv.y * volume.acrossV.xyz;
  Span inside = rayBox(base, volume.along.xyz, vec3(0.0f), vec3(1.0f));
  float stretch = inside.end - inside.begin;
  if (!(stretch > 0.0f)) {
    return;
  }
  float count = clamp(ceil(stretch * volume.origin.w), 1.0f, volume.acrossU.w);
  float dt = stretch / count;
  float depth = 0.0f;
  float first = 0.0f;
  float second = 0.0f;
  float absorbed = 0.0f;
  float most = (map.flags & SHADOW_LAYER) != 0u ? LAYER_OPAQUE : 3.0e38f;
  float k = 0.5f;
  while (k < count) {  // tested in front, as in eye_march.comp
    float d = inside.begin + k * dt;
    vec4 extinction = fieldExtinction(base + d * volume.along.xyz);
    float part = min(dot(extinction, volume.weight) * dt, most);
    absorbed += dot(extinction, volume.absorbed) * dt;
    depth += part;
    first += part * d;
    second += part * d * d;
    k += 1.0f;
  }
  if (!(depth > 0.0f)) {
    return;
  }
  uint at = texel.y * map.width + texel.x;
  if ((map.flags & SHADOW_LAYER) == 0u) {
    sums[at] += depth;
    return;
  }
  bool more = (map.flags & SHADOW_ABSORBED) != 0u;
  at *= more ? 4u : 3u;
  float mean = first / depth;
  // Samples stand for stretches: dt^2 / 12 is the variance inside one.
  float spread = max(second - first * mean, 0.0f) + depth * dt * dt / 12.0f;
  mean += volume.acrossV.w;
  float other = sums[at];
  float sum = depth + other;
  float apart = mean - sums[at + 1u];
  sums[at] = sum;
  sums[at + 1u] += apart * (depth / sum);
  sums[at + 2u] += spread + apart * apart * depth * (other / sum);
  if (more) {
    sums[at + 3u] += absorbed;
  }
}
