// SPDX-License-Identifier: MIT
// Where what is opaque ends the rays of a view's pixels, for each crossing to be held against: once
// in a pixel, which has several, and whose triangles' boxes hold it more often still.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 5) const bool DEPTH_ENABLED = true;

layout(set = 0, binding = 0, std140) uniform Frame { FrameUniforms frameBlock; };
FrameUniforms frame = frameBlock;
layout(set = 0, binding = 5) uniform sampler2D depthImage;
#include "surface_mesh.glsl"
#include "ray.glsl"
#include "ray_end.glsl"

void main() {
  ivec2 pixel = surface.rect.xy + ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, surface.rect.zw))) {
    return;
  }
  vec3 direction = pixelDirection(frame, vec2(pixel));
  float end = INFINITE_DISTANCE;
  if (DEPTH_ENABLED) {
    end = surfaceDistance(frame, vec2(pixel), texelFetch(depthImage, pixel, 0).x);
  }
  end = endOfRay(frame, direction, end);
  if (end < INFINITE_DISTANCE) {
    float depth = end * dot(direction, surface.axis.xyz);
    float step_ = clamp((depth - surface.steps.x) * surface.steps.y, 0.0f, surface.steps.z) + 0.5f;
    uint at = uint(pixel.y - surface.rect.y) * uint(surface.rect.z - surface.rect.x) +
              uint(pixel.x - surface.rect.x);
    surfaceWords[coverFurther(at)] = ~uint(step_);
  }
}
