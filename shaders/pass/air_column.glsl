// SPDX-License-Identifier: MIT
// Columns of air, fog and absorber from a ray's origin to a point of it, in closed form. m.

// A ray below the horizon goes on to this distance in the sky table: surfaces may lie below sea
// level. m. Not where the table holds all light: with the sun in the horizon the light of the last
// metres above the ground has nothing to do with that below; deeper surfaces have the ground's.
const float SHORTEST_RAY = 2000.0f;
const float SHORTEST_LIT_RAY = 1.0f;

float skyTableReach(float ground, bool allLight) {
  float shortest = allLight && ground > 0.0f ? SHORTEST_LIT_RAY : SHORTEST_RAY;
  return ground >= 0.0f ? max(ground, shortest) : INFINITE_DISTANCE;
}

// first: the ray's origin; lowest: its point nearest the planet's centre within its reach.
vec3 columnsTo(Air air, AirPath path, AirPoint first, AirPoint lowest, AirPoint there) {
  bool past = there.distance > lowest.distance && lowest.distance > 0.0f;
  AirPoint turn = past ? lowest : there;
  AirSpan before = airSpan(air, path, first, turn);
  AirSpan after = airSpan(air, path, turn, there);
  return columnsOf(before) + columnsOf(after);
}
