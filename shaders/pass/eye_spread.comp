// SPDX-License-Identifier: MIT
// Radiance and transmittance of second pixels between the rays of every fourth one, then of pixels
// between those of every second one (second_pixels.glsl): by cubics through the four nearest along
// each axis where those are smooth and end at the same surface; the others go on a list, whose
// pixels are marched next. An invocation goes down SPREAD_COLUMNS columns of SPREAD_CELLS cells of
// 2 x 2, so that it reads each row's rays once.
//
// Smooth: second and third differences bound what a cubic misses. A step between the middle two of
// four, which leaves the second difference 0, has a third one of twice its height, so that steps of
// 8 bounds and more are never interpolated.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common.glsl"
#include "../interface/slices.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 5) const bool DEPTH_ENABLED = true;
// Behind other volumes or surfaces.
layout(constant_id = 9) const bool BEHIND = false;
layout(constant_id = 13) const uint TO = SPREAD_TO_PIXELS;
layout(constant_id = 14) const bool DISTANCE = false;

layout(set = 0, binding = 0, std140) uniform Frame { FrameUniforms frame; };
layout(set = 0, binding = 1, std140) uniform Volume { VolumeUniforms volume; };
layout(set = 0, binding = 9) uniform sampler2D depthImage;
layout(set = 0, binding = 10, std430) buffer FrameState { vec4 frameState[]; };
layout(set = 0, binding = 19, std430) buffer Distances { vec4 distances[]; };
layout(push_constant) uniform Push { SliceConstants slice; };

#include "ray.glsl"
#include "ray_end.glsl"
#include "second_pixels.glsl"

const bool TO_SECONDS = TO == SPREAD_TO_SECONDS;
// Of differences over 16, in parts of the largest radiance around, of the transmittance in parts of
// 1; over the number of slabs, since the fewer there are, the more they are wrong by themselves.
// What second pixels miss the pixels between them miss as well: theirs may be half as much.
const float SMOOTH_SLABS = TO_SECONDS ? 0.32f : 0.64f;
// Of the ray's length inside the box, by which its end may miss what its neighbours' ends promise.
const float SAME_END = 0.02f;

// Pixels of a cell without a ray of their own, which may ask for one: bits in a word, 32 at most.
const uint ASKED_PER_CELL = 3u;

// What a ray saw: radiance and transmittance; where it ends (m), 0 if it misses the box, and sums
// for the volumes' distance.
struct Ray {
  vec4 state;
  vec4 sums;
};

// Numbers of the first and last rays to look at.
ivec2 firstRay() {
  return ivec2(TO_SECONDS ? firstFourth() : firstSecond());
}

ivec2 lastRay() {
  return ivec2(TO_SECONDS ? lastFourth() : lastSecond());
}

Ray rayAt(ivec2 number) {
  uvec2 ofView = uvec2(clamp(number, firstRay(), lastRay()));
  uint at = secondAddress(ofView * (TO_SECONDS ? 2u : 1u));
  Ray ray;
  ray.state = secondRays[at];
  ray.sums = DEPTH_ENABLED || DISTANCE ? secondRays[at + 1u] : vec4(0.0f);
  return ray;
}

// What a cubic through four values may miss in their middle, and the cubic there.
vec4 missed(vec4 a, vec4 b, vec4 c, vec4 d) {
  return max(abs(b + c - a - d), abs(a - d + 3.0f * (c - b))) * 0.0625f;
}

vec4 middleOf(vec4 a, vec4 b, vec4 c, vec4 d) {
  return (9.0f * (b + c) - (a + d)) * 0.0625f;
}

// Position per m along a pixel's ray, in voxels.
vec3 voxelsAlong(vec2 pixel) {
  return (volume.boxFromEye * vec4(pixelDirection(frame, pixel), 0.0f)).xyz * volume.voxels.xyz;
}

// Whether one of the rays of fourth pixels around goes through whatever voxel this ray meets, t m
// away: a voxel's density reaches `reach` voxels to both sides.
bool meetsVoxels(vec2 pixel, vec3 along, float t, vec3 reach) {
  vec3 right = t * (voxelsAlong(pixel + vec2(2.0f, 0.0f)) - along);
  vec3 up = t * (voxelsAlong(pixel + vec2(0.0f, 2.0f)) - along);
  Span sum = rayBox(right + up, along, -reach, reach);
  Span difference = rayBox(right - up, along, -reach, reach);
  return sum.end > sum.begin && difference.end > difference.begin;
}

