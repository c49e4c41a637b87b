// SPDX-License-Identifier: MIT
// Transmittance from a point to the top of the air, RGB: the mapping of E. Bruneton and F. Neyret
// 2008, 40 steps.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "air.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 7) uniform writeonly image2D table;

const int STEPS = 40;

void main() {
  uvec2 texel = gl_GlobalInvocationID.xy;
  vec2 unit = fromTexel(texel, TRANSMITTANCE_SIZE);
  float radius = planetRadius();
  float most = sqrt(power(TOP));
  float rho = unit.y * most;
  float altitude = rho * rho / (sqrt(radius * radius + rho * rho) + radius);
  float least = TOP - altitude;
  float d = mix(least, rho + most, unit.x);
  float span = (most - rho) * (most + rho);
  float mu = d > 0.0f ? clamp((span - d * d) / (2.0f * (radius + altitude) * d), -1.0f, 1.0f)
                      : 1.0f;
  vec3 depth = vec3(0.0f);
  for (int i = 0; i < STEPS; ++i) {
    float t = d * (float(i) + SAMPLE_AT) / float(STEPS);
    depth += extinctionAt(altitudeAfter(altitude, mu, t));
  }
  imageStore(table, ivec2(texel), vec4(exp(-depth * (d / float(STEPS))), 1.0f));
}
