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
layout(constant_id = 12) const bool TILES = false;
layout(constant_id = 13) const uint TO = SPREAD_TO_PIXELS;
layout(constant_id = 14) const bool DISTANCE = false;

layout(set = 0, binding = 0, std140) uniform Frame { FrameUniforms frameBlock; };
FrameUniforms frame = frameBlock;
layout(set = 0, binding = 1, std140) uniform Volume { VolumeUniforms volumeBlock; };
VolumeUniforms volume = volumeBlock;
layout(set = 0, binding = 9) uniform sampler2D depthImage;
layout(set = 0, binding = 10, std430) buffer FrameState { vec4 frameState[]; };
layout(set = 0, binding = 19, std430) buffer Distances { vec4 distances[]; };
layout(push_constant) uniform Push { SliceConstants sliceBlock; };
SliceConstants slice = sliceBlock;

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

// What a ray saw: radiance and transmittance; where it ends (m), 0 if it misses the box, sums for
// the volumes' distance, and 1 if a surface cut it short.
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
  ray.state = secondRow(at);
  ray.sums = DEPTH_ENABLED || DISTANCE ? secondRow(at + 1u) : vec4(0.0f);
  return ray;
}

// What a cubic through four values may miss in their middle, and the cubic there.
vec4 missed(vec4 a, vec4 b, vec4 c, vec4 d) {
  return max(abs(b + c - a - d), abs(a - d + 3.0f * (c - b))) * 0.0625f;
}

vec4 middleOf(vec4 a, vec4 b, vec4 c, vec4 d) {
  return (9.0f * (b + c) - (a + d)) * 0.0625f;
}

// A ray before it is normalised: then it is linear in the pixel's place.
struct Beam {
  vec4 homogeneous;  // of pixelDirection
  vec4 along;        // its box coordinates, and its part along the local up
};

Beam beamOf(vec4 homogeneous) {
  Beam beam;
  beam.homogeneous = homogeneous;
  vec4 direction = vec4(homogeneous.xyz, 0.0f);
  beam.along = vec4((volume.boxFromEye * direction).xyz, dot(homogeneous.xyz, frame.eye.xyz));
  return beam;
}

// The rays of an invocation's pixels: that of the first one, and what one to the right and one
// downwards add. Read and multiplied once for all of them: the driver's loads of what is uniform
// cost more than the arithmetic.
struct Fan {
  Beam first;
  Beam right;
  Beam down;
  vec4 depth;  // what a depth value of 1 adds to the homogeneous position
};

// From a pixel on, in steps of so many.
Fan fanOf(vec2 pixel, float steps) {
  vec4 first = homogeneousAt(frame, pixel, 0.5f);
  float size = 1.0f / length(first.xyz);
  vec2 next = size * steps * 2.0f * frame.viewport.zw;
  Fan fan;
  fan.first = beamOf(size * first);
  fan.right = beamOf(next.x * frame.eyeFromNdc[0]);
  fan.down = beamOf(next.y * frame.eyeFromNdc[1]);
  fan.depth = size * frame.eyeFromNdc[2];
  return fan;
}

Beam beamAt(Fan fan, vec2 ahead) {
  Beam beam;
  beam.homogeneous = fan.first.homogeneous + ahead.x * fan.right.homogeneous +
                     ahead.y * fan.down.homogeneous;
  beam.along = fan.first.along + ahead.x * fan.right.along + ahead.y * fan.down.along;
  // Which way it goes.
  beam.along = beam.homogeneous.w < 0.0f ? -beam.along : beam.along;
  return beam;
}

// Whether lines through `place` meet a box around 0 with these half edges: 1 over their direction.
bool lineMeets(vec3 place, vec3 inverse, vec3 edges) {
  vec3 middle = place * inverse;
  vec3 halves = edges * abs(inverse);
  vec3 begin = middle - halves;
  vec3 end = middle + halves;
  return max(max(begin.x, begin.y), begin.z) < min(min(end.x, end.y), end.z);
}

// Whether one of the rays of fourth pixels around goes through whatever voxel this ray meets, t
// lengths away: a voxel's density reaches `reach` voxels to both sides.
bool meetsVoxels(Fan fan, vec3 along, float t, vec3 reach) {
  vec3 right = t * fan.right.along.xyz * volume.voxels.xyz;
  vec3 down = t * fan.down.along.xyz * volume.voxels.xyz;
  bvec3 flat_ = lessThan(abs(along), vec3(DIRECTION_FLOOR));
  vec3 inverse = 1.0f / mix(along, vec3(DIRECTION_FLOOR), flat_);
  return lineMeets(right + down, inverse, reach) && lineMeets(right - down, inverse, reach);
}

// Whether a second pixel's ray may meet something where those around have seen nothing at all: they
// promise nothing for what is narrower than they are apart.
bool blind(Fan fan, Beam beam, Ray between, Ray error) {
  vec3 along = beam.along.xyz * volume.voxels.xyz;
  vec3 origin = volume.boxFromEye[3].xyz * volume.voxels.xyz;
  Span span = rayBox(origin, along, vec3(0.0f), volume.voxels.xyz);
  // Voxels at the box's faces reach half a voxel to one side, those between two of them to both.
  vec3 first = origin + span.begin * along;
  vec3 last = origin + span.end * along;
  vec3 nearest = min(min(first, last), volume.voxels.xyz - max(first, last));
  vec3 reach = mix(vec3(0.75f), vec3(1.0f), greaterThan(nearest, vec3(1.5f)));
  reach = mix(reach, vec3(0.5f), lessThan(volume.voxels.xyz, vec3(1.5f)));
  return between.state.w == 1.0f && error.state.w == 0.0f && span.end > span.begin &&
         !meetsVoxels(fan, along, span.end, reach);
}

