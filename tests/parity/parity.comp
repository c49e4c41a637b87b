// SPDX-License-Identifier: MIT
// Evaluates one case of cases.glsl per invocation, in float on the device.
#version 460
#extension GL_GOOGLE_include_directive : require
#define real float
const bool AIR_ENABLED = true;
const bool FOG_ENABLED = true;
const bool ABSORBER_ENABLED = true;
layout(local_size_x = 64) in;
layout(constant_id = 0) const int WHICH = 0;
#include "model/model.glsl"
#include "cases.glsl"
layout(set = 0, binding = 0, std430) readonly buffer Rows { ParityRow rows[]; };
layout(set = 0, binding = 1, std430) writeonly buffer Results { ParityResult results[]; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  results[i] = parityCase(WHICH, rows[i]);
}
