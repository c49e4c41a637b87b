// SPDX-License-Identifier: MIT
// The list of a surface's pixels, x + 65536 y, behind SURFACE_LIST_HEAD words: how many, and the
// groups of the dispatch that goes through them. Before: surface_mesh.glsl, slices.glsl.
layout(set = 0, binding = 26, std430) buffer List { uint listed[]; };

bool surfaceCovers(ivec2 pixel) {
  bool inside = all(greaterThanEqual(pixel, surface.rect.xy)) &&
                all(lessThan(pixel, surface.rect.zw));
  ivec2 at = inside ? pixel - surface.rect.xy : ivec2(0);
  return inside && surfaceCover[at.y * (surface.rect.z - surface.rect.x) + at.x].chord > 0;
}

// Places for so many pixels: the index of the first.
uint takePlaces(uint count) {
  uint at = atomicAdd(listed[0], count);
  atomicMax(listed[2], (at + count - 1u) / (64u * LIST_ROW) + 1u);
  return SURFACE_LIST_HEAD + at;
}

// Of the invocation with this number; x is below 0 where there is none.
ivec2 listedPixel(uint number) {
  uint both = listed[SURFACE_LIST_HEAD + min(number, max(listed[0], 1u) - 1u)];
  return number < listed[0] ? ivec2(both & 0xffffu, both >> 16u) : ivec2(-1);
}
