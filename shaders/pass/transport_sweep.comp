// SPDX-License-Identifier: MIT
// Radiance along every ray of every direction, from the source in the cells: exact for sources that
// are linear in optical depth from slice to slice. Constant radiance stays constant.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "transport.glsl"

layout(local_size_x = 64) in;

// (1 - e^-t) / t and the rest of the weight: of the source behind and of the one here.
vec2 sourceWeights(float t, float e) {
  float mean = t > 1.0e-2f ? (1.0f - e) / t : 1.0f - t * (0.5f - t * (1.0f / 6.0f));
  float here = t > 1.0e-2f ? 1.0f - mean : t * (0.5f - t * (1.0f / 6.0f));
  float behind = t > 1.0e-2f ? mean - e : t * (0.5f - t * (1.0f / 3.0f));
  return vec2(behind, here);
}

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
  bool first = (push.flags & TRANSPORT_FIRST_SWEEP) != 0u;
  ivec2 start = ivec2(ray % count.x, ray / count.x);
  int slices = size[d.axes.x];
  float radiance = 0.0f;
  float sourceBehind = 0.0f;
  float betaBehind = 0.0f;
  int k = 0;
  do {
    RayStep s = rayStep(d, count, start, k);
    int base = (d.axes.w > 0 ? k : slices - 1 - k) * stride[d.axes.x];
    vec2 whole = floor(s.at);
    vec2 f = s.at - whole;
    ivec2 a = max(ivec2(whole), ivec2(0));
    ivec2 b = min(ivec2(whole) + 1, count - 1);
    ivec4 cells = base + ivec4(a.x * across.x + a.y * across.y, b.x * across.x + a.y * across.y,
                               a.x * across.x + b.y * across.y, b.x * across.x + b.y * across.y);
    vec4 w = vec4((1.0f - f.x) * (1.0f - f.y), f.x * (1.0f - f.y), (1.0f - f.x) * f.y, f.x * f.y);
    vec4 betas = vec4(kept[extinctionAt(level, cells.x)], kept[extinctionAt(level, cells.y)],
                      kept[extinctionAt(level, cells.z)], kept[extinctionAt(level, cells.w)]);
    float beta = dot(w, betas);
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
    float source = dot(w, around);
    if (s.enters) {
      radiance = 0.0f;
      sourceBehind = source;
      betaBehind = beta;
    }
    float t = 0.5f * (betaBehind + beta) * s.share * d.step_.z;
    float e = exp(-min(t, 80.0f));
    vec2 weights = sourceWeights(t, e);
    radiance = radiance * e + sourceBehind * weights.x + source * weights.y;
    sourceBehind = source;
    betaBehind = beta;
    work[radianceAt(level, direction, k * count.x * count.y + ray)] = radiance;
    k += 1;
  } while (k < slices);
}
