// SPDX-License-Identifier: MIT
// Aerial perspective up to the middle of each froxel: radiance, and the mean transmittance of the
// three colours. Slices of equal depth, two steps for each. An invocation makes a column: the
// published passes march from the eye to each froxel anew, 17 times the steps for the same values.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "air.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 10) uniform writeonly image3D table;

void main() {
  uvec2 texel = gl_GlobalInvocationID.xy;
  vec2 at = (vec2(texel) + 0.5f) / FROXELS * 2.0f - 1.0f;
  vec3 ray = normalize(scene.forward.xyz + scene.right.xyz * at.x - scene.up.xyz * at.y);
  float altitude = scene.ground.w;
  float along = dot(ray, scene.light.xyz);
  float phase = rayleighPhase(along);
  float slice = scene.light.w / FROXELS;
  March march;
  march.radiance = vec3(0.0f);
  march.throughput = vec3(1.0f);
  float begin = 0.0f;
  for (float k = 0.0f; k < FROXELS; k += 1.0f) {
    float step = 0.5f * ((k + 0.5f) * slice - begin);
    for (int i = 0; i < 2; ++i) {
      float t = begin + SAMPLE_AT * step;
      float h = altitudeAfter(altitude, ray.y, t);
      float lightMu = cosineAfter(altitude, scene.light.y, t, along, h);
      march = marchStep(march, h, lightMu, phase, step);
      begin += step;
    }
    float transmittance = dot(march.throughput, vec3(1.0f / 3.0f));
    imageStore(table, ivec3(texel, int(k)),
               vec4(march.radiance * scene.irradiance.xyz, transmittance));
  }
}
