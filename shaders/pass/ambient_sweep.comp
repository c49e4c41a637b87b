// SPDX-License-Identifier: MIT
// Radiance that passes each slab of cells along every ray of every direction, as its mean over the
// slab's optical depth: as transport_sweep.comp, with light that comes in from outside.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "ambient.glsl"
#include "transport_slab.glsl"

layout(local_size_x = 64) in;

// Of the ray in one slice of cells: source (radiance), extinction (1/m).
struct Slice {
  vec3 source;
  float beta;
};

void main() {
  int level = int(push.level);
  int direction = int(gl_WorkGroupID.y);
  TransportDirection d = directionAt(level, direction);
  ivec3 size = volume.size[level].xyz;
  ivec3 stride = strideOf(size);
  ivec2 count = ivec2(size[d.axes.y], size[d.axes.z]);
  ivec2 across = ivec2(stride[d.axes.y], stride[d.axes.z]);
  int ray = int(gl_GlobalInvocationID.x);
  if (ray >= count.x * count.y) {
    return;
  }
  ivec2 start = ivec2(uint(ray) % uint(count.x), ray / count.x);
  int slices = size[d.axes.x];
  vec3 incoming = late((push.flags & AMBIENT_INCOMING) != 0u) ? volume.incoming[direction].xyz
                                                              : vec3(0.0f);
  bool alone = late((push.flags & AMBIENT_ALONE) != 0u);
  vec3 radiance = incoming;
  // The slab of a slice ends half-way to the next one, or where the ray leaves the grid; its source
  // changes as between its neighbours. So it is done when the next slice is known.
  Slice before = Slice(vec3(0.0f), 0.0f);
  Slice here = before;
  float begun = 0.0f;  // share of a slice's path, inside the slab before its slice
  int k = 0;
  do {
    Slice next = here;
    RayStep s = RayStep(vec2(0.0f), 0.5f, true);
    if (k < slices) {
      s = rayStep(d, count, start, k);
      int base = (d.axes.w > 0 ? k : slices - 1 - k) * stride[d.axes.x];
      vec2 whole = floor(s.at);
      vec2 f = s.at - whole;
      ivec2 a = max(ivec2(whole), ivec2(0));
      ivec2 b = min(ivec2(whole) + 1, count - 1);
      ivec4 cells = base + ivec4(a.x * across.x + a.y * across.y, b.x * across.x + a.y * across.y,
                                 a.x * across.x + b.y * across.y, b.x * across.x + b.y * across.y);
      vec4 w = vec4((1.0f - f.x) * (1.0f - f.y), f.x * (1.0f - f.y), (1.0f - f.x) * f.y,
                    f.x * f.y);
      vec4 betas = vec4(kept[momentAt(level, 0, cells.x)].w, kept[momentAt(level, 0, cells.y)].w,
                        kept[momentAt(level, 0, cells.z)].w, kept[momentAt(level, 0, cells.w)].w);
      // What is emitted is interpolated, so that all of it is.
      vec4 emits = w * (betas + 1.0e-12f);
      next.beta = dot(w, betas);
      next.source = (emits.x * work[directedAt(level, direction, cells.x)].xyz +
                     emits.y * work[directedAt(level, direction, cells.y)].xyz +
                     emits.z * work[directedAt(level, direction, cells.z)].xyz +
                     emits.w * work[directedAt(level, direction, cells.w)].xyz) /
                    (emits.x + emits.y + emits.z + emits.w);
      if (alone) {
        next.source = vec3(0.0f);
      }
    }
    if (k > 0) {
      Slice after = here;
      if (!s.enters) {
        after = next;
      }
      float share = begun + (s.enters ? 1.0f - s.share : 0.5f);
      float near = 2.0f * here.beta + before.beta + after.beta;
      vec3 most = 2.0f * abs(here.source);
      vec3 slope = (after.source - before.source) * (2.0f * here.beta / max(near, 1.0e-30f));
      slope = share * clamp(slope, -most, most);
      float t = here.beta * share * d.step_.z;
      float e = exp(-min(t, 80.0f));
      vec2 weights = slabWeights(t, e);
      vec3 leaves = radiance * e + here.source * (1.0f - e) + slope * weights.y;
      vec3 mean = radiance * weights.x + here.source * (1.0f - weights.x) -
                  slope * (t > 0.0f ? weights.y / t : 0.0f);
      work[radianceAt(level, direction, (k - 1) * count.x * count.y + ray)] = vec4(mean, 0.0f);
      radiance = leaves;
    }
    before = here;
    here = next;
    begun = 0.5f;
    if (s.enters) {
      radiance = incoming;
      before = here;
      begun = s.share;
    }
    k += 1;
  } while (k <= slices);
}
