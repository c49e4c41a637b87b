// SPDX-License-Identifier: MIT
// What a surface's triangles cover in a picture: first, last and total depth in each pixel.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common.glsl"

layout(local_size_x = 64) in;
// Of a view with opaque surfaces, which end rays.
layout(constant_id = 5) const bool DEPTH_ENABLED = true;

layout(set = 0, binding = 0, std140) uniform Frame { FrameUniforms frame; };
layout(set = 0, binding = 5) uniform sampler2D depthImage;
#include "surface_mesh.glsl"
#include "ray.glsl"
#include "ray_end.glsl"

// In a view, not in a light map.
layout(constant_id = 6) const bool IN_VIEW = true;

// Depth in steps of what hides the rest.
uint surfaceLimit(ivec2 pixel) {
  if (!IN_VIEW) {
    return 0xffffffffu;
  }
  vec3 direction = pixelDirection(frame, vec2(pixel));
  float end = INFINITE_DISTANCE;
  if (DEPTH_ENABLED) {
    end = surfaceDistance(frame, vec2(pixel), texelFetch(depthImage, pixel, 0).x);
  }
  end = endOfRay(frame, direction, end);
  if (end >= INFINITE_DISTANCE) {
    return 0xffffffffu;
  }
  float depth = end * dot(direction, surface.axis.xyz);
  return uint(clamp((depth - surface.steps.x) * surface.steps.y, 0.0f, surface.steps.z) + 0.5f);
}

void surfaceCross(SurfaceUniforms s, ivec2 pixel, uint at, SurfaceCrossing crossing,
                  uint triangle);
#include "surface_cover.glsl"
#include "surface_cross.glsl"

void main() {
  coverTriangles(surface, gl_WorkGroupID, gl_LocalInvocationIndex);
}
