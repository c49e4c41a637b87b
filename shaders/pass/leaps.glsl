// SPDX-License-Identifier: MIT
// How far a ray may go before it can meet anything: bricks of 8^3 voxels hold the distance, in
// bricks along the axis where it is longest, to the nearest one in which a sample may be above 0
// (src/frame/bricks.hpp); all nearer ones are empty.
layout(constant_id = 12) const bool LEAPS = false;

// Whole steps of `dt` (m) from a position in the unit box, all of whose samples are 0.
float emptySteps(vec3 box, vec3 boxStep, float dt) {
  vec3 voxel = clamp(box * fieldVoxels - 0.5f, vec3(0.0f), fieldVoxels - 1.0f);
  vec3 brick = floor(voxel * 0.125f);
  float away = floor(texelFetch(leaps, ivec3(brick), 0).x * 255.0f + 0.5f);
  // To the faces of the cube of empty bricks around this one.
  vec3 rate = boxStep * fieldVoxels;
  vec3 low = voxel - 8.0f * (brick + 1.0f - away);
  vec3 high = 8.0f * (brick + away) - voxel;
  vec3 room = mix(low, high, greaterThan(rate, vec3(0.0f))) / max(abs(rate), vec3(1.0e-12f));
  float m = min(room.x, min(room.y, room.z));
  return away > 0.0f ? floor(m / dt) : 0.0f;
}
