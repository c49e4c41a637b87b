// SPDX-License-Identifier: MIT
// What the passes of the light grid share: its lists.
#define real float
#include "../interface/transport.glsl"
#include "late.glsl"
#include "transport_rays.glsl"

layout(set = 0, binding = 0, std140) uniform Volume { TransportUniforms volume; };
layout(set = 0, binding = 1, std430) buffer Work { float work[]; };
layout(set = 0, binding = 2, std430) buffer Kept { float kept[]; };
layout(set = 0, binding = 11, std430) buffer Swept { float swept[]; };
layout(push_constant) uniform Push { TransportPush pushBlock; };
TransportPush push = pushBlock;

// Lists of `kept`. Over all levels: extinction without the peak (1/m), light that is scattered
// there first, moments of the phase function times albedo (degrees 0 to 4), terms of the source; of
// the finest level: terms of the light scattered once.
int total() {
  return volume.place[TRANSPORT_LEVELS - 1].x + volume.size[TRANSPORT_LEVELS - 1].w;
}
int extinctionAt(int level, int cell) {
  return volume.place[level].x + cell;
}
int lightAt(int level, int cell) {
  return total() + volume.place[level].x + cell;
}
int momentAt(int level, int degree, int cell) {
  return total() * (2 + degree) + volume.place[level].x + cell;
}
int sourceAt(int level, int term, int cell) {
  return total() * (7 + term) + volume.place[level].x + cell;
}
// Terms of the light scattered once, then of that scattered twice, over the phase functions.
int firstAt(int term, int cell) {
  return total() * (7 + TRANSPORT_TERMS) + volume.size[0].w * term + cell;
}

// What the level below the finest found by itself: terms as above, then those of its source.
int coarseAt(int term, int cell) {
  return total() * (7 + TRANSPORT_TERMS) + volume.size[0].w * (2 * FIRST_TERMS) +
         volume.size[1].w * term + cell;
}

bool isLayer() {
  return late(volume.travel.w > 0.0f);
}
// A layer's responses: of nodes, for light scattered twice and three times; of directions, twice;
// moments of light scattered twice.
int responseAt(int node, int order) {
  return coarseAt(2 * FIRST_TERMS + TRANSPORT_TERMS, 0) + (node * 2 + order) * FIRST_TERMS;
}
const int RESPONSE_NODES = RESPONSE_ZENITHS * RESPONSE_AZIMUTHS;

// Lists of `work`. Over all levels: what drives the source, the change of the source; of the level
// in turn: source in each direction, and alone in `swept`, so that neither is larger than devices
// take, radiance.
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
  return volume.size[level].w * direction + ray;
}

// Where a dispatch is one of several: its place among all of the step's groups or rows of groups.
// gl_WorkGroupSize is 1 here, before the kernel has declared its own.
int threadOfStep() {
  return int(gl_GlobalInvocationID.x + push.first * TRANSPORT_GROUP);
}
int rowOfStep() {
  return int(gl_WorkGroupID.y + push.first);
}

TransportDirection directionAt(int level, int direction) {
  return volume.directions[level * TRANSPORT_DIRECTIONS + direction];
}

vec3 boxOf(vec3 grid) {
  return volume.gridOrigin.xyz + grid * volume.gridSize.xyz;
}
