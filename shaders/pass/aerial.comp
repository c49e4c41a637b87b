// SPDX-License-Identifier: MIT
// Aerial perspective: premultiplied radiance and RGB transmittance of everything between the eye
// and each froxel of a view, by the text that composites a pixel with a surface at its distance.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 4) uniform writeonly image3D radianceImage;
layout(set = 0, binding = 5) uniform writeonly image3D transmittanceImage;

#include "composite_pixel.glsl"
#include "half_float.glsl"

// What volumes left up to a slice: nothing before the first that was marched, nothing more behind
// the last.
VolumeLayer volumesBefore(uvec3 froxel) {
  float slice = float(froxel.z);
  VolumeLayer volumes;
  volumes.any = VOLUMES_ENABLED && covered(froxel.xy) && slice >= frame.froxelRange.x;
  volumes.state = vec4(0.0f, 0.0f, 0.0f, 1.0f);
  if (volumes.any) {
    uint marched = uint(min(slice, frame.froxelRange.y));
    uint row = marched * uint(frame.viewport.y) + froxel.y;
    volumes.state = stateAt(row * uint(frame.viewport.x) + froxel.x);
  }
  return volumes;
}

void main() {
  uvec3 froxel = gl_GlobalInvocationID;
  if (froxel.x >= uint(frame.viewport.x) || froxel.y >= uint(frame.viewport.y)) {
    return;
  }
  vec3 direction = pixelDirection(frame, vec2(froxel.xy));
  float surface = froxelDistance(frame, froxel.z);
  PixelLayer layer = layerTo(froxel.xy, direction, surface, volumesBefore(froxel));
  // Nothing lies before the first slice, whatever a ray without length gives.
  bool atEye = froxel.z == 0u;
  vec3 radiance = atEye ? vec3(0.0f) : layer.radiance * frame.output_.y;
  vec3 transmittance = atEye ? vec3(1.0f) : layer.transmittance;
  countNonFinite(radiance, transmittance);
  radiance = guarded(radiance);
  transmittance = guarded(transmittance);
  if (frame.froxelRange.z > 0.0f) {
    radiance = roundedToHalf(radiance);
    transmittance = roundedToHalf(transmittance);
  }
  imageStore(radianceImage, ivec3(froxel), vec4(radiance, 1.0f));
  imageStore(transmittanceImage, ivec3(froxel), vec4(transmittance, 1.0f));
}
