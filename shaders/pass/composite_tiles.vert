// SPDX-License-Identifier: MIT
// Rows of tiles in which the only volume may be seen (eye_tiles.comp): two triangles each.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common.glsl"
#include "../interface/slices.glsl"

layout(set = 0, binding = 0, std140) uniform Frame { FrameUniforms frame; };
layout(set = 0, binding = 14, std430) readonly buffer SecondPixels { uint seconds[]; };

#include "second_tiles.glsl"

void main() {
  uint row = seconds[rowsAddress() + uint(gl_VertexIndex) / ROW_CORNERS];
  uint corner = uint(gl_VertexIndex) % ROW_CORNERS;
  uint which = corner < 3u ? corner : 6u - corner;  // 0 1 2, 3 2 1: bit by bit right and below
  uvec2 tile = uvec2(row % ROW_Y, row % ROW_LENGTH / ROW_Y);
  tile += uvec2((which & 1u) * (row / ROW_LENGTH + 1u), which >> 1u);
  vec4 rect = frame.volumeRect;
  vec2 pixel = 2.0f * floor(0.5f * rect.xy) + float(2u * TILE_SECONDS) * vec2(tile);
  vec2 ndc = clamp(pixel, rect.xy, rect.zw) * frame.viewport.zw * 2.0f - 1.0f;
  gl_Position = vec4(ndc, 0.0f, 1.0f);
}
