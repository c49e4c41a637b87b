// SPDX-License-Identifier: MIT
// The pixels that a surface covers, as lists for its shading, and what the others are in the
// picture. Drivers such as lavapipe take all lanes through the shading, whether their pixel asks
// for it or not, and a body covers a part of its rectangle; the first one's is that of all.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common.glsl"
#include "../interface/slices.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 14) const bool DISTANCE = false;

layout(set = 0, binding = 0, std140) uniform Frame { FrameUniforms frameBlock; };
FrameUniforms frame = frameBlock;
layout(set = 0, binding = 6, std430) buffer FrameState { vec4 frameState[]; };
layout(set = 0, binding = 18, std430) buffer Distances { vec4 distances[]; };
layout(push_constant) uniform Push { SliceConstants sliceBlock; };
SliceConstants slice = sliceBlock;

#include "surface_mesh.glsl"
#include "surface_list.glsl"

// Light scattered more than once in every fourth pixel along both axes first, then in every second
// one: they have lists of their own.
layout(constant_id = 13) const bool HALF = false;
// An invocation takes a cell of so many pixels along both axes, so that it counts up once for all.
// Cells begin at fourth pixels.
const uint CELL = SURFACE_CELL;
// Bits of a cell, row by row.
const uint FOURTHS = HALF ? 0x0001u : 0xffffu;
const uint SECONDS = 0x0504u;

bool surfaceCovers(ivec2 pixel) {
  bool inside = inRect(pixel);
  return inside && coverOf(inside ? coverIndex(pixel) : 0u).chord > 0;
}

// What a pixel without the surface is.
void pass(ivec2 pixel) {
  uint index = uint(pixel.y) * uint(frame.viewport.x) + uint(pixel.x);
  bool first = (slice.flags & SLICE_FIRST_VOLUME) != 0u;
  if (first) {
    frameState[index] = vec4(0.0f, 0.0f, 0.0f, 1.0f);
  }
  if (DISTANCE) {
    distances[index] = first ? vec4(0.0f) : vec4(distances[index].xy, 0.0f, 0.0f);
  }
}

ivec2 pixelOf(ivec2 corner, uint bit) {
  return corner + ivec2(bit % CELL, bit / CELL);
}

void list(ivec2 corner, uint bits, uint to) {
  if (bits != 0u) {
    uint number = takePlaces(to, uint(bitCount(bits)));
    while (bits != 0u) {
      ivec2 pixel = pixelOf(corner, uint(findLSB(bits)));
      listed[listAddress(to, number)] = uint(pixel.x) | (uint(pixel.y) << 16u);
      number += 1u;
      bits &= bits - 1u;
    }
  }
}

void main() {
  ivec2 corner = surface.shade.xy / int(CELL) * int(CELL) + ivec2(gl_GlobalInvocationID.xy * CELL);
  uint covered = 0u;
  uint others = 0u;
  ivec4 shade = surface.shade;
  for (uint bit = 0u; bit < CELL * CELL; ++bit) {
    ivec2 pixel = pixelOf(corner, bit);
    if (all(greaterThanEqual(pixel, shade.xy)) && all(lessThan(pixel, shade.zw))) {
      bool mine = surfaceCovers(pixel);
      covered |= uint(mine) << bit;
      others |= uint(!mine) << bit;
    }
  }
  list(corner, covered & FOURTHS, SURFACE_LIST_FOURTHS);
  if (HALF) {
    list(corner, covered & SECONDS, SURFACE_LIST_SECONDS);
    list(corner, covered & ~(FOURTHS | SECONDS), SURFACE_LIST_OTHERS);
    for (uint seconds = others & (FOURTHS | SECONDS); seconds != 0u; seconds &= seconds - 1u) {
      ivec2 pixel = pixelOf(corner, uint(findLSB(seconds)));
      if (inRect(pixel)) {
        surfaceRows[coverIndex(pixel)] = uvec4(0u);
      }
    }
  }
  while (others != 0u) {
    pass(pixelOf(corner, uint(findLSB(others))));
    others &= others - 1u;
  }
}
