// SPDX-License-Identifier: MIT
// What the passes of a volume's ambient light share: its lists, RGB each.
#define real float
#include "../interface/transport.glsl"
#include "../interface/ambient.glsl"
#include "late.glsl"
#include "transport_rays.glsl"

layout(set = 0, binding = 0, std140) uniform Volume { AmbientUniforms volume; };
layout(set = 0, binding = 1, std430) buffer Work { vec4 work[]; };
layout(set = 0, binding = 2, std430) buffer Kept { vec4 kept[]; };
layout(push_constant) uniform Push { AmbientPush pushBlock; };
AmbientPush push = pushBlock;

// Lists of `kept`, over all levels: moments of the phase function times albedo, of degree 0 with
// the extinction without the peak (1/m) in w; terms of the source.
int total() {
  return volume.place[TRANSPORT_LEVELS - 1].x + volume.size[TRANSPORT_LEVELS - 1].w;
}
int momentAt(int level, int degree, int cell) {
  return total() * degree + volume.place[level].x + cell;
}
int sourceAt(int level, int term, int cell) {
  return total() * (4 + term) + volume.place[level].x + cell;
}

// Of the finest level: share of the light outside that arrives unscattered.
int openAt(int cell) {
  return total() * (4 + TRANSPORT_TERMS) + cell;
}

// Lists of `work`. Over all levels: what drives the source, the change of the source; of the level
// in turn: source and radiance in each direction.
int driveAt(int level, int term, int cell) {
  return total() * term + volume.place[level].x + cell;
}
int changeAt(int level, int term, int cell) {
  return total() * (TRANSPORT_TERMS + term) + volume.place[level].x + cell;
}
int directedAt(int level, int direction, int cell) {
  return total() * (2 * TRANSPORT_TERMS) + volume.size[level].w * direction + cell;
}
int radianceAt(int level, int direction, int ray) {
  return total() * (2 * TRANSPORT_TERMS) + volume.size[0].w * AMBIENT_DIRECTIONS +
         volume.size[level].w * direction + ray;
}

TransportDirection directionAt(int level, int direction) {
  return volume.directions[level * AMBIENT_DIRECTIONS + direction];
}

vec3 boxOf(vec3 grid) {
  return volume.gridOrigin.xyz + grid * volume.gridSize.xyz;
}
