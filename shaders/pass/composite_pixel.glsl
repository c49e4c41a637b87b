// SPDX-License-Identifier: MIT
// What Welkin adds to a pixel: premultiplied radiance and RGB transmittance of everything between
// the eye and the engine's surface. [R04] 4.1, 4.2.4.
layout(constant_id = 3) const bool VOLUMES_ENABLED = true;
layout(constant_id = 4) const bool DEPTH_ENABLED = true;
layout(constant_id = 5) const bool DISK_ENABLED = true;
layout(constant_id = 6) const bool GROUND_ENABLED = true;
layout(constant_id = 9) const bool MULTIPLE_ENABLED = true;
// From space the table's nodes lie too far apart at the edge of night: every pixel gathers its own
// light.
layout(constant_id = 10) const bool SPACE_ENABLED = false;
// Clear air: all of its light comes from the table.
layout(constant_id = 11) const bool ALL_LIGHT = false;

layout(set = 0, binding = 0, std140) uniform Frame { FrameUniforms frame; };
layout(set = 0, binding = 1, std430) readonly buffer FrameState { vec4 frameState[]; };
layout(set = 0, binding = 2) uniform sampler2D depthImage;
layout(set = 0, binding = 6, std430) buffer Counters { uint nonFinite; };
layout(set = 0, binding = 7, std430) readonly buffer FogCurve { vec4 fogCurve[]; };
layout(set = 0, binding = 8) uniform sampler3D skyTable;
layout(set = 0, binding = 9) uniform sampler3D skyPeak;
layout(set = 0, binding = 10) uniform sampler2D skyMoments;

#include "ray.glsl"
#include "fog_curve.glsl"
#include "air_column.glsl"
#include "sky_light.glsl"
#include "sky_lookup.glsl"

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

const int SPACE_STEPS = 24;

// Radiance of light scattered more than once, per unit irradiance, along a ray with the optical
// depth `depth` that air and fog have over `reach`.
vec3 multipleLight(Air air, AirRay ray, float reach, vec3 depth, vec3 droplets) {
  vec3 light = vec3(0.0f);
  if (SPACE_ENABLED) {
    AirPath path = clipToAir(air, ray, reach);
    SkyMarch march = skyMarchBegin(air, path);
    for (int i = 1; i <= SPACE_STEPS; ++i) {
      march = skyMarchTo(air, path, march, skyStop(path, float(i) / float(SPACE_STEPS)));
    }
    light = march.light;
    if (FOG_ENABLED) {
      light += min(droplets * frame.fogFirst.w, frame.fogBound.xyz) * march.peak;
    }
  } else {
    vec3 opacity = opacityOf(depth);
    light = skySourceAt(skyTableRay(ray), opacity, droplets) * opacity;
  }
  return light;
}

// Radiance per unit irradiance and transmittance of clear air over `reach`.
PixelLayer clearAir(Air air, AirRay ray, float reach, float ground) {
  AirPath path = clipToAir(air, ray, skyTableReach(ground));
  float own = clipToAir(air, ray, reach).reach;
  AirPoint first = airPoint(air, path, 0.0f);
  AirPoint lowest = airPoint(air, path, clamp(path.lowest, 0.0f, max(path.reach, own)));
  AirPoint last = airPoint(air, path, path.reach);
  AirPoint there = airPoint(air, path, own);
  float total = skyTableOpacity(air, path, first, lowest, last);
  vec3 depth = depthOfColumns(air, columnsTo(air, path, first, lowest, there));
  float share = oneMinusExp(depth.y) / max(total, 1.0e-30f);
  PixelLayer layer;
  layer.radiance = skyTableSource(skyTableDirection(ray), share, ray.viewSun) * opacityOf(depth);
  layer.transmittance = exp(-depth);
  return layer;
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

  if (ALL_LIGHT) {
    PixelLayer clear = clearAir(air, ray, reach, ground);
    radiance = clear.radiance * frame.lightIrradiance.xyz;
    transmittance = clear.transmittance;
  } else if (AIR_ENABLED || FOG_ENABLED) {
    float airPhase = rayleighPhase(1.0f - ray.viewSun);
    vec3 droplets = FOG_ENABLED ? fogPhaseOf(frame, direction) : vec3(0.0f);
    AirResult result = airAlongRay(air, ray, reach, airPhase, droplets, frame.light.w);
    transmittance = exp(-result.opticalDepth);
    if (FOG_ENABLED && MULTIPLE_ENABLED && (!open || ground >= 0.0f)) {
      // Surfaces fill more of the view than the few degrees by which droplets turn light within
      // their forward peak: what one pixel loses to that, its neighbours give.
      Air eyeAir = air;
      eyeAir.fogExtinction = frame.eyeFog.w;
      transmittance = exp(-depthOfColumns(eyeAir, result.columns));
    }
    if (LIGHT_ENABLED) {
      vec3 light = result.radiance;
      if (MULTIPLE_ENABLED) {
        light += multipleLight(air, ray, reach, result.opticalDepth, droplets);
      }
      radiance = light * frame.lightIrradiance.xyz;
    }
  }
  if (open && ground >= 0.0f) {
    // The planet hides what lies behind it, also where its own light is not drawn.
    vec3 behind = vec3(0.0f);
    if (GROUND_ENABLED && LIGHT_ENABLED) {
      AirRay foot = advanceRay(air, ray, ground);
      foot.altitude = 0.0f;
      vec3 sun = exp(-lightOpticalDepth(air, 0.0f, foot.sunMu));
      float visible = lightVisibility(air, 0.0f, foot.sunMu, frame.light.w);
      vec3 light = sun * (max(foot.sunMu, 0.0f) * visible);
      if (MULTIPLE_ENABLED) {
        light += groundLight(foot.sunMu);
      }
      behind = frame.ground.xyz * 0.31830989f * light * frame.lightIrradiance.xyz;
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
