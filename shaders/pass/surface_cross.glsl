// SPDX-License-Identifier: MIT
// A crossing counted in its pixel. Before: the cover's words as `surfaceWords[]`. One operation for
// entering and leaving where both have one, as drivers such as lavapipe take lanes through both
// branches, one after the other in each.
void surfaceCount(uint at, SurfaceCrossing crossing, uint step_) {
  bool enters = crossing.facing > 0.0f;
  uint first = at * SURFACE_COVER_WORDS;
  atomicMax(surfaceWords[first + (enters ? SURFACE_FRONT : SURFACE_LEAVE)], ~step_);
  atomicAdd(surfaceWords[first + SURFACE_CHORD], enters ? ~step_ + 1u : step_);
  if (!enters) {
    atomicMax(surfaceWords[first + SURFACE_BACK], step_);
  }
}
