// SPDX-License-Identifier: MIT
// How far a ray may go before it can meet anything: bricks of 8^3 voxels hold the distance, in
// bricks along the axis where it is longest, to the nearest one in which a sample may be above 0
// (src/frame/bricks.hpp); all nearer ones are empty. Where that is the brick itself, it holds which
// of its eighths samples above 0 may lie in.
layout(constant_id = 12) const bool LEAPS = false;

// What emptyStretches() needs of a ray, before its loop.
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

// Samples, a step from one another, that are 0: from the one at a position in the unit box on.
float emptySamples(vec3 box, LeapRay ray) {
  vec3 place = box * fieldVoxels - 0.5f;
  vec3 voxel = clamp(place, vec3(0.0f), fieldVoxels - 1.0f);
  vec3 brick = floor(voxel * 0.125f);
  vec2 leap = floor(texelFetch(leaps, ivec3(brick), 0).xy * 255.0f + 0.5f);
  vec3 second = step(vec3(4.0f), voxel - 8.0f * brick);
  uint eighth = uint(second.x + 2.0f * second.y + 4.0f * second.z);
  bool emptyEighth = (uint(leap.y) >> eighth & 1u) == 0u;
  // To the faces of the cube of empty bricks around this one, or of its eighth. What lies before
  // the volume's first voxels is as they are: else a ray along its face would not come away from
  // it.
  bool whole = leap.x > 0.0f;
  float edge = whole ? 8.0f : 4.0f;
  vec3 corner = 8.0f * brick + (whole ? vec3(0.0f) : 4.0f * second);
  vec3 inside = place - corner;
  vec3 behind = inside + mix(vec3(0.0f), vec3(1.0f), lessThan(corner, vec3(0.5f)));
  vec3 room = (max(8.0f * (leap.x - 1.0f), 0.0f) + mix(behind, edge - inside, ray.ahead)) *
              ray.perVoxel;
  return whole || emptyEighth ? 1.0f + floor(min(room.x, min(room.y, room.z))) : 0.0f;
}

// How many stretches are empty from the one on that begins at s and ends `first` steps on.
float emptyStretches(vec3 box, vec3 boxStep, LeapRay ray, float s, float last, float dt,
                     float first) {
  float count = 0.0f;
  float more = 1.0f;
  float near = s;
  // In rounds of their own, which are shorter than the march's.
  while (more > 0.0f && near < last) {
    float far = min((first + count) * dt, last);
    more = emptySamples(box + 0.5f * (near + far) * boxStep, ray);
    count += more;
    near = min((first + count - 1.0f) * dt, last);
  }
  return count;
}
