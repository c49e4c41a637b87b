// SPDX-License-Identifier: MIT
// The end of an eye ray; after ray.glsl.
#include "late.glsl"

// Where rays of volumes end: at the engine's surface, or on the bare planet where that is drawn.
// `viewMu`: cosine with the local up.
float endOfRay(FrameUniforms frame, float viewMu, float surface) {
  float ground = groundDistance(frame.eye.w, viewMu, frame.fog.w);
  bool bare = surface >= INFINITE_DISTANCE && late(frame.froxelRange.w != 0.0f);
  return bare && ground >= 0.0f ? ground : surface;
}

float endOfRay(FrameUniforms frame, vec3 direction, float surface) {
  return endOfRay(frame, dot(direction, frame.eye.xyz), surface);
}
