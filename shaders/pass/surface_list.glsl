// SPDX-License-Identifier: MIT
// The lists of pixels that a surface covers, see SURFACE_LIST_HEAD. Before: surface_mesh.glsl,
// `frame`.
layout(set = 0, binding = 26, std430) buffer List { uint listed[]; };

// Whether a pixel has a row of the cover.
bool inRect(ivec2 pixel) {
  return all(greaterThanEqual(pixel, surface.rect.xy)) && all(lessThan(pixel, surface.rect.zw));
}

uint coverIndex(ivec2 pixel) {
  return uint(pixel.y - surface.rect.y) * uint(surface.rect.z - surface.rect.x) +
         uint(pixel.x - surface.rect.x);
}

// Where a list's pixel with this number is kept.
uint listAddress(uint list, uint number) {
  uint first = SURFACE_LIST_HEAD;
  uint pixels = uint(frame.viewport.x) * uint(frame.viewport.y);
  if (list == SURFACE_LIST_SECONDS || list == SURFACE_LIST_OWN) {
    first += pixels;
  }
  bool back = list == SURFACE_LIST_OTHERS || list == SURFACE_LIST_OWN;
  return back ? first + pixels - 1u - number : first + number;
}

// Places for so many pixels: the number of the first. Rows have a power of 2 of groups, so that
// shifts will do: lavapipe divides integers lane by lane.
uint takePlaces(uint list, uint count) {
  uint at = atomicAdd(listed[4u * list + 3u], count);
  uint row = 6u + uint(findMSB(listed[4u * list]));
  uint last = (at + count - 1u) >> row;
  if (at == 0u || last > (at - 1u) >> row) {  // else who had the place before has counted this row
    atomicMax(listed[4u * list + 1u], last + 1u);
  }
  return at;
}

// Of the invocation in a list's dispatch; x is below 0 where there is none.
ivec2 listedPixel(uint list) {
  uint row = gl_WorkGroupID.y * listed[4u * list];
  uint number = (row + gl_WorkGroupID.x) * 64u + gl_LocalInvocationIndex;
  uint count = listed[4u * list + 3u];  // never 0 where an invocation is
  uint both = listed[listAddress(list, min(number, count - 1u))];
  return number < count ? ivec2(both & 0xffffu, both >> 16u) : ivec2(-1);
}

// For its own light; fourth pixels are a list of such.
void listOwn(ivec2 pixel, uint list) {
  if (list != SURFACE_LIST_FOURTHS) {
    uint own = list == SURFACE_LIST_SECONDS ? SURFACE_LIST_OWN_SECONDS : SURFACE_LIST_OWN;
    uint number = takePlaces(own, 1u);
    listed[listAddress(own, number)] = uint(pixel.x) | (uint(pixel.y) << 16u);
  }
}
