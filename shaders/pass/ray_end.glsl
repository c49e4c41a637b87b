// SPDX-License-Identifier: MIT
// The end of an eye ray; after ray.glsl.
#include "late.glsl"

// Where rays of volumes end: at the engine's surface, or on the bare planet where that is drawn.
float endOfRay(FrameUniforms frame, vec3 direction, float surface) {
  float ground = groundDistance(frame.eye.w, dot(direction, frame.eye.xyz), frame.fog.w);
  bool bare = surface >= INFINITE_DISTANCE && late(frame.froxelRange.w != 0.0f);
  return bare && ground >= 0.0f ? ground : surface;
}
