// SPDX-License-Identifier: MIT
// How far a ray may go before it can meet anything: bricks of 8^3 voxels hold the distance, in
// bricks along the axis where it is longest, to the nearest one in which a sample may be above 0
// (src/frame/bricks.hpp); all nearer ones are empty.
layout(constant_id = 12) const bool LEAPS = false;

// What emptySteps() needs of a ray, before its loop.
struct LeapRay {
  vec3 ahead;     // 1 along axes on which the box's position rises, else 0
  vec3 perVoxel;  // steps
};

LeapRay leapRay(vec3 boxStep, float dt) {
  vec3 rate = boxStep * fieldVoxels;
  LeapRay ray;
  ray.ahead = mix(vec3(0.0f), vec3(1.0f), greaterThan(rate, vec3(0.0f)));
  ray.perVoxel = 1.0f / max(abs(rate) * dt, vec3(1.0e-12f));
  return ray;
}

// Whole steps from a position in the unit box, all of whose samples are 0.
float emptySteps(vec3 box, LeapRay ray) {
  vec3 voxel = clamp(box * fieldVoxels - 0.5f, vec3(0.0f), fieldVoxels - 1.0f);
  vec3 brick = floor(voxel * 0.125f);
  float away = floor(texelFetch(leaps, ivec3(brick), 0).x * 255.0f + 0.5f);
  // To the faces of the cube of empty bricks around this one.
  vec3 inside = voxel - 8.0f * brick;
  vec3 room = (8.0f * (away - 1.0f) + mix(inside, 8.0f - inside, ray.ahead)) * ray.perVoxel;
  return away > 0.0f ? floor(min(room.x, min(room.y, room.z))) : 0.0f;
}
