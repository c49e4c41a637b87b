// SPDX-License-Identifier: MIT
// Tiles of 16 x 16 pixels of a volume with empty bricks, once all second pixels' rays are known: a
// list of those in which or next to which a ray saw anything or was cut short by a surface, and one
// of the others, in which eye_spread.comp could only leave what an empty ray leaves.
// An invocation looks at ROW_TILES tiles beside each other.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common.glsl"
#include "../interface/slices.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0, std140) uniform Frame { FrameUniforms frameBlock; };
FrameUniforms frame = frameBlock;
layout(set = 0, binding = 1, std140) uniform Volume { VolumeUniforms volumeBlock; };
VolumeUniforms volume = volumeBlock;
layout(push_constant) uniform Push { SliceConstants sliceBlock; };
SliceConstants slice = sliceBlock;

const bool DEPTH_ENABLED = false;
const bool DISTANCE = false;
const bool TILES = true;
#include "second_pixels.glsl"

// Whether a ray of a tile or of those above and below saw anything: cubics reach two second pixels.
bool columnSeen(int x, int y, ivec2 last) {
  int column = clamp(x, 0, last.x);
  bool seen = false;
  for (int i = -1; i <= 1; ++i) {
    uvec2 tile = uvec2(column, clamp(y + i, 0, last.y));
    seen = seen || seconds[tileAddress(tile)] == marchNumber();
  }
  return seen;
}

// Room for so many on a list whose dispatch takes TILE_PARTS invocations for each.
uint room(uint list, uint count) {
  if (count == 0u) {
    return 0u;
  }
  uint at = atomicAdd(seconds[list + 3u], count);
  atomicMax(seconds[list + 1u], (at + count - 1u) * TILE_PARTS / (64u * LIST_ROW) + 1u);
  return at;
}

// Of tiles from `first` on, a bit each.
void listTiles(uvec2 first, uint tiles) {
  uint at = tileListAddress() + room(TILE_LIST, uint(bitCount(tiles)));
  while (tiles != 0u) {
    seconds[at] = (first.x + uint(findLSB(tiles))) | (first.y << 16u);
    at += 1u;
    tiles &= tiles - 1u;
  }
}

void listOthers(uvec2 first, uint tiles) {
  uint at = rowsAddress() - room(CLEAR_LIST, uint(bitCount(tiles)));
  while (tiles != 0u) {
    at -= 1u;
    seconds[at] = (first.x + uint(findLSB(tiles))) | (first.y << 16u);
    tiles &= tiles - 1u;
  }
}

void listRows(uvec2 first, uint tiles) {
  uint rows = uint(bitCount(tiles & ~(tiles << 1u)));
  if (rows == 0u) {
    return;
  }
  uint at = rowsAddress() + atomicAdd(seconds[TILE_DRAW], ROW_CORNERS * rows) / ROW_CORNERS;
  while (tiles != 0u) {
    uint begin = uint(findLSB(tiles));
    uint count = uint(findLSB(~(tiles >> begin)));
    seconds[at] = first.x + begin + ROW_Y * first.y + ROW_LENGTH * (count - 1u);
    at += 1u;
    tiles &= ~(((1u << count) - 1u) << begin);
  }
}

void main() {
  uvec2 first = uvec2(gl_GlobalInvocationID.x * ROW_TILES, gl_GlobalInvocationID.y);
  uvec2 last = lastTile();
  if (first.x > last.x || first.y > last.y) {
    return;
  }
  ivec2 at = ivec2(first);
  bool before = columnSeen(at.x - 1, at.y, ivec2(last));
  bool here = columnSeen(at.x, at.y, ivec2(last));
  uint seen = 0u;
  for (int i = 0; i < int(ROW_TILES); ++i) {
    bool next = columnSeen(at.x + i + 1, at.y, ivec2(last));
    seen |= before || here || next ? 1u << uint(i) : 0u;
    before = here;
    here = next;
  }
  uint all = (1u << min(last.x - first.x + 1u, ROW_TILES)) - 1u;
  listTiles(first, seen & all);
  listOthers(first, ~seen & all);
  listRows(first, seen & all);
}
