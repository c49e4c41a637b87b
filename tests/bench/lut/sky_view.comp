// SPDX-License-Identifier: MIT
// Radiance of the sky from the eye over half the azimuths, angles dense at the horizon and towards
// the light: 30 steps along each ray, dense towards the eye.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "air.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 9) uniform writeonly image2D table;

const float STEPS = 30.0f;

void main() {
  uvec2 texel = gl_GlobalInvocationID.xy;
  if (texel.x >= uint(SKY_SIZE.x) || texel.y >= uint(SKY_SIZE.y)) {
    return;
  }
  vec2 unit = fromTexel(texel, SKY_SIZE);
  float c = abs(2.0f * unit.y - 1.0f);
  bool above = unit.y < 0.5f;
  float angle = scene.horizon.x + (above ? -scene.horizon.x : scene.horizon.y) * c * c;
  float mu = cos(angle);
  float altitude = scene.ground.w;
  float lightMu = scene.light.y;
  float sinuses = sqrt(max((1.0f - mu * mu) * (1.0f - lightMu * lightMu), 0.0f));
  float along = mu * lightMu + sinuses * (1.0f - 2.0f * unit.x * unit.x);
  float ground = groundDistance(altitude, mu);
  float reach = !above && ground >= 0.0f ? ground : topDistance(altitude, mu);
  float phase = rayleighPhase(along);
  March march;
  march.radiance = vec3(0.0f);
  march.throughput = vec3(1.0f);
  float begin = 0.0f;
  for (float k = 1.0f; k <= STEPS; k += 1.0f) {
    float end = reach * (k / STEPS) * (k / STEPS);
    float t = mix(begin, end, SAMPLE_AT);
    float h = altitudeAfter(altitude, mu, t);
    march = marchStep(march, h, cosineAfter(altitude, lightMu, t, along, h), phase, end - begin);
    begin = end;
  }
  imageStore(table, ivec2(texel), vec4(march.radiance * scene.irradiance.xyz, 1.0f));
}
