// SPDX-License-Identifier: MIT
// What the passes of the light grid share: its lists and how rays meet cells.
#define real float
#include "../interface/transport.glsl"

layout(set = 0, binding = 0, std140) uniform Volume { TransportUniforms volume; };
layout(set = 0, binding = 1, std430) buffer Work { float work[]; };
layout(set = 0, binding = 2, std430) buffer Kept { float kept[]; };
layout(push_constant) uniform Push { TransportPush push; };

// Lists of `kept`. Over all levels: extinction without the peak (1/m), light that is scattered
// there first, moments of the phase function times albedo, terms of the source; of the finest
// level: terms of the light scattered once.
int total() {
  return volume.place[TRANSPORT_LEVELS - 1].x + volume.size[TRANSPORT_LEVELS - 1].w;
}
int extinctionAt(int level, int cell) {
  return volume.place[level].x + cell;
}
int lightAt(int level, int cell) {
  return total() + volume.place[level].x + cell;
}
int momentAt(int level, int degree, int cell) {
  return total() * (2 + degree) + volume.place[level].x + cell;
}
int sourceAt(int level, int term, int cell) {
  return total() * (6 + term) + volume.place[level].x + cell;
}
// Terms of the light scattered once, then of that scattered twice, over the phase functions.
int firstAt(int term, int cell) {
  return total() * (6 + TRANSPORT_TERMS) + volume.size[0].w * term + cell;
}

// What the level below the finest found by itself: terms as above, then those of its source.
int coarseAt(int term, int cell) {
  return total() * (6 + TRANSPORT_TERMS) + volume.size[0].w * (2 * FIRST_TERMS) +
         volume.size[1].w * term + cell;
}

bool isLayer() {
  return volume.travel.w > 0.0f;
}
// A layer's responses: of nodes, for light scattered twice and three times; of directions, twice;
// moments of light scattered twice.
int responseAt(int node, int order) {
  return coarseAt(2 * FIRST_TERMS + TRANSPORT_TERMS, 0) + (node * 2 + order) * FIRST_TERMS;
}
const int RESPONSE_NODES = RESPONSE_ZENITHS * RESPONSE_AZIMUTHS;

// Lists of `work`. Over all levels: what drives the source, the change of the source; of the level
// in turn: source and radiance in each direction.
int driveAt(int level, int term, int cell) {
  return total() * term + volume.place[level].x + cell;
}
int changeAt(int level, int term, int cell) {
  return total() * (TRANSPORT_TERMS + term) + volume.place[level].x + cell;
}
int directedAt(int level, int direction, int cell) {
  return total() * (2 * TRANSPORT_TERMS) + volume.size[level].w * direction + cell;
}
int radianceAt(int level, int direction, int ray) {
  return total() * (2 * TRANSPORT_TERMS) + volume.size[0].w * volume.place[0].y +
         volume.size[level].w * direction + ray;
}

TransportDirection directionAt(int level, int direction) {
  return volume.directions[level * TRANSPORT_DIRECTIONS + direction];
}

vec3 boxOf(vec3 grid) {
  return volume.gridOrigin.xyz + grid * volume.gridSize.xyz;
}

ivec3 cellOf(ivec3 size, int index) {
  return ivec3(index % size.x, (index / size.x) % size.y, index / (size.x * size.y));
}

ivec3 strideOf(ivec3 size) {
  return ivec3(1, size.x, size.x * size.y);
}

// Times a coordinate has gone around, and where it is then: [-1/2, n - 1/2).
vec2 turned(float x, int n) {
  float turns = floor((x + 0.5f) / float(n));
  return vec2(turns, x - turns * float(n));
}

int modulo(int i, int n) {
  int r = i % n;
  return r < 0 ? r + n : r;
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
  float fu = d.step_.x > 0.0f ? (u.y + 0.5f) / d.step_.x
                              : (float(count.x) - 0.5f - u.y) / max(-d.step_.x, 1.0e-12f);
  float fv = d.step_.y > 0.0f ? (v.y + 0.5f) / d.step_.y
                              : (float(count.y) - 0.5f - v.y) / max(-d.step_.y, 1.0e-12f);
  s.share = 1.0f;
  if (k == 0) {
    s.share = 0.5f;
  } else if (wu || wv) {
    s.share = clamp(min(wu ? fu : 1.0f, wv ? fv : 1.0f), 0.0f, 1.0f);
  }
  return s;
}
