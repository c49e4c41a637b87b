// SPDX-License-Identifier: MIT
// How rays through a grid meet its cells (interface/transport.glsl).

ivec3 cellOf(ivec3 size, int index) {
  uint i = uint(index);
  uvec2 n = uvec2(size.xy);
  return ivec3(i % n.x, (i / n.x) % n.y, i / (n.x * n.y));
}

ivec3 strideOf(ivec3 size) {
  return ivec3(1, size.x, size.x * size.y);
}

// Times a coordinate has gone around, and where it is then: [-1/2, n - 1/2).
vec2 turned(float x, int n) {
  float turns = floor((x + 0.5f) / float(n));
  // Where a device's quotient is not the nearest, it may be that of the neighbour.
  float at = x - turns * float(n);
  turns += at < -0.5f ? -1.0f : (at >= float(n) - 0.5f ? 1.0f : 0.0f);
  return vec2(turns, x - turns * float(n));
}

// In [0, n). Vulkan leaves remainders of negative numbers undefined, and GPUs do.
int modulo(int i, int n) {
  return i < 0 ? n - 1 - int(uint(-1 - i) % uint(n)) : int(uint(i) % uint(n));
}

// The four rays around a cell in slice k, as indices i + n j, and their weights. A ray that has
// left through the side between stands elsewhere and does not count.
struct Rays {
  ivec4 index;
  vec4 weight;
};

vec2 sideWeights(float offset, int cell, int n) {
  vec2 w = vec2(1.0f - offset, offset);
  w = float(cell) - offset < -0.5f ? vec2(0.0f, 1.0f) : w;
  return float(cell) + 1.0f - offset >= float(n) - 0.5f ? vec2(1.0f, 0.0f) : w;
}

Rays raysAround(TransportDirection d, ivec3 size, ivec3 cell) {
  int n = size[d.axes.x];
  int k = d.axes.w > 0 ? cell[d.axes.x] : n - 1 - cell[d.axes.x];
  ivec2 count = ivec2(size[d.axes.y], size[d.axes.z]);
  ivec2 at = ivec2(cell[d.axes.y], cell[d.axes.z]);
  vec2 back = -float(k) * d.step_.xy;
  vec2 whole = floor(back);
  vec2 wu = sideWeights(back.x - whole.x, at.x, count.x);
  vec2 wv = sideWeights(back.y - whole.y, at.y, count.y);
  ivec2 i0 = ivec2(modulo(at.x + int(whole.x), count.x), modulo(at.y + int(whole.y), count.y));
  ivec2 i1 = ivec2(modulo(at.x + int(whole.x) + 1, count.x),
                   modulo(at.y + int(whole.y) + 1, count.y));
  int slice = k * count.x * count.y;
  Rays rays;
  rays.index = ivec4(i0.x + count.x * i0.y, i1.x + count.x * i0.y, i0.x + count.x * i1.y,
                     i1.x + count.x * i1.y) + slice;
  rays.weight = vec4(wu.x * wv.x, wu.y * wv.x, wu.x * wv.y, wu.y * wv.y);
  return rays;
}

// Where a ray stands in slice k, and the part of the slice's path that lies inside the box behind
// it: 1, or less if it has come in through a side; 1/2 in the first slice.
struct RayStep {
  vec2 at;       // cells along u and v
  float share;
  bool enters;
};

RayStep rayStep(TransportDirection d, ivec2 count, ivec2 ray, int k) {
  vec2 now = vec2(ray) + float(k) * d.step_.xy;
  vec2 before = now - d.step_.xy;
  vec2 u = turned(now.x, count.x);
  vec2 v = turned(now.y, count.y);
  bool wu = u.x != turned(before.x, count.x).x;
  bool wv = v.x != turned(before.y, count.y).x;
  RayStep s;
  s.at = vec2(u.y, v.y);
  s.enters = wu || wv || k == 0;
  // Choices between numbers, not ways: see late.glsl.
  vec2 at = s.at + 0.5f;
  vec2 gone = mix(vec2(count) - at, at, greaterThan(d.step_.xy, vec2(0.0f))) /
              max(abs(d.step_.xy), vec2(1.0e-12f));
  s.share = 1.0f;
  if (k == 0) {
    s.share = 0.5f;
  } else if (wu || wv) {
    s.share = clamp(min(wu ? gone.x : 1.0f, wv ? gone.y : 1.0f), 0.0f, 1.0f);
  }
  return s;
}
