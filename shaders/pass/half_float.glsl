// SPDX-License-Identifier: MIT
// To the nearest half float: lavapipe truncates on storing; after this the truncation is exact.
vec3 roundedToHalf(vec3 v) {
  vec2 rg = unpackHalf2x16(packHalf2x16(v.xy));
  vec2 b = unpackHalf2x16(packHalf2x16(vec2(v.z, 0.0f)));
  return vec3(rg, b.x);
}
