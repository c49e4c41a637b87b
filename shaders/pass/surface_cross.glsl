// SPDX-License-Identifier: MIT
// A crossing counted in its pixel. Before: `surfaceCover[]`, `surfaceLimit(pixel)` in steps.
void surfaceCross(SurfaceUniforms s, ivec2 pixel, uint at, SurfaceCrossing crossing,
                  uint triangle) {
  uint step_ = min(surfaceStep(s, crossing.depth), surfaceLimit(pixel));
  if (crossing.facing > 0.0f) {
    atomicMax(surfaceCover[at].front, ~step_);
    atomicAdd(surfaceCover[at].chord, -int(step_));
    atomicAdd(surfaceCover[at].net, -1);
  } else {
    atomicMax(surfaceCover[at].leave, ~step_);
    atomicMax(surfaceCover[at].back, step_);
    atomicAdd(surfaceCover[at].chord, int(step_));
    atomicAdd(surfaceCover[at].net, 1);
  }
}
