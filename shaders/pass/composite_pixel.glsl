// SPDX-License-Identifier: MIT
// What Welkin adds to a pixel: premultiplied radiance and RGB transmittance of everything between
// the eye and the engine's surface. [R04] 4.1, 4.2.4.
layout(constant_id = 3) const bool VOLUMES_ENABLED = true;
layout(constant_id = 4) const bool DEPTH_ENABLED = true;
layout(constant_id = 5) const bool DISK_ENABLED = true;
layout(constant_id = 6) const bool GROUND_ENABLED = true;

layout(set = 0, binding = 0, std140) uniform Frame { FrameUniforms frame; };
layout(set = 0, binding = 1, std430) readonly buffer FrameState { vec4 frameState[]; };
layout(set = 0, binding = 2) uniform sampler2D depthImage;
layout(set = 0, binding = 6, std430) buffer Counters { uint nonFinite; };
layout(set = 0, binding = 7, std430) readonly buffer FogCurve { vec4 fogCurve[]; };

#include "ray.glsl"

struct PixelLayer {
  vec3 radiance;
  vec3 transmittance;
};

// 1 inside the light's disk, 0 outside, smooth over the last 4 % of the radius.
// y = 1 - cos of the angle to the disk's centre, edge that of its rim: y/edge ~ (angle/radius)^2.
float diskCoverage(float y, float edge) {
  float x = clamp((1.0f - y / edge) * 12.5f, 0.0f, 1.0f);
  return x * x * (3.0f - 2.0f * x);
}

PixelLayer pixelLayer(uvec2 pixel) {
  vec3 direction = pixelDirection(frame, vec2(pixel));
  float surface = INFINITE_DISTANCE;
  if (DEPTH_ENABLED) {
    float d = texelFetch(depthImage, ivec2(pixel), 0).x;
    surface = surfaceDistance(frame, vec2(pixel), d);
  }
  bool open = surface >= INFINITE_DISTANCE;
  vec3 radiance = vec3(0.0f);
  vec3 transmittance = vec3(1.0f);
  Air air = airOf(frame);
  AirRay ray = airRayOf(frame, direction);
  float ground = groundDistance(ray.altitude, ray.viewMu, air.planetRadius);
  float reach = open && ground >= 0.0f ? ground : surface;

  if (AIR_ENABLED || FOG_ENABLED) {
    float airPhase = rayleighPhase(1.0f - ray.viewSun);
    vec3 droplets = FOG_ENABLED ? fogPhaseOf(frame, direction) : vec3(0.0f);
    AirResult result = airAlongRay(air, ray, reach, airPhase, droplets, frame.light.w);
    transmittance = exp(-result.opticalDepth);
    if (LIGHT_ENABLED) {
      radiance = result.radiance * frame.lightIrradiance.xyz;
    }
  }
  if (open && ground >= 0.0f) {
    // The planet hides what lies behind it, also where its own light is not drawn.
    vec3 behind = vec3(0.0f);
    if (GROUND_ENABLED && LIGHT_ENABLED) {
      AirRay foot = advanceRay(air, ray, ground);
      foot.altitude = 0.0f;
      vec3 sun = frame.lightIrradiance.xyz * exp(-lightOpticalDepth(air, 0.0f, foot.sunMu));
      float visible = lightVisibility(air, 0.0f, foot.sunMu, frame.light.w);
      behind = frame.ground.xyz * 0.31830989f * sun * (max(foot.sunMu, 0.0f) * visible);
    }
    if (GROUND_ENABLED) {
      radiance += transmittance * behind;
      transmittance = vec3(0.0f);
    }
  } else if (open && DISK_ENABLED && LIGHT_ENABLED) {
    float y = oneMinusCosine(direction, frame.light.xyz);
    radiance += transmittance * frame.lightDisk.xyz * diskCoverage(y, frame.lightDisk.w);
  }
  if (VOLUMES_ENABLED) {
    vec2 p = vec2(pixel);
    bool covered = p.x >= frame.volumeRect.x && p.y >= frame.volumeRect.y &&
                   p.x < frame.volumeRect.z && p.y < frame.volumeRect.w;
    if (covered) {
      vec4 state = frameState[pixel.y * uint(frame.viewport.x) + pixel.x];
      radiance = compositeOver(state.xyz, state.w, radiance);
      transmittance *= state.w;
    }
  }
  PixelLayer layer;
  layer.radiance = radiance;
  layer.transmittance = transmittance;
  return layer;
}

bool isFinite(vec3 v) {
  return !(any(isnan(v)) || any(isinf(v)));
}

// Counts before the guard: min and max would hide a NaN on some drivers.
void countNonFinite(vec3 a, vec3 b) {
  if (!isFinite(a) || !isFinite(b)) {
    atomicAdd(nonFinite, 1u);
  }
}

vec3 guarded(vec3 v) {
  float limit = frame.output_.z;
  return vec3(finiteValue(v.x, limit), finiteValue(v.y, limit), finiteValue(v.z, limit));
}