// Whether a second pixel's ray may meet something where those around have seen nothing at all: they
// promise nothing for what is narrower than they are apart.
bool blind(uvec2 second, Ray between, Ray error) {
  vec2 pixel = vec2(second * 2u);
  vec3 along = voxelsAlong(pixel);
  vec3 origin = volume.boxFromEye[3].xyz * volume.voxels.xyz;
  Span span = rayBox(origin, along, vec3(0.0f), volume.voxels.xyz);
  // Voxels at the box's faces reach half a voxel to one side, those between two of them to both.
  vec3 first = origin + span.begin * along;
  vec3 last = origin + span.end * along;
  vec3 nearest = min(min(first, last), volume.voxels.xyz - max(first, last));
  vec3 reach = mix(vec3(0.75f), vec3(1.0f), greaterThan(nearest, vec3(1.5f)));
  reach = mix(reach, vec3(0.5f), lessThan(volume.voxels.xyz, vec3(1.5f)));
  return between.state.w == 1.0f && error.state.w == 0.0f && span.end > span.begin &&
         !meetsVoxels(pixel, along, span.end, reach);
}

// Where the ray ends inside the box and where it enters it, m; 0 if it misses.
vec2 endOf(uvec2 pixel) {
  vec3 direction = pixelDirection(frame, vec2(pixel));
  float d = texelFetch(depthImage, insideView(pixel), 0).x;
  vec3 along = (volume.boxFromEye * vec4(direction, 0.0f)).xyz;
  Span span = rayBox(volume.boxFromEye[3].xyz, along, vec3(0.0f), vec3(1.0f));
  span.end = min(span.end, endOfRay(frame, direction, surfaceDistance(frame, vec2(pixel), d)));
  return span.end > span.begin ? vec2(span.end, span.begin) : vec2(0.0f);
}

// Behind what the volumes in front have left.
void take(uvec2 pixel, Ray ray) {
  uint index = pixel.y * uint(frame.viewport.x) + pixel.x;
  vec4 front = vec4(0.0f, 0.0f, 0.0f, 1.0f);
  vec2 sums = vec2(0.0f);
  if (BEHIND) {
    front = frameState[index];
    if (DISTANCE) {
      sums = distances[index].xy;
    }
  }
  frameState[index] = vec4(front.xyz + front.w * ray.state.xyz, front.w * ray.state.w);
  if (DISTANCE) {
    distances[index] = vec4(sums + front.w * ray.sums.yz, ray.sums.yz);
  }
}

// Of pixels or second pixels, as all that follows.
bool inside(uvec2 at) {
  if (TO_SECONDS) {
    return at.x <= lastSecond().x && at.y <= lastSecond().y;
  }
  return at.x < uint(volume.rect.z) && at.y < uint(volume.rect.w);
}

// Whether a pixel that ends at `own` may take on what lies between its neighbours. Comparisons that
// fail for NaN.
bool serves(vec2 own, Ray between, Ray error, Ray most) {
  float bound = SMOOTH_SLABS / volume.texelB.w;
  bool smooth_ = all(lessThanEqual(error.state, bound * most.state));
  if (DISTANCE) {
    smooth_ = smooth_ && error.sums.y <= bound * most.sums.y;
  }
  if (DEPTH_ENABLED) {
    smooth_ = smooth_ && abs(own.x - between.sums.x) <= SAME_END * (own.x - own.y);
  }
  return smooth_;
}

// Rays a, b, c, d along a line. Where the cubic leaves what can be, a straight line: cut off, light
// and transmittance would no longer keep energy together.
Ray cubic(Ray a, Ray b, Ray c, Ray d) {
  Ray between;
  between.state = middleOf(a.state, b.state, c.state, d.state);
  between.sums = middleOf(a.sums, b.sums, c.sums, d.sums);
  vec3 light = between.state.xyz;
  if (min(min(light.x, light.y), min(light.z, between.state.w)) < 0.0f || between.state.w > 1.0f) {
    between.state = 0.5f * (b.state + c.state);
  }
  if (min(between.sums.y, between.sums.z) < 0.0f) {
    between.sums = 0.5f * (b.sums + c.sums);
  }
  between.sums.x = 0.5f * (b.sums.x + c.sums.x);  // surfaces have edges
  return between;
}

Ray cubicError(Ray a, Ray b, Ray c, Ray d) {
  Ray error;
  error.state = missed(a.state, b.state, c.state, d.state);
  error.sums = missed(a.sums, b.sums, c.sums, d.sums);
  return error;
}

Ray larger(Ray a, Ray b) {
  Ray both;
  both.state = max(a.state, b.state);
  both.sums = max(a.sums, b.sums);
  return both;
}

