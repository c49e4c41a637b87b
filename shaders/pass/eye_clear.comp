// SPDX-License-Identifier: MIT
// Tiles in which the first volume is not seen (eye_tiles.comp): what an empty ray leaves.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common.glsl"
#include "../interface/slices.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 14) const bool DISTANCE = false;

layout(set = 0, binding = 0, std140) uniform Frame { FrameUniforms frameBlock; };
FrameUniforms frame = frameBlock;
layout(set = 0, binding = 1, std140) uniform Volume { VolumeUniforms volumeBlock; };
VolumeUniforms volume = volumeBlock;
layout(set = 0, binding = 10, std430) buffer FrameState { vec4 frameState[]; };
layout(set = 0, binding = 19, std430) buffer Distances { vec4 distances[]; };
layout(push_constant) uniform Push { SliceConstants sliceBlock; };
SliceConstants slice = sliceBlock;

const bool DEPTH_ENABLED = false;
const bool TILES = true;
#include "second_pixels.glsl"

const uint TILE_PIXELS = 2u * TILE_SECONDS;

void main() {
  uint number = listedTile();
  if (number >= seconds[CLEAR_LIST + 3u]) {
    return;
  }
  uint tile = seconds[rowsAddress() - 1u - number];
  uvec2 corner = 2u * firstSecond() + TILE_PIXELS * uvec2(tile & 0xffffu, tile >> 16u);
  for (uint i = 0u; i < TILE_PIXELS * TILE_PIXELS / TILE_PARTS; ++i) {
    uint of = TILE_PARTS * i + gl_LocalInvocationID.x;
    uvec2 pixel = corner + uvec2(of % TILE_PIXELS, of / TILE_PIXELS);
    if (pixel.x < uint(volume.rect.z) && pixel.y < uint(volume.rect.w)) {
      uint index = pixel.y * uint(frame.viewport.x) + pixel.x;
      frameState[index] = NOTHING;
      if (DISTANCE) {
        distances[index] = vec4(0.0f);
      }
    }
  }
}
