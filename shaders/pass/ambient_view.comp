// SPDX-License-Identifier: MIT
// What each cell scatters towards the eye of the light of sky and ground, as radiance: times the
// extinction it is emitted on a metre.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "ambient.glsl"
#include "../interface/slices.glsl"

layout(local_size_x = 64) in;
layout(set = 0, binding = 7, rgba32f) uniform writeonly image3D viewAmbient;
layout(set = 0, binding = 8, std140) uniform View { VolumeUniforms view; };

// In direction v, linear between the table's.
vec3 fineAt(vec3 v) {
  float zenith = acos(clamp(v.y, -1.0f, 1.0f)) * (float(FINE_ZENITHS) / 3.14159265f) - 0.5f;
  float azimuth = atan(v.z, abs(v.x) + abs(v.z) > 0.0f ? v.x : 1.0f) *
                  (0.5f * float(FINE_AZIMUTHS) / 3.14159265f) + 1.5f * float(FINE_AZIMUTHS) - 0.5f;
  vec2 at = vec2(azimuth, clamp(zenith, 0.0f, float(FINE_ZENITHS - 1)));
  ivec2 low = ivec2(at);
  vec2 f = at - vec2(low);
  int a = int(uint(low.x) % uint(FINE_AZIMUTHS));
  int b = int(uint(low.x + 1) % uint(FINE_AZIMUTHS));
  int top = low.y * FINE_AZIMUTHS;
  int under = min(low.y + 1, FINE_ZENITHS - 1) * FINE_AZIMUTHS;
  return mix(mix(volume.fine[top + a].xyz, volume.fine[top + b].xyz, f.x),
             mix(volume.fine[under + a].xyz, volume.fine[under + b].xyz, f.x), f.y);
}

vec3 term(int cell, int number) {
  return kept[sourceAt(0, number, cell)].xyz;
}

void main() {
  int cell = int(gl_GlobalInvocationID.x);
  ivec3 size = volume.size[0].xyz;
  if (cell >= volume.size[0].w) {
    return;
  }
  ivec3 place = cellOf(size, cell);
  vec3 toEye = view.boxFromEye[3].xyz - boxOf((vec3(place) + 0.5f) / vec3(size));
  vec3 v = volume.worldFromBox[0].xyz * toEye.x + volume.worldFromBox[1].xyz * toEye.y +
           volume.worldFromBox[2].xyz * toEye.z;
  v *= inversesqrt(max(dot(v, v), 1.0e-30f));
  float x = v.x;
  float y = v.y;
  float z = v.z;
  vec3 sum = term(cell, 0) + 1.7320508f * (y * term(cell, 1) + z * term(cell, 2) +
                                           x * term(cell, 3));
  sum += 3.8729833f * (x * y * term(cell, 4) + y * z * term(cell, 5) + x * z * term(cell, 7) +
                       0.5f * (x * x - y * y) * term(cell, 8));
  sum += 1.1180340f * (3.0f * z * z - 1.0f) * term(cell, 6);
  sum += 2.0916501f * (y * (3.0f * x * x - y * y) * term(cell, 9) +
                       x * (x * x - 3.0f * y * y) * term(cell, 15));
  sum += 10.2469508f * (x * y * z * term(cell, 10) + 0.5f * z * (x * x - y * y) * term(cell, 14));
  sum += 1.6201852f * (5.0f * z * z - 1.0f) * (y * term(cell, 11) + x * term(cell, 13));
  sum += 1.3228757f * z * (5.0f * z * z - 3.0f) * term(cell, 12);
  sum += fineAt(v) * kept[openAt(cell)].xyz;
  vec4 source = vec4(max(sum, vec3(0.0f)), 0.0f);
  // Filters read the cell after the last one, too, with weight 0 or nearly so: what stands there
  // may be of another volume or no number.
  ivec3 more = min(ivec3(equal(place + 1, size)), imageSize(viewAmbient) - size);
  for (int k = 0; k <= more.z; ++k) {
    for (int j = 0; j <= more.y; ++j) {
      for (int i = 0; i <= more.x; ++i) {
        imageStore(viewAmbient, place + ivec3(i, j, k), source);
      }
    }
  }
}
