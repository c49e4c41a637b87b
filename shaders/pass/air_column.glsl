// SPDX-License-Identifier: MIT
// Columns of air and fog from a ray's origin to a point of it, in closed form. m.

// A ray below the horizon goes on to this distance in the sky table: surfaces may lie below sea
// level. m.
const float SHORTEST_RAY = 2000.0f;

float skyTableReach(float ground) {
  return ground >= 0.0f ? max(ground, SHORTEST_RAY) : INFINITE_DISTANCE;
}

// The opacity in green that the table's shares count by: of columns to infinity, whose last
// decimals do not matter here.
float skyTableOpacity(Air air, AirPath path, AirPoint first, AirPoint lowest, AirPoint last) {
  bool bends = path.lowest > 0.0f && path.lowest < path.reach;
  vec2 a = vec2(0.0f);
  vec2 b = vec2(0.0f);
  vec2 low = vec2(0.0f);
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
  vec2 columns = bends ? 2.0f * low - a - b : abs(a - b);
  return oneMinusExp(depthOfColumns(air, max(columns, vec2(0.0f))).y);
}

// first: the ray's origin; lowest: its point nearest the planet's centre within its reach.
vec2 columnsTo(Air air, AirPath path, AirPoint first, AirPoint lowest, AirPoint there) {
  bool past = there.distance > lowest.distance && lowest.distance > 0.0f;
  AirPoint turn = past ? lowest : there;
  AirSpan before = airSpan(air, path, first, turn);
  AirSpan after = airSpan(air, path, turn, there);
  return vec2(before.air.column + after.air.column, before.fog.column + after.fog.column);
}
