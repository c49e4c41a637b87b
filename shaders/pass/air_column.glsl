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

// The opacity in green that the table's shares count by, of what scatters: light is in proportion
// to that, while ozone would be most of the opacity where there is hardly any. Of columns to
// infinity, whose last decimals do not matter here.
float skyTableOpacity(Air air, AirPath path, AirPoint first, AirPoint lowest, AirPoint last) {
  bool bends = path.lowest > 0.0f && path.lowest < path.reach;
  vec3 a = vec3(0.0f);
  vec3 b = vec3(0.0f);
  vec3 low = vec3(0.0f);
  if (AIR_ENABLED) {
    a.x = first.air.column;
    b.x = last.air.column;
    low.x = lowest.air.column;
  }
  if (FOG_ENABLED) {
    a.y = first.fog.column;
    b.y = last.fog.column;
    low.y = lowest.fog.column;
  }
  vec3 columns = bends ? 2.0f * low - a - b : abs(a - b);
  return oneMinusExp(scatteringDepth(air, max(columns, vec3(0.0f))).y);
}

// first: the ray's origin; lowest: its point nearest the planet's centre within its reach.
vec3 columnsTo(Air air, AirPath path, AirPoint first, AirPoint lowest, AirPoint there) {
  bool past = there.distance > lowest.distance && lowest.distance > 0.0f;
  AirPoint turn = past ? lowest : there;
  AirSpan before = airSpan(air, path, first, turn);
  AirSpan after = airSpan(air, path, turn, there);
  return columnsOf(before) + columnsOf(after);
}
