// SPDX-License-Identifier: MIT
// What a volume's tables and grid say about light on its way to the eye.

// ln of the source distribution (1/sr, RGB) of a field: x along the scattering depth, whose first
// node is single scattering, y along the angle.
vec3 logFieldSource(uint field, float depth, float angle) {
  vec2 uv = (vec2(depth * 31.0f, angle * float(CURVE_NODES - 1)) + 0.5f) /
            vec2(32.0f, float(CURVE_NODES));
  return textureLod(scatteringTable, vec3(uv, float(field)), 0.0f).xyz;
}

vec3 fieldSource(uint field, float depth, float angle) {
  return exp(logFieldSource(field, depth, angle));
}

// What the light's grid holds at a position in the unit box: source (1/sr per unit irradiance) and
// extinction without the peak (1/m).
vec4 gridAt(vec3 box) {
  vec3 cell = box * volume.gridScale.xyz + volume.gridOffset.xyz;
  cell = clamp(cell, vec3(0.5f), volume.gridEnd.xyz) * volume.gridEnd.w;
  return textureLod(viewSource, cell, 0.0f);
}

// Light of sky and ground that is scattered towards the eye, as radiance.
vec3 ambientAt(vec3 box) {
  vec3 cell = box * volume.ambientScale.xyz + volume.ambientOffset.xyz;
  cell = clamp(cell, vec3(0.5f), volume.ambientEnd.xyz) * volume.ambientEnd.w;
  return textureLod(viewAmbient, cell, 0.0f).xyz;
}
