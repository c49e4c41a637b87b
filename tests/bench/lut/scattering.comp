// SPDX-License-Identifier: MIT
// Isotropic multiple scattering: over 64 directions of 20 steps each, the mean of the light that
// was scattered or reflected once, and the share of scattered light that is scattered again, whose
// geometric series gives all orders. Each invocation makes one texel: drivers on a CPU pay dearly
// for sharing the directions out within a workgroup.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "air.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 8) uniform writeonly image2D table;

const int DIRECTIONS = 8;  // in either angle
const int STEPS = 20;

void main() {
  uvec2 texel = gl_GlobalInvocationID.xy;
  vec2 unit = fromTexel(texel, SCATTERING_SIZE);
  float lightMu = 2.0f * unit.x - 1.0f;
  float altitude = unit.y * TOP;
  vec3 second = vec3(0.0f);
  vec3 transfer = vec3(0.0f);
  for (int i = 0; i < DIRECTIONS * DIRECTIONS; ++i) {
    float mu = 1.0f - 2.0f * (float(i / DIRECTIONS) + 0.5f) / float(DIRECTIONS);
    float azimuth = 2.0f * PI * (float(i % DIRECTIONS) + 0.5f) / float(DIRECTIONS);
    float sinuses = sqrt((1.0f - mu * mu) * max(1.0f - lightMu * lightMu, 0.0f));
    float along = mu * lightMu + sinuses * cos(azimuth);
    float ground = groundDistance(altitude, mu);
    float step = (ground >= 0.0f ? ground : topDistance(altitude, mu)) / float(STEPS);
    vec3 throughput = vec3(1.0f);
    for (int k = 0; k < STEPS; ++k) {
      float t = (float(k) + SAMPLE_AT) * step;
      float h = altitudeAfter(altitude, mu, t);
      vec3 left = exp(-extinctionAt(h) * step);
      vec3 weight = throughput * (1.0f - left);
      transfer += weight;
      second += weight * lightAt(h, cosineAfter(altitude, lightMu, t, along, h)) / (4.0f * PI);
      throughput *= left;
    }
    if (ground >= 0.0f) {
      float foot = cosineAfter(altitude, lightMu, ground, along, 0.0f);
      second += throughput * scene.ground.xyz / PI * max(foot, 0.0f) * lightAt(0.0f, foot);
    }
  }
  const float SHARE = 1.0f / float(DIRECTIONS * DIRECTIONS);
  imageStore(table, ivec2(texel), vec4(second * SHARE / (1.0f - transfer * SHARE), 1.0f));
}
