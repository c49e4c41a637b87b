// SPDX-License-Identifier: MIT
// What each cell scatters towards the eye of light scattered before, 1/sr per unit irradiance, and
// its extinction (1/m):
// light scattered once and twice by products of phase functions, over pairShape, and the rest, by
// its harmonics, in the second half of the image; of a layer as the sum of all but the zonal ones,
// then those of degree 1, 2 and 4.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "transport.glsl"
#include "../interface/slices.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 7, std430) readonly buffer Pairs { vec4 pairs[]; };
layout(set = 0, binding = 8, rgba32f) uniform image3D viewSource;
layout(set = 0, binding = 9, std140) uniform View { VolumeUniforms view; };

#define PAIR_SHAPE view.pairShape
#include "pair_shape.glsl"

vec3 pair(int function, float x) {
  int node = min(int(x), PAIR_TABLE_NODES - 2);
  int at = function * PAIR_TABLE_NODES + node;
  return mix(pairs[at].xyz, pairs[at + 1].xyz, x - float(node));
}

// Light of a layer scattered once and twice, scattered to direction d again: the pair of phase
// functions times the mean, over what they pass on, of what the place makes of it.
vec3 layerFirst(int cell, vec3 d, float node) {
  float u = acos(clamp(d.z, -1.0f, 1.0f)) * (float(RESPONSE_ZENITHS - 1) / 3.14159265f);
  float azimuth = abs(d.x) + abs(d.y) > 1.0e-12f ? atan(d.y, d.x) : 0.0f;
  float side = azimuth < 0.0f ? -1.0f : 1.0f;
  float w = abs(azimuth) * (float(RESPONSE_AZIMUTHS - 1) / 3.14159265f);
  int i = clamp(int(u), 0, RESPONSE_ZENITHS - 2);
  int k = clamp(int(w), 0, RESPONSE_AZIMUTHS - 2);
  vec2 f = clamp(vec2(u - float(i), w - float(k)), 0.0f, 1.0f);
  vec4 weights = vec4((1.0f - f.x) * (1.0f - f.y), f.x * (1.0f - f.y), (1.0f - f.x) * f.y,
                      f.x * f.y);
  vec3 sum = vec3(0.0f);
  for (int order = 0; order < 2; ++order) {
    ivec4 at = ivec4(responseAt(i * RESPONSE_AZIMUTHS + k, order),
                     responseAt((i + 1) * RESPONSE_AZIMUTHS + k, order),
                     responseAt(i * RESPONSE_AZIMUTHS + k + 1, order),
                     responseAt((i + 1) * RESPONSE_AZIMUTHS + k + 1, order));
    float part = 0.0f;
    for (int term = 0; term < FIRST_TERMS; ++term) {
      float response = dot(weights, vec4(kept[at.x + term], kept[at.y + term],
                                         kept[at.z + term], kept[at.w + term]));
      // Those of sin(azimuth) are odd.
      response *= term == 9 || term == 11 ? side : 1.0f;
      part += response * kept[firstAt(order * FIRST_TERMS + term, cell)];
    }
    sum += max(part, 0.0f) * pair(order * 6, node);
  }
  return sum;
}

