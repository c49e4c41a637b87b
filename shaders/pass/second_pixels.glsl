// SPDX-License-Identifier: MIT
// What every second pixel shows, and the list of those that need rays of their own: one buffer, see
// LIST_HEAD. Second pixel (i, j) is pixel (2 i, 2 j); all of them have rays, or every second one
// along both axes, a fourth pixel, has. Those of the last rows and columns may lie outside of the
// view, by three pixels at most, so that all pixels have neighbours around them.
layout(set = 0, binding = 11, std430) buffer SecondPixels { uint seconds[]; };
// The same buffer, row by row.
layout(set = 0, binding = 11, std430) buffer SecondRays { vec4 secondRays[]; };
layout(set = 0, binding = 21) uniform usamplerBuffer secondTexels;
#include "texels.glsl"

// Words of a second pixel.
const uint SECOND_WORDS = DEPTH_ENABLED || DISTANCE ? SECOND_SIZE : SECOND_SIZE / 2u;

uvec2 firstSecond() {
  return uvec2(volume.rect.xy) / 2u;
}

uvec2 lastSecond() {
  return uvec2(volume.rect.zw) / 2u;
}

uvec2 firstFourth() {
  return firstSecond() / 2u;
}

uvec2 lastFourth() {
  return (lastSecond() + 1u) / 2u;
}

#include "second_tiles.glsl"

// In secondRays.
uint secondAddress(uvec2 second) {
  return (LIST_HEAD + SECOND_WORDS * (second.y * secondsOfView().x + second.x)) / 4u;
}

// What an earlier dispatch has left there.
vec4 secondRow(uint address) {
  if (TEXELS) {
    return uintBitsToFloat(texelFetch(secondTexels, int(address)));
  }
  return secondRays[address];
}

uint listAddress() {
  return LIST_HEAD + SECOND_WORDS * secondsOfView().x * secondsOfView().y;
}

// What a ray leaves that meets nothing.
const vec4 NOTHING = vec4(0.0f, 0.0f, 0.0f, 1.0f);

uvec2 lastTile() {
  return (lastSecond() - firstSecond()) / TILE_SECONDS;
}

// Of a list of tiles, with eight invocations to each.
uint listedTile() {
  return (gl_WorkGroupID.y * LIST_ROW + gl_WorkGroupID.x) * TILE_PARTS + gl_LocalInvocationID.y;
}

uint marchNumber() {
  return slice.flags / SLICE_MARCH;
}

// `hidden`: what the volumes' distance needs; `cut`: short of the box's end.
void storeSecond(uvec2 second, vec4 state, float end, vec2 hidden, bool cut) {
  uint at = secondAddress(second);
  bool seen = any(notEqual(state, NOTHING)) || (DISTANCE && any(notEqual(hidden, vec2(0.0f))));
  if (TILES && (cut || seen)) {
    uvec2 first = firstSecond();
    seconds[tileAddress((max(second, first) - first) / TILE_SECONDS)] = marchNumber();
  }
  secondRays[at] = state;
  if (DEPTH_ENABLED || DISTANCE) {
    secondRays[at + 1u] = vec4(end, hidden, cut ? 1.0f : 0.0f);
  }
}

// Of one list's pixels, or second pixels.
uvec2 listed(uint number) {
  uint both = seconds[listAddress() + number];
  return uvec2(both & 0xffffu, both >> 16u);
}

// Where the opaque depth of a ray is read: it may lie outside of the view.
ivec2 insideView(uvec2 pixel) {
  return ivec2(min(pixel, uvec2(frame.viewport.xy) - 1u));
}
