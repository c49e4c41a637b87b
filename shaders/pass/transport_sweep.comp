// SPDX-License-Identifier: MIT
// Radiance that passes each slab of cells along every ray of every direction, as its mean over the
// slab's optical depth: what is absorbed there is what comes in and is emitted less what goes out,
// so that rays neither make nor lose light. Sources are linear in a slab's optical depth. Constant
// radiance stays constant.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "transport.glsl"
#include "transport_slab.glsl"

layout(local_size_x = 64) in;

// What leaves a slab of optical depth t, of 1 / t emitted per depth in the mean, by a beam of which
// a part e^-|a| passes the slab along the ray, or against it (a < 0): integral of e^(-a x - t (1 -
// x)) over x in (0, 1), over that of e^(-a x).
float ofBeam(float t, float a) {
  float b = abs(a);
  float passed = b > 1.0e-3f ? (1.0f - exp(-min(b, 80.0f))) / b : 1.0f - 0.5f * b;
  float along = abs(t - b);
  float both = a > 0.0f ? along : t + b;
  float mean = both > 1.0e-3f ? (1.0f - exp(-min(both, 80.0f))) / both : 1.0f - 0.5f * both;
  return mean * (a > 0.0f ? exp(-min(min(t, b), 80.0f)) : 1.0f) / passed;
}

// Of the ray in one slice of cells: source (radiance), extinction (1/m).
struct Slice {
  float source;
  float beta;
};

void main() {
  int level = int(push.level);
  int direction = rowOfStep();
  TransportDirection d = directionAt(level, direction);
  ivec3 size = volume.size[level].xyz;
  ivec3 stride = strideOf(size);
  ivec2 count = ivec2(size[d.axes.y], size[d.axes.z]);
  ivec2 across = ivec2(stride[d.axes.y], stride[d.axes.z]);
  int ray = int(gl_GlobalInvocationID.x);
  if (ray >= count.x * count.y) {
    return;
  }
  bool first = late((push.flags & TRANSPORT_FIRST_SWEEP) != 0u);
  ivec2 start = ivec2(uint(ray) % uint(count.x), ray / count.x);
  int slices = size[d.axes.x];
  float radiance = 0.0f;
  // The slab of a slice ends half-way to the next one, or where the ray leaves the grid; its source
  // changes as between its neighbours. So it is done when the next slice is known.
  Slice before = Slice(0.0f, 0.0f);
  Slice here = before;
  float begun = 0.0f;  // share of a slice's path, inside the slab before its slice
  // Of a layer, of light scattered once: the beam's path through a slice, against rays negative.
  float beam = 0.0f;
  if (first && isLayer() && d.axes.x == volume.light.axes.x) {
    beam = volume.light.step_.z * float(2 << level) * float(d.axes.w * volume.light.axes.w);
  }
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
      vec4 betas = vec4(kept[extinctionAt(level, cells.x)], kept[extinctionAt(level, cells.y)],
                        kept[extinctionAt(level, cells.z)], kept[extinctionAt(level, cells.w)]);
      vec4 around;
      if (first) {
        around = vec4(kept[lightAt(level, cells.x)], kept[lightAt(level, cells.y)],
                      kept[lightAt(level, cells.z)], kept[lightAt(level, cells.w)]);
      } else {
        around = vec4(work[directedAt(level, direction, cells.x)],
                      work[directedAt(level, direction, cells.y)],
                      work[directedAt(level, direction, cells.z)],
                      work[directedAt(level, direction, cells.w)]);
      }
      // What is emitted is interpolated, so that all of it is.
      vec4 emits = w * (betas + 1.0e-12f);
      next.beta = dot(w, betas);
      next.source = dot(emits, around) / (emits.x + emits.y + emits.z + emits.w);
    }
    if (k > 0) {
      Slice after = s.enters ? here : next;
      float share = begun + (s.enters ? 1.0f - s.share : 0.5f);
      float near = 2.0f * here.beta + before.beta + after.beta;
      float slope = near > 0.0f ? 2.0f * here.beta * (after.source - before.source) / near : 0.0f;
      slope = share * clamp(slope, -2.0f * abs(here.source), 2.0f * abs(here.source));
      float t = here.beta * share * d.step_.z;
      float e = exp(-min(t, 80.0f));
      vec2 weights = slabWeights(t, e);
      float leaves = radiance * e + here.source * (1.0f - e) + slope * weights.y;
      float mean = radiance * weights.x + here.source * (1.0f - weights.x) -
                   slope * (t > 0.0f ? weights.y / t : 0.0f);
      if (beam != 0.0f) {
        float part = ofBeam(t, here.beta * share * beam);  // of what is emitted
        leaves = radiance * e + here.source * t * part;
        mean = radiance * weights.x + here.source * (1.0f - part);
      }
      swept[radianceAt(level, direction, (k - 1) * count.x * count.y + ray)] = mean;
      radiance = leaves;
    }
    before = here;
    here = next;
    begun = 0.5f;
    if (s.enters) {
      radiance = 0.0f;
      before = here;
      begun = s.share;
    }
    k += 1;
  } while (k <= slices);
}
