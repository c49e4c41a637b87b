// SPDX-License-Identifier: MIT
// surface_light.glsl over a plain buffer: the source's image, its curves, then rows of 8 numbers.
// Its samplers are numbers here, and filters are written out; the light maps are formulas, the same
// as in surface_light_test.cpp.
#version 460
#extension GL_GOOGLE_include_directive : require
#define real float
const bool AIR_ENABLED = true;
const bool FOG_ENABLED = true;
const bool ABSORBER_ENABLED = true;
layout(local_size_x = 64) in;
#include "model/model.glsl"
layout(set = 0, binding = 0, std430) readonly buffer Input { float data[]; };
layout(set = 0, binding = 1, std430) writeonly buffer Output { float results[]; };

const int CURVES = 4 * SOURCE_SIZE.x * SOURCE_SIZE.y * SOURCE_SIZE.z;
const int ROWS = CURVES + 181 * SURFACE_SETS;
const int COLUMNS_MAP = 0;
const int FACES_MAP = 1;
const int CURVES_MAP = 2;

vec4 four(int i) {
  return vec4(data[4 * i], data[4 * i + 1], data[4 * i + 2], data[4 * i + 3]);
}

vec4 texel(ivec3 i) {
  ivec3 c = clamp(i, ivec3(0), SOURCE_SIZE - 1);
  return four((c.z * SOURCE_SIZE.y + c.y) * SOURCE_SIZE.x + c.x);
}

vec4 textureLod(uint source, vec3 place, float level) {
  vec3 at = place * vec3(SOURCE_SIZE) - 0.5;
  vec3 low = floor(at);
  vec3 part = at - low;
  vec4 sum = vec4(0.0);
  for (int k = 0; k < 8; ++k) {
    ivec3 corner = ivec3(k & 1, k >> 1 & 1, k >> 2);
    vec3 weight = mix(1.0 - part, part, vec3(corner));
    sum += weight.x * weight.y * weight.z * texel(ivec3(low) + corner);
  }
  return sum;
}

vec4 atLevel(int map, vec2 place, float level) {
  float coverage = 1.0 / (1.0 + 0.1 * level);
  float slope = 0.6 * place.x / (1.0 + level);
  return coverage * (map == COLUMNS_MAP ? vec4(1.0, 20.0 * place.y + level, slope, 0.1)
                                        : vec4(0.8, 0.2, slope, 5.0 + level));
}

// Linear between whole levels, as of a sampler.
vec4 textureLod(int map, vec2 place, float level) {
  if (map == CURVES_MAP) {
    float at = place.x * 181.0 - 0.5;
    int low = clamp(int(at), 0, 179);
    int first = CURVES / 4 + int(place.y * 2.0) * 181 + low;
    return mix(four(first), four(first + 1), at - float(low));
  }
  float low = floor(level);
  return mix(atLevel(map, place, low), atLevel(map, place, low + 1.0), level - low);
}

#define sampler2D int
#define sampler3D uint
#include "pass/surface_light.glsl"

void main() {
  uint i = gl_GlobalInvocationID.x;
  int row = ROWS + 8 * int(i);
  SurfaceMap map;
  map.texel = data[row + 6];
  map.levels = 20.0;
  map.extinction = data[row + 7];
  vec4 left[8];
  for (int set = 0; set < 8; ++set) {
    left[set] = vec4(1.0);
  }
  results[i] = surfaceScattered(COLUMNS_MAP, FACES_MAP, 0u, CURVES_MAP, map,
                                vec2(data[row], data[row + 1]), 8.0, data[row + 2],
                                vec3(data[row + 3], data[row + 4], data[row + 5]), left)
                   .x;
}
