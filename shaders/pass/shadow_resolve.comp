// SPDX-License-Identifier: MIT
// What shadow_map.comp added up, as the engine wants it: optical depth, transmittance, or a layer
// of even extinction with the same optical depth, mean and variance: its ends are sqrt(3) standard
// deviations away from its middle.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "../interface/shadow_map.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 1, std430) readonly buffer Sums { float sums[]; };
layout(set = 0, binding = 2) uniform writeonly image2D target;
layout(push_constant) uniform Push { ShadowConstants mapBlock; };
ShadowConstants map = mapBlock;

const float LARGEST_HALF = 65504.0f;

#include "half_float.glsl"

vec3 rounded(vec3 v) {
  bool half_ = (map.flags & SHADOW_HALF) != 0u;
  return half_ ? roundedToHalf(clamp(v, vec3(-LARGEST_HALF), vec3(LARGEST_HALF))) : v;
}

// First of a texel's sums.
uint sumsOf(ivec2 texel) {
  uint each = (map.flags & SHADOW_ABSORBED) != 0u ? 4u : 3u;
  return each * (uint(texel.y) * map.width + uint(texel.x));
}

// Optical depth and ends of the layer.
vec3 layerAt(ivec2 texel) {
  uint at = sumsOf(texel);
  float depth = sums[at];
  float half_ = depth > 0.0f ? sqrt(3.0f * sums[at + 2u] / depth) : 0.0f;
  return vec3(depth, sums[at + 1u] - half_, sums[at + 1u] + half_);
}

// Of an empty texel, so that filters find ends in all four: the mean of its neighbours'.
vec2 endsAround(ivec2 texel) {
  vec3 sum = vec3(0.0f);
  for (uint k = 0u; k < 9u; ++k) {
    ivec2 beside = texel + ivec2(k % 3u, k / 3u) - 1;
    beside = clamp(beside, ivec2(0), ivec2(map.width, map.height) - 1);
    vec3 layer = layerAt(beside);
    sum += layer.x > 0.0f ? vec3(1.0f, layer.yz) : vec3(0.0f);
  }
  return sum.yz / max(sum.x, 1.0f);
}

void main() {
  uvec2 texel = gl_GlobalInvocationID.xy;
  if (texel.x >= map.width || texel.y >= map.height) {
    return;
  }
  uint at = texel.y * map.width + texel.x;
  if ((map.flags & SHADOW_LAYER) != 0u) {
    vec3 layer = layerAt(ivec2(texel));
    if (!(layer.x > 0.0f)) {
      layer = vec3(0.0f, endsAround(ivec2(texel)));
    }
    bool more = (map.flags & SHADOW_ABSORBED) != 0u;
    float absorbed = more ? sums[sumsOf(ivec2(texel)) + 3u] : 0.0f;
    imageStore(target, ivec2(texel), vec4(rounded(layer), absorbed));
  } else if ((map.flags & SHADOW_COLOR) != 0u) {
    imageStore(target, ivec2(texel), vec4(rounded(vec3(exp(-min(sums[at], 80.0f)))), 1.0f));
  } else {
    imageStore(target, ivec2(texel), vec4(rounded(vec3(sums[at])), 1.0f));
  }
}
