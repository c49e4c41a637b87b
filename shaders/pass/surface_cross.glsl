// SPDX-License-Identifier: MIT
// A crossing counted in its pixel's row of words. Before: these as `surfaceWords[]`.
//
// The nearest entering and leaving each have a word; what loses against them, as most pixels have
// nothing, goes into the other two. So a ray that enters once and leaves once costs two operations,
// not five: drivers such as lavapipe take the lanes through each one by one.
void surfaceCount(uint at, SurfaceCrossing crossing, uint step_) {
  bool enters = crossing.facing > 0.0f;
  uint first = at * SURFACE_COVER_WORDS;
  uint before = atomicMax(surfaceWords[first + (enters ? SURFACE_FRONT : SURFACE_LEAVE)], ~step_);
  if (before != 0u) {
    uint farther = max(step_, ~before);
    atomicAdd(surfaceWords[first + SURFACE_REST], enters ? ~farther + 1u : farther);
    if (!enters) {
      atomicMax(surfaceWords[first + SURFACE_FARTHEST], farther);
    }
  }
}
