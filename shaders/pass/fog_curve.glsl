// SPDX-License-Identifier: MIT
// Fog's phase function, RGB in 1/sr: the curve's nodes stand at equal steps of phaseCoordinate.
vec3 fogPhaseOf(FrameUniforms frame, vec3 direction) {
  float x = phaseCoordinate(oneMinusCosine(direction, frame.light.xyz)) * float(CURVE_NODES - 1);
  int i = min(int(x), CURVE_NODES - 2);
  return mix(fogCurve[i].xyz, fogCurve[i + 1].xyz, x - float(i));
}
