// SPDX-License-Identifier: MIT
// What a volume's tables and grid say about light on its way to the eye.

// 1 + the field whose droplets have a diameter per voxel, 0: none. Its nodes' layers stand behind
// those of the fields (src/particles/diameter_nodes.hpp).
layout(constant_id = 15) const uint DIAMETERS = 0u;
layout(set = 0, binding = 20) uniform sampler3D diameters;  // in nodes, the first is 0
const float LAST_DIAMETER = 23.0f;

// ln of the source distribution (1/sr, RGB) in a layer: x along the scattering depth, whose first
// node is single scattering, y along the angle.
vec3 logLayerSource(float layer, float depth, float angle) {
  vec2 uv = (vec2(depth * 31.0f, angle * float(CURVE_NODES - 1)) + 0.5f) /
            vec2(32.0f, float(CURVE_NODES));
  return textureLod(scatteringTable, vec3(uv, layer), 0.0f).xyz;
}

bool variesInside(uint field) {
  return DIAMETERS != 0u && DIAMETERS == field + 1u;
}

// Of a field at a position in the unit box. Between diameters the mean is geometric: of cloud and
// rain within 1 % (rms over angles) of the curve of that diameter, of fog, whose nodes lie 31 %
// apart, within 3 % (DiameterNodes.BetweenThemTheMeanIsNear).
vec3 logFieldSource(uint field, float depth, float angle, vec3 box) {
  if (!variesInside(field)) {
    return logLayerSource(float(field), depth, angle);
  }
  float node = clamp(textureLod(diameters, box, 0.0f).x, 0.0f, LAST_DIAMETER);
  float low = min(floor(node), LAST_DIAMETER - 1.0f);
  float layer = float(FIELD_COUNT) + low;
  return mix(logLayerSource(layer, depth, angle), logLayerSource(layer + 1.0f, depth, angle),
             node - low);
}

vec3 fieldSource(uint field, float depth, float angle, vec3 box) {
  return exp(logFieldSource(field, depth, angle, box));
}

#define PAIR_SHAPE volumeBlock.pairShape
#include "pair_shape.glsl"

// Copies, see common.glsl.
vec4 gridScale_ = volume.gridScale;
vec3 gridOffset_ = volume.gridOffset.xyz;
vec4 gridEnd_ = volume.gridEnd;
vec3 ambientScale_ = volume.ambientScale.xyz;
vec3 ambientOffset_ = volume.ambientOffset.xyz;
vec4 ambientEnd_ = volume.ambientEnd;

// Where the light's grid holds a position in the unit box: in its image's first half source over
// pairShape (1/sr per unit irradiance) and extinction without the peak (1/m), in the second the
// source that goes with no shape; of a layer in parts, see gridZonal.
vec3 gridPlace(vec3 box) {
  vec3 cell = box * gridScale_.xyz + gridOffset_;
  return clamp(cell, vec3(0.5f), gridEnd_.xyz) * (gridEnd_.w * vec3(1.0f, 1.0f, 0.5f));
}

vec3 gridSource(vec3 box, float shape, vec4 zonal) {
  vec3 place = gridPlace(box);
  vec3 few = shape * textureLod(viewSource, place, 0.0f).xyz;
  vec4 many = textureLod(viewSource, place + vec3(0.0f, 0.0f, 0.5f), 0.0f);
  return gridScale_.w > 0.0f ? max(few + dot(many, zonal), vec3(0.0f)) : few + many.xyz;
}

// Harmonics around a layer's normal of light that travels against a ray, as gridSource takes them.
vec4 gridZonal(vec3 direction) {
  float z = clamp(-dot(volume.gridNormal.xyz, direction), -1.0f, 1.0f);
  float square = z * z;
  return vec4(1.0f, 1.7320508f * z, 1.1180340f * (3.0f * square - 1.0f),
              0.375f * (square * (35.0f * square - 30.0f) + 3.0f));
}

// Longest step of a ray in a flat volume: by slabs alone steps are long in one lit from aside.
float flatStep(vec3 boxStep) {
  vec3 stretches = abs(boxStep) * volume.flatStretches.xyz;  // per m
  return 1.0f / max(max(stretches.x, stretches.y), max(stretches.z, 1.0e-20f));
}

// Light of sky and ground that is scattered towards the eye, as radiance.
vec3 ambientAt(vec3 box) {
  vec3 cell = box * ambientScale_ + ambientOffset_;
  cell = clamp(cell, vec3(0.5f), ambientEnd_.xyz) * ambientEnd_.w;
  return textureLod(viewAmbient, cell, 0.0f).xyz;
}