// x: where the ray of a pixel ends inside the box, y: where it enters it (m), both 0 if it sees
// none of it; z: more than x if a surface cuts it short.
vec3 endOf(Fan fan, Beam beam, uvec2 pixel) {
  float size = length(beam.homogeneous.xyz);
  Span span = rayBox(volume.boxFromEye[3].xyz, beam.along.xyz, vec3(0.0f), vec3(1.0f));
  float d = texelFetch(depthImage, insideView(pixel), 0).x;
  float surface = homogeneousDistance(frame, beam.homogeneous + (d - 0.5f) * fan.depth, d);
  vec2 box = size * vec2(span.end, span.begin);
  float end = min(box.x, endOfRay(frame, beam.along.w / size, surface));
  return end > box.y ? vec3(end, box.yx) : vec3(0.0f, 0.0f, box.x > box.y ? 1.0f : 0.0f);
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
bool serves(vec3 own, Ray between, Ray error, Ray most) {
  float bound = SMOOTH_SLABS / volume.texelB.w;
  bool smooth_ = all(lessThanEqual(error.state, bound * most.state));
  if (DISTANCE) {
    smooth_ = smooth_ && error.sums.y <= bound * most.sums.y;
  }
  if (DEPTH_ENABLED) {
    // Where rays around see nothing as far as the box reaches, it does not matter how far this one
    // goes: eye_tiles.comp relies on that.
    bool nothing = between.sums.w == 0.0f && error.sums.w == 0.0f &&
                   all(equal(between.state, NOTHING)) && all(equal(error.state, vec4(0.0f)));
    bool sameEnd = abs(own.x - between.sums.x) <= SAME_END * (own.x - own.y);
    smooth_ = smooth_ && (nothing || sameEnd);
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
// `first`: the fan's; `ahead`: from there on.
void settle(Fan fan, uvec2 first, uvec2 ahead, Ray between, Ray error, Ray most, uint bit,
            inout uint asked) {
  uvec2 at = first + ahead;
  if (!inside(at)) {
    return;
  }
  Beam beam = beamAt(fan, vec2(ahead));
  vec3 own = DEPTH_ENABLED ? endOf(fan, beam, at * (TO_SECONDS ? 2u : 1u)) : vec3(0.0f);
  bool unseen = TO_SECONDS && blind(fan, beam, between, error);
  if (!unseen && serves(own, between, error, most)) {
    if (TO_SECONDS) {
      storeSecond(at, between.state, own.x, between.sums.yz, own.x < own.z);
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

// 2 x 2 of them, the first of which has a ray of its own, from the four rows around. `first`: the
// invocation's.
void settleCell(Fan fan, uvec2 first, Row above, Row here, Row next, Row last, uint cell,
                inout uint asked) {
  uvec2 corner = 2u * uvec2(cell % SPREAD_COLUMNS, cell / SPREAD_COLUMNS);
  Ray most = larger(here.most, next.most);
  most.state = vec4(vec3(max(max(most.state.x, most.state.y), most.state.z)), 1.0f);
  Ray below = cubic(above.second, here.second, next.second, last.second);
  Ray belowError = cubicError(above.second, here.second, next.second, last.second);
  Ray across = cubic(above.between, here.between, next.between, last.between);
  Ray acrossError = larger(cubicError(above.between, here.between, next.between, last.between),
                           larger(here.error, next.error));
  if (!TO_SECONDS && inside(first + corner)) {
    take(first + corner, here.second);
  }
  uint bit = ASKED_PER_CELL * cell;
  settle(fan, first, corner + uvec2(1u, 0u), here.between, here.error, most, bit, asked);
  settle(fan, first, corner + uvec2(0u, 1u), below, belowError, most, bit + 1u, asked);
  settle(fan, first, corner + uvec2(1u, 1u), across, acrossError, most, bit + 2u, asked);
}

// The invocation's, of its first cell: eight invocations to a tile on the list, or all over the
// rectangle. One beyond it has nothing to do.
uvec2 firstCell() {
  uvec2 place = gl_GlobalInvocationID.xy;
  if (TILES && !TO_SECONDS) {
    uint number = listedTile();
    if (number >= seconds[TILE_LIST + 3u]) {
      return uvec2(0x7fffu);
    }
    uint tile = seconds[tileListAddress() + number];
    uint part = gl_LocalInvocationID.x;
    place = uvec2(tile & 0xffffu, tile >> 16u) * uvec2(TILE_SECONDS / SPREAD_COLUMNS,
                                                       TILE_SECONDS / SPREAD_CELLS) +
            uvec2(part & 3u, part >> 2u);
  }
  return place * uvec2(SPREAD_COLUMNS, SPREAD_CELLS);
}

void main() {
  ivec2 at = firstRay() + ivec2(firstCell());
  if (!inside(uvec2(at) * 2u)) {
    return;
  }
  Rows above = rowsAt(at - ivec2(0, 1));
  Rows here = rowsAt(at);
  Rows next = rowsAt(at + ivec2(0, 1));
  uvec2 first = uvec2(at) * 2u;
  Fan fan = TO_SECONDS ? fanOf(vec2(first * 2u), 2.0f) : fanOf(vec2(first), 1.0f);
  uint asked = 0u;
  for (int i = 0; i < int(SPREAD_CELLS); ++i) {
    Rows last = rowsAt(at + ivec2(0, i + 2));
    uint cell = SPREAD_COLUMNS * uint(i);
    settleCell(fan, first, above.left, here.left, next.left, last.left, cell, asked);
    settleCell(fan, first, above.right, here.right, next.right, last.right, cell + 1u, asked);
    above = here;
    here = next;
    next = last;
  }
  ask(first, asked);
}