// Takes on what lies between the neighbours, or asks for a ray: by a bit.
void settle(uvec2 at, Ray between, Ray error, Ray most, uint bit, inout uint asked) {
  if (!inside(at)) {
    return;
  }
  vec2 own = DEPTH_ENABLED ? endOf(at * (TO_SECONDS ? 2u : 1u)) : vec2(0.0f);
  bool unseen = TO_SECONDS && blind(at, between, error);
  if (!unseen && serves(own, between, error, most)) {
    if (TO_SECONDS) {
      storeSecond(at, between.state, own.x, between.sums.yz);
    } else {
      take(at, between);
    }
  } else {
    asked |= 1u << bit;
  }
}

// Puts what an invocation asks for on the list: bits ASKED_PER_CELL to a cell, see settleCell. Once
// for all its cells, and in a loop that ends when no lane asks for more: lavapipe takes all lanes
// through a cell's own atomics and stores, whether they ask or not.
void ask(uvec2 corner, uint asked) {
  if (asked == 0u) {
    return;
  }
  uint count = uint(bitCount(asked));
  uint list = TO_SECONDS ? 0u : LIST_SIZE;
  uint at = atomicAdd(seconds[list + 3u], count);
  atomicMax(seconds[list + 1u], (at + count - 1u) / (64u * LIST_ROW) + 1u);
  at += listAddress();
  while (asked != 0u) {
    uint bit = uint(findLSB(asked));
    uint cell = bit / ASKED_PER_CELL;
    uint which = bit - ASKED_PER_CELL * cell;
    uvec2 place = corner + 2u * uvec2(cell % SPREAD_COLUMNS, cell / SPREAD_COLUMNS) +
                  uvec2(which == 1u ? 0u : 1u, which == 0u ? 0u : 1u);
    seconds[at] = place.x | (place.y << 16u);
    at += 1u;
    asked &= asked - 1u;
  }
}

// Of four rays along a row: the second, what lies between it and the third, and the larger of both.
struct Row {
  Ray second;
  Ray between;
  Ray error;
  Ray most;
};

// Of two cells beside each other.
struct Rows {
  Row left;
  Row right;
};

Row rowOf(Ray a, Ray b, Ray c, Ray d) {
  Row row;
  row.second = b;
  row.between = cubic(a, b, c, d);
  row.error = cubicError(a, b, c, d);
  row.most = larger(b, c);
  return row;
}

Rows rowsAt(ivec2 at) {
  Ray a = rayAt(at - ivec2(1, 0));
  Ray b = rayAt(at);
  Ray c = rayAt(at + ivec2(1, 0));
  Ray d = rayAt(at + ivec2(2, 0));
  Ray e = rayAt(at + ivec2(3, 0));
  Rows rows;
  rows.left = rowOf(a, b, c, d);
  rows.right = rowOf(b, c, d, e);
  return rows;
}

// 2 x 2 of them, the first of which has a ray of its own, from the four rows around.
void settleCell(uvec2 corner, Row above, Row here, Row next, Row last, uint cell,
                inout uint asked) {
  Ray most = larger(here.most, next.most);
  most.state = vec4(vec3(max(max(most.state.x, most.state.y), most.state.z)), 1.0f);
  Ray below = cubic(above.second, here.second, next.second, last.second);
  Ray belowError = cubicError(above.second, here.second, next.second, last.second);
  Ray across = cubic(above.between, here.between, next.between, last.between);
  Ray acrossError = larger(cubicError(above.between, here.between, next.between, last.between),
                           larger(here.error, next.error));
  if (!TO_SECONDS && inside(corner)) {
    take(corner, here.second);
  }
  uint bit = ASKED_PER_CELL * cell;
  settle(corner + uvec2(1u, 0u), here.between, here.error, most, bit, asked);
  settle(corner + uvec2(0u, 1u), below, belowError, most, bit + 1u, asked);
  settle(corner + uvec2(1u, 1u), across, acrossError, most, bit + 2u, asked);
}

void main() {
  ivec2 at = firstRay() + ivec2(gl_GlobalInvocationID.xy * uvec2(SPREAD_COLUMNS, SPREAD_CELLS));
  if (!inside(uvec2(at) * 2u)) {
    return;
  }
  Rows above = rowsAt(at - ivec2(0, 1));
  Rows here = rowsAt(at);
  Rows next = rowsAt(at + ivec2(0, 1));
  uint asked = 0u;
  for (int i = 0; i < int(SPREAD_CELLS); ++i) {
    Rows last = rowsAt(at + ivec2(0, i + 2));
    uvec2 corner = uvec2(at) * 2u + uvec2(0u, 2u * uint(i));
    uint cell = SPREAD_COLUMNS * uint(i);
    settleCell(corner, above.left, here.left, next.left, last.left, cell, asked);
    settleCell(corner + uvec2(2u, 0u), above.right, here.right, next.right, last.right, cell + 1u,
               asked);
    above = here;
    here = next;
    next = last;
  }
  ask(uvec2(at) * 2u, asked);
}
