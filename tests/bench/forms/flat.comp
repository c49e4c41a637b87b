// SPDX-License-Identifier: MIT
// Light scattered once, in closed form: a flat Earth, one exponential layer, one segment per pixel
// and colour. [R04] Eq. 11-15 as corrected.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "pixel.glsl"

PixelAir airAlong(PixelRay ray) {
  float inverse = 1.0f / scene.scattering.w;
  vec3 extinction = scene.scattering.xyz * exp(-scene.ground.w * inverse);
  float slope = ray.direction.y;
  float sun = scene.light.y;
  Segment red = flatExponentialSegment(extinction.x, inverse, slope, sun, ray.distance);
  Segment green = flatExponentialSegment(extinction.y, inverse, slope, sun, ray.distance);
  Segment blue = flatExponentialSegment(extinction.z, inverse, slope, sun, ray.distance);
  PixelAir air;
  air.radiance = vec3(red.inscatter, green.inscatter, blue.inscatter) *
                 rayleighPhase(1.0f - dot(ray.direction, scene.light.xyz));
  air.transmittance = exp(-vec3(red.opticalDepth, green.opticalDepth, blue.opticalDepth));
  return air;
}
