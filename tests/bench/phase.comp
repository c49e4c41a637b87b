// SPDX-License-Identifier: MIT
// Phase values in 1/sr, `loops` of them per invocation, or those of a list of y if it is 0. Which
// phase function is a specialisation constant: a driver that never skips a branch drops the others.
#version 460
#extension GL_GOOGLE_include_directive : require
#define real float
const bool AIR_ENABLED = true;
const bool FOG_ENABLED = true;
const bool ABSORBER_ENABLED = true;
layout(local_size_x = 64) in;
layout(constant_id = 0) const int WHICH = 0;
#include "model/model.glsl"

layout(set = 0, binding = 0, std430) readonly buffer Inputs {
  float loops;
  float diameter;  // um
  float gHg;
  float gapHg;
  float gD;
  float gapD;
  float alpha;
  float weightD;
  vec4 fogCurve[CURVE_NODES];
  float list[];  // y = 1 - cos(angle)
};
layout(set = 0, binding = 1, std430) writeonly buffer Results { float results[]; };

const int NOTHING = 0;
const int HENYEY_GREENSTEIN = 1;
const int FOG = 2;
const int FOG_OF_DIAMETER = 3;
const int CURVE = 4;

vec3 phaseAt(FogPhase p, float y) {
  if (WHICH == HENYEY_GREENSTEIN) {
    return vec3(henyeyGreenstein(p.gHg, p.gapHg, y));
  }
  if (WHICH == FOG) {
    return vec3(fogPhase(p, y));
  }
  if (WHICH == FOG_OF_DIAMETER) {  // not the same for all y, or it would move out of the loop
    return vec3(fogPhase(fogPhaseFromDiameter(diameter + 1.0e-6f * y), y));
  }
  if (WHICH == CURVE) {  // as fogPhaseOf in shaders/pass/ray.glsl
    float x = phaseCoordinate(y) * float(CURVE_NODES - 1);
    int i = min(int(x), CURVE_NODES - 2);
    return mix(fogCurve[i].xyz, fogCurve[i + 1].xyz, x - float(i));
  }
  return vec3(y);
}

void main() {
  uint i = gl_GlobalInvocationID.x;
  FogPhase p;
  p.gHg = gHg;
  p.gapHg = gapHg;
  p.gD = gD;
  p.gapD = gapD;
  p.alpha = alpha;
  p.weightD = weightD;
  int count = int(loops);
  if (count == 0) {
    results[i] = phaseAt(p, list[min(i, uint(list.length()) - 1u)]).y;
    return;
  }
  float u = fract(float(i) * 0.618034f);
  vec3 sum = vec3(0.0f);
  for (int k = 0; k < count; ++k) {
    u = fract(u + 0.618034f);
    sum += phaseAt(p, 2.0f * u * u);
  }
  results[i] = sum.x + sum.y + sum.z;
}
