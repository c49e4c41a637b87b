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

#define PAIR_SHAPE volume.pairShape
#include "pair_shape.glsl"

// Where the light's grid holds a position in the unit box: in its image's first half source over
// pairShape (1/sr per unit irradiance) and extinction without the peak (1/m), in the second the
// source that goes with no shape; of a layer in parts, see gridZonal.
vec3 gridPlace(vec3 box) {
  vec3 cell = box * volume.gridScale.xyz + volume.gridOffset.xyz;
  return clamp(cell, vec3(0.5f), volume.gridEnd.xyz) * (volume.gridEnd.w * vec3(1.0f, 1.0f, 0.5f));
}

vec3 gridSource(vec3 box, float shape, vec4 zonal) {
  vec3 place = gridPlace(box);
  vec3 few = shape * textureLod(viewSource, place, 0.0f).xyz;
  vec4 many = textureLod(viewSource, place + vec3(0.0f, 0.0f, 0.5f), 0.0f);
  return volume.gridScale.w > 0.0f ? max(few + dot(many, zonal), vec3(0.0f)) : few + many.xyz;
}

// Harmonics around a layer's normal of light that travels against a ray, as gridSource takes them.
vec4 gridZonal(vec3 direction) {
  float z = clamp(-dot(volume.gridNormal.xyz, direction), -1.0f, 1.0f);
  float square = z * z;
  return vec4(1.0f, 1.7320508f * z, 1.1180340f * (3.0f * square - 1.0f),
              0.375f * (square * (35.0f * square - 30.0f) + 3.0f));
}

// Longest step of a ray, in a layer half a cell: its slices lie far apart where light comes from
// aside.
float gridStep(vec3 boxStep) {
  vec3 cells = abs(boxStep * volume.gridScale.xyz) * volume.gridScale.w;  // per m
  return 0.5f / max(max(cells.x, cells.y), max(cells.z, 1.0e-20f));
}

// Light of sky and ground that is scattered towards the eye, as radiance.
vec3 ambientAt(vec3 box) {
  vec3 cell = box * volume.ambientScale.xyz + volume.ambientOffset.xyz;
  cell = clamp(cell, vec3(0.5f), volume.ambientEnd.xyz) * volume.ambientEnd.w;
  return textureLod(viewAmbient, cell, 0.0f).xyz;
}
