// SPDX-License-Identifier: MIT
// No air: what reading the depth and the colour and writing the picture cost by themselves.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "pixel.glsl"

PixelAir airAlong(PixelRay ray) {
  PixelAir air;
  air.radiance = vec3(0.0f);
  air.transmittance = vec3(ray.distance < OPEN ? 1.0f : 0.0f);
  return air;
}
