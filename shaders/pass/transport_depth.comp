// SPDX-License-Identifier: MIT
// Optical depth from the light to the middles of a grid twice as fine as that of the cells: each
// thread follows one ray of the light through all slices.
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

void main() {
  TransportDirection d = volume.light;
  ivec3 size = 2 * volume.size[0].xyz;
  ivec2 count = ivec2(size[d.axes.y], size[d.axes.z]);
  int ray = threadOfStep();
  if (ray >= count.x * count.y) {
    return;
  }
  ivec2 start = ivec2(uint(ray) % uint(count.x), ray / count.x);
  int slices = late(size[d.axes.x]);
  vec3 along = vec3(0.0f);  // of a slice's path, over the grid
  along[d.axes.x] = float(d.axes.w) / float(slices);
  along[d.axes.y] = d.step_.x / float(count.x);
  along[d.axes.z] = d.step_.y / float(count.y);
  int taps = late(int(volume.peak.y));
  float depth = 0.0f;
  int k = 0;
  do {
    RayStep s = rayStep(d, count, start, k);
    vec3 at = vec3(0.0f);
    at[d.axes.x] = (float(d.axes.w > 0 ? k : slices - 1 - k) + 0.5f) / float(slices);
    at[d.axes.y] = (s.at.x + 0.5f) / float(count.x);
    at[d.axes.z] = (s.at.y + 0.5f) / float(count.y);
    depth = s.enters ? 0.0f : depth;
    for (int i = 0; i < taps; ++i) {
      vec4 beta =
          fieldExtinction(boxOf(at - along * (s.share * (float(i) + 0.5f) / float(taps))));
      depth += (beta.x + beta.y + beta.z + beta.w) * s.share * d.step_.z / float(taps);
    }
    swept[radianceAt(0, 0, k * count.x * count.y + ray)] = depth;  // 8 of its 26 shares
    k += 1;
  } while (k < slices);
}
