// SPDX-License-Identifier: MIT
// Fog's phase function, RGB in 1/sr: the curve's nodes stand at equal steps of phaseCoordinate.
vec3 fogPhaseOf(vec3 direction, vec3 toLight) {
  float x = phaseCoordinate(oneMinusCosine(direction, toLight)) * float(CURVE_NODES - 1);
  int i = min(int(x), CURVE_NODES - 2);
  return mix(fogCurve[i].xyz, fogCurve[i + 1].xyz, x - float(i));
}
