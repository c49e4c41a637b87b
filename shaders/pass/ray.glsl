// SPDX-License-Identifier: MIT
// The ray of a pixel and the distance of the engine's surface on it.
const float INFINITE_DISTANCE = 1.0e30f;

// Behind a pixel's middle, of depth value d: homogeneous, from the eye.
vec4 homogeneousAt(FrameUniforms frame, vec2 pixel, float d) {
  vec2 ndc = (pixel + 0.5f) * frame.viewport.zw * 2.0f - 1.0f;
  return frame.eyeFromNdc * vec4(ndc, d, 1.0f);
}

vec3 pixelDirection(FrameUniforms frame, vec2 pixel) {
  vec4 p = homogeneousAt(frame, pixel, 0.5f);
  return normalize(p.w < 0.0f ? -p.xyz : p.xyz);
}

// Distance of the homogeneous position that depth value d gives: |p| / w, infinite for the sky's
// value and for w -> 0.
float homogeneousDistance(FrameUniforms frame, vec4 p, float d) {
  float reach = length(p.xyz);
  float w = abs(p.w);
  if (d == frame.output_.x || !(w * INFINITE_DISTANCE > reach)) {
    return INFINITE_DISTANCE;
  }
  return reach / w;
}

float surfaceDistance(FrameUniforms frame, vec2 pixel, float d) {
  return homogeneousDistance(frame, homogeneousAt(frame, pixel, d), d);
}

// Distance of a slice of froxels. m.
float froxelDistance(FrameUniforms frame, uint slice) {
  return frame.froxels.x * pow(float(slice) * frame.froxels.z, frame.froxels.y);
}

Air airOf(FrameUniforms frame) {
  Air air;
  air.planetRadius = frame.fog.w;
  air.airScattering = frame.air.xyz;
  air.airScaleHeight = frame.air.w;
  air.fogExtinction = frame.fog.x;
  air.fogBaseAltitude = frame.fog.y;
  air.fogScaleHeight = frame.fog.z;
  air.fogAlbedo = frame.fogAlbedo.xyz;
  air.absorption = frame.absorber.xyz;
  air.absorberPeak = frame.absorber.w;
  air.absorberWidth = frame.skyView.w;
  return air;
}

AirRay airRayOf(FrameUniforms frame, LightUniforms light, vec3 direction) {
  AirRay ray;
  ray.altitude = frame.eye.w;
  ray.viewMu = dot(direction, frame.eye.xyz);
  ray.sunMu = light.irradiance.w;
  ray.viewSun = 1.0f - oneMinusCosine(direction, light.direction.xyz);
  return ray;
}

// The same ray seen from a point `t` further on.
AirRay advanceRay(Air air, AirRay ray, float t) {
  AirRay next;
  next.altitude = altitudeAlongRay(ray.altitude, ray.viewMu, air.planetRadius, t);
  float before = air.planetRadius + ray.altitude;
  float after = air.planetRadius + next.altitude;
  next.viewMu = clamp((before * ray.viewMu + t) / after, -1.0f, 1.0f);
  next.sunMu = clamp((before * ray.sunMu + t * ray.viewSun) / after, -1.0f, 1.0f);
  next.viewSun = ray.viewSun;
  return next;
}