void main() {
  int cell = int(gl_GlobalInvocationID.x);
  ivec3 size = volume.size[0].xyz;
  if (cell >= volume.size[0].w) {
    return;
  }
  ivec3 place = cellOf(size, cell);
  vec3 box = boxOf((vec3(place) + 0.5f) / vec3(size));
  vec3 toEye = view.boxFromEye[3].xyz - box;
  vec3 v = volume.worldFromBox[0].xyz * toEye.x + volume.worldFromBox[1].xyz * toEye.y +
           volume.worldFromBox[2].xyz * toEye.z;
  v *= inversesqrt(max(dot(v, v), 1.0e-30f));
  vec3 d = vec3(dot(volume.lightFrame[0].xyz, v), dot(volume.lightFrame[1].xyz, v),
                clamp(dot(volume.lightFrame[2].xyz, v), -1.0f, 1.0f));
  float x = d.x;
  float y = d.y;
  float z = d.z;

  bool layer = isLayer();
  float towards = clamp(dot(volume.travel.xyz, d), -1.0f, 1.0f);
  float node = acos(towards) * (float(PAIR_TABLE_NODES - 1) / 3.14159265f);
  float s2 = max(x * x + y * y, 1.0e-20f);
  vec2 one = vec2(x, y) * inversesqrt(s2);                      // cos and sin of the azimuth
  vec2 two = vec2(x * x - y * y, 2.0f * x * y) / s2;            // of twice the azimuth
  vec3 first = vec3(0.0f);
  for (int order = 0; order < (layer ? 0 : 2); ++order) {
    int term = order * FIRST_TERMS;
    int f = order * 6;
    first += kept[firstAt(term, cell)] * pair(f, node) +
             kept[firstAt(term + 2, cell)] * pair(f + 1, node) +
             (kept[firstAt(term + 3, cell)] * one.x + kept[firstAt(term + 1, cell)] * one.y) *
                 pair(f + 2, node) +
             kept[firstAt(term + 6, cell)] * pair(f + 3, node) +
             (kept[firstAt(term + 7, cell)] * one.x + kept[firstAt(term + 5, cell)] * one.y) *
                 pair(f + 4, node) +
             (kept[firstAt(term + 8, cell)] * two.x + kept[firstAt(term + 4, cell)] * two.y) *
                 pair(f + 5, node);
  }
  if (layer) {
    first = layerFirst(cell, d, node);
  }
  first *= kept[momentAt(0, 0, cell)];

  // Of a layer each ray adds for its own direction what depends on the angle to the plane alone:
  // cells are wide, and an eye near them sees their middles from elsewhere (gridSource).
  float own = layer ? 0.0f : 1.0f;
  float rest = kept[sourceAt(0, 0, cell)] + 1.7320508f * (y * kept[sourceAt(0, 1, cell)] +
                                                            own * z * kept[sourceAt(0, 2, cell)] +
                                                            x * kept[sourceAt(0, 3, cell)]);
  rest += 3.8729833f * (x * y * kept[sourceAt(0, 4, cell)] + y * z * kept[sourceAt(0, 5, cell)] +
                        x * z * kept[sourceAt(0, 7, cell)] +
                        0.5f * (x * x - y * y) * kept[sourceAt(0, 8, cell)]);
  rest += own * 1.1180340f * (3.0f * z * z - 1.0f) * kept[sourceAt(0, 6, cell)];
  rest += 2.0916501f * x * (x * x - 3.0f * y * y) * kept[sourceAt(0, 15, cell)];
  rest += own * 2.0916501f * y * (3.0f * x * x - y * y) * kept[sourceAt(0, 9, cell)];
  // In a layer terms 10 and 11 are Y(4, 1) and Y(4, 2).
  float z2 = z * z;
  rest += (layer ? 2.3717082f * x * z * (7.0f * z2 - 3.0f) : 10.2469508f * x * y * z) *
          kept[sourceAt(0, LAYER_FOURTH + 1, cell)];
  rest += (layer ? 1.6770510f * (x * x - y * y) * (7.0f * z2 - 1.0f)
                 : 1.6201852f * y * (5.0f * z2 - 1.0f)) *
          kept[sourceAt(0, LAYER_FOURTH + 2, cell)];
  rest += 5.1234754f * z * (x * x - y * y) * kept[sourceAt(0, 14, cell)];
  rest += 1.6201852f * (5.0f * z2 - 1.0f) * x * kept[sourceAt(0, 13, cell)];
  rest += 1.3228757f * z * (5.0f * z * z - 3.0f) * kept[sourceAt(0, 12, cell)];

  vec4 all = vec4(rest, kept[sourceAt(0, 2, cell)], kept[sourceAt(0, 6, cell)],
                  kept[sourceAt(0, LAYER_FOURTH, cell)]);
  // Where one of the two is negative, by rounding of what is sharp, the other makes up for it.
  vec3 few = max(first + min(rest, 0.0f), vec3(0.0f)) * 0.0795774715f;
  all = layer ? all : vec4(max(vec3(rest) + min(first, vec3(0.0f)), vec3(0.0f)), 0.0f);
  all *= 0.0795774715f;
  few = layer ? first * 0.0795774715f : few;
  few /= pairShape(towards);
  vec4 shown = vec4(few, kept[extinctionAt(0, cell)]);
  // Filters read the cell after the last one, too, with weight 0 or nearly so: what stands there
  // may be of another volume or no number.
  ivec3 room = imageSize(viewSource) / ivec3(1, 1, 2);
  if (late(push.weight < 1.0f)) {
    shown = mix(imageLoad(viewSource, place), shown, push.weight);
    all = mix(imageLoad(viewSource, place + ivec3(0, 0, room.z)), all, push.weight);
  }
  ivec3 more = min(ivec3(equal(place + 1, size)), room - size);
  for (int k = 0; k <= more.z; ++k) {
    for (int j = 0; j <= more.y; ++j) {
      for (int i = 0; i <= more.x; ++i) {
        ivec3 at = place + ivec3(i, j, k);
        imageStore(viewSource, at, shown);
        imageStore(viewSource, at + ivec3(0, 0, room.z), all);
      }
    }
  }
}
