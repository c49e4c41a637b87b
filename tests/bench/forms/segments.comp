// SPDX-License-Identifier: MIT
// Light scattered once, by two-ended segments on the optical depths of a sphere, as many per pixel
// as the light asks for: the text that the library runs where its table does not hold.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "pixel.glsl"

PixelAir airAlong(PixelRay ray) {
  Air layer;
  layer.planetRadius = scene.irradiance.w;
  layer.airScattering = scene.scattering.xyz;
  layer.airScaleHeight = scene.scattering.w;
  layer.fogExtinction = 0.0f;
  layer.fogBaseAltitude = 0.0f;
  layer.fogScaleHeight = 1.0f;
  layer.fogAlbedo = vec3(0.0f);
  layer.absorption = vec3(0.0f);
  layer.absorberPeak = 0.0f;
  layer.absorberWidth = 1.0f;
  AirRay own;
  own.altitude = scene.ground.w;
  own.viewMu = ray.direction.y;
  own.sunMu = scene.light.y;
  own.viewSun = dot(ray.direction, scene.light.xyz);
  float ground = groundDistance(own.altitude, own.viewMu, layer.planetRadius);
  float reach = ground >= 0.0f ? min(ray.distance, ground) : ray.distance;
  AirResult result =
      airAlongRay(layer, own, reach, rayleighPhase(1.0f - own.viewSun), 0.0f, 0.0f);
  PixelAir air;
  air.radiance = result.radiance;
  air.transmittance = exp(-result.opticalDepth);
  return air;
}
