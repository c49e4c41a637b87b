// SPDX-License-Identifier: MIT
// What Welkin adds to a pixel: premultiplied radiance and RGB transmittance of everything between
// the eye and the engine's surface. [R04] 4.1, 4.2.4.
layout(constant_id = 3) const bool VOLUMES_ENABLED = true;
layout(constant_id = 4) const bool DEPTH_ENABLED = true;
// 0: none; 1: uniform; 2: darker towards the limb, or moons.
layout(constant_id = 5) const uint DISK_KIND = 2u;
layout(constant_id = 6) const bool GROUND_ENABLED = true;
layout(constant_id = 9) const bool MULTIPLE_ENABLED = true;
// From space the table's nodes lie too far apart at the edge of night: every pixel gathers its own
// light.
layout(constant_id = 10) const bool SPACE_ENABLED = false;
// Clear air: all of its light comes from the table.
layout(constant_id = 11) const bool ALL_LIGHT = false;

layout(set = 0, binding = 0, std140) uniform Frame { FrameUniforms frameBlock; };
FrameUniforms frame = frameBlock;
layout(set = 0, binding = 1, std430) readonly buffer FrameState { vec4 frameState[]; };
// The same buffer.
layout(set = 0, binding = 15) uniform usamplerBuffer frameTexels;
layout(set = 0, binding = 2) uniform sampler2D depthImage;
layout(set = 0, binding = 6, std430) buffer Counters { uint nonFinite; };
layout(set = 0, binding = 7, std430) readonly buffer FogCurve { vec4 fogCurve[]; };
layout(set = 0, binding = 8) uniform sampler3D skyTable;
layout(set = 0, binding = 9) uniform sampler3D skyPeak;
layout(set = 0, binding = 10) uniform sampler2D skyMoments;
layout(set = 0, binding = 13) uniform sampler3D skyFog;

#include "texels.glsl"
#include "frame_state.glsl"
#include "../interface/sky_table.glsl"
#include "ray.glsl"
#include "fog_curve.glsl"
#include "air_column.glsl"
#include "sky_light.glsl"
#include "sky_lookup.glsl"
#include "volume_shadow.glsl"

struct PixelLayer {
  vec3 radiance;
  vec3 transmittance;
};

const int SPACE_STEPS = 24;

// Radiance of light scattered more than once, per unit irradiance, along a ray with the columns
// `columns` over `reach`.
vec3 multipleLight(Air air, AirRay ray, int which, float reach, vec3 columns, vec3 droplets) {
  vec3 light = vec3(0.0f);
  if (SPACE_ENABLED) {
    AirPath path = clipToAir(air, ray, reach);
    SkyMarch march = skyMarchBegin(air, path);
    float lightRadius = frameBlock.lights[which].direction.w;
    for (int i = 1; i <= SPACE_STEPS; ++i) {
      float t = skyStop(path, float(i) / float(SPACE_STEPS));
      march = skyMarchTo(air, path, march, t, lightRadius);
    }
    light = march.light;
    if (FOG_ENABLED) {
      light += fogWithoutPeak(droplets) * march.peak + fogLobe(ray.viewSun) * march.fog;
    }
  } else {
    vec3 opacity = opacityOf(scatteringDepth(air, columns));
    light = skySourceAt(skyTableRay(ray, which), opacity, droplets, ray.viewSun) * opacity;
  }
  return light;
}

#include "clear_air.glsl"

// With fog, in twilight from higher up or from space: every pixel integrates its own first order.
PixelLayer layeredAir(Air air, vec3 direction, float reach, bool ends) {
  PixelLayer layer;
  layer.radiance = vec3(0.0f);
  layer.transmittance = vec3(1.0f);
  for (int i = 0; i < max(int(LIGHT_COUNT), 1); ++i) {
    LightUniforms light = frameBlock.lights[i];
    AirRay ray = airRayOf(frame, light, direction);
    float airPhase = rayleighPhase(1.0f - ray.viewSun);
    vec3 droplets = FOG_ENABLED ? fogPhaseOf(direction, light.direction.xyz) : vec3(0.0f);
    AirResult result = airAlongRay(air, ray, reach, airPhase, droplets, light.direction.w);
    layer.transmittance = exp(-result.opticalDepth);
    if (FOG_ENABLED && MULTIPLE_ENABLED && ends) {
      // Surfaces fill more of the view than the few degrees by which droplets turn light within
      // their forward peak: what one pixel loses to that, its neighbours give.
      Air eyeAir = air;
      eyeAir.fogExtinction = frame.eyeFog.w;
      layer.transmittance = exp(-depthOfColumns(eyeAir, result.columns));
    }
    if (LIGHT_ENABLED) {
      vec3 sum = result.radiance;
      if (MULTIPLE_ENABLED) {
        sum += multipleLight(air, ray, i, reach, result.columns, droplets);
      }
      layer.radiance += sum * light.irradiance.xyz;
    }
  }
  return layer;
}

// Radiance of the bare planet where a ray meets it.
vec3 groundRadiance(Air air, vec3 direction, float ground) {
  vec3 sum = vec3(0.0f);
  Air above = air;
  if (FOG_ENABLED && MULTIPLE_ENABLED) {
    above.fogExtinction *= frame.skyZeniths.x;
  }
  for (int i = 0; i < int(LIGHT_COUNT); ++i) {
    LightUniforms light = frameBlock.lights[i];
    AirRay foot = advanceRay(air, airRayOf(frame, light, direction), ground);
    vec3 sun = exp(-lightOpticalDepth(above, 0.0f, foot.sunMu));
    float visible = lightVisibility(air, 0.0f, foot.sunMu, light.direction.w);
    vec3 irradiance = sun * (max(foot.sunMu, 0.0f) * visible);
    if (SHADOWS_ENABLED && i == 0) {
      irradiance *= shadowTransmittance(direction * ground);
    }
    if (MULTIPLE_ENABLED) {
      irradiance += groundLight(foot.sunMu);
    }
    sum += irradiance * light.irradiance.xyz;
  }
  return frame.ground.xyz * 0.31830989f * sum;
}

// Radiance of the lights' disks in front of the air.
vec3 diskRadiance(vec3 direction) {
  vec3 sum = vec3(0.0f);
  for (int i = 0; i < int(LIGHT_COUNT); ++i) {
    LightUniforms light = frameBlock.lights[i];
    float y = oneMinusCosine(direction, light.direction.xyz);
    vec3 shape = vec3(diskCoverage(y, light.disk.w));
    if (DISK_KIND > 1u) {
      shape = light.litFrom.w > 0.0f
                  ? vec3(litDisk(direction, light.direction.xyz, light.litFrom.xyz,
                                 light.litFrom.w, y, light.disk.w))
                  : limbDarkenedDisk(y, light.disk.w, light.limb.xyz);
    }
    sum += light.disk.xyz * shape;
  }
  return sum;
}

// Whether volumes may cover the pixel, and what they left there.
bool covered(uvec2 pixel) {
  vec2 p = vec2(pixel);
  return p.x >= frame.volumeRect.x && p.y >= frame.volumeRect.y && p.x < frame.volumeRect.z &&
         p.y < frame.volumeRect.w;
}

vec4 volumeState(uvec2 pixel) {
  return stateAt(pixel.y * uint(frame.viewport.x) + pixel.x);
}

// What volumes left on a ray; `any` where they may cover it.
struct VolumeLayer {
  bool any;
  vec4 state;
};

// Along a ray to a surface; `pixel` tells samples of neighbours apart.
PixelLayer layerTo(uvec2 pixel, vec3 direction, float surface, VolumeLayer volumes) {
  bool open = surface >= INFINITE_DISTANCE;
  Air air = airOf(frame);
  AirRay ray = airRayOf(frame, frame.lights[0], direction);
  float ground = groundDistance(ray.altitude, ray.viewMu, air.planetRadius);
  float reach = open && ground >= 0.0f ? ground : surface;
  PixelLayer layer;
  layer.radiance = vec3(0.0f);
  layer.transmittance = vec3(1.0f);
  vec3 shade = vec3(0.0f);
  if (ALL_LIGHT) {
    layer = clearAir(air, ray, direction, reach, ground);
  } else if (AIR_ENABLED || FOG_ENABLED) {
    layer = layeredAir(air, direction, reach, !open || ground >= 0.0f);
  }
  if (open && ground >= 0.0f) {
    // The planet hides what lies behind it, also where its own light is not drawn.
    if (GROUND_ENABLED) {
      if (LIGHT_ENABLED) {
        layer.radiance += layer.transmittance * groundRadiance(air, direction, ground);
      }
      layer.transmittance = vec3(0.0f);
    }
  } else if (open && DISK_KIND > 0u && LIGHT_ENABLED) {
    vec3 disk = diskRadiance(direction);
    if (VOLUMES_ENABLED && volumes.any) {
      // Forward peaks pass for transmitted light, but not as an image.
      float hides = volumes.state.w;
      disk *= exp(log(max(hides, 1.0e-30f)) * frame.ground.w);
    }
    layer.radiance += layer.transmittance * disk;
  }
  if (SHADOWS_ENABLED) {
    float passes = VOLUMES_ENABLED && volumes.any ? volumes.state.w : 1.0f;
    shade = shadowedLight(air, ray, direction, reach, passes, pixel);
  }
  if (VOLUMES_ENABLED && volumes.any) {
    layer.radiance = compositeOver(volumes.state.xyz, volumes.state.w, layer.radiance);
    layer.transmittance *= volumes.state.w;
  }
  layer.radiance = layer.radiance - shade;
  vec3 color = vec3(dot(frame.colorRed.xyz, layer.radiance),
                    dot(frame.colorGreen.xyz, layer.radiance),
                    dot(frame.colorBlue.xyz, layer.radiance));
  // A comparison, not max: it lets NaN through to the counter.
  layer.radiance = mix(color, vec3(0.0f), lessThan(color, vec3(0.0f)));
  return layer;
}

PixelLayer pixelLayer(uvec2 pixel) {
  vec3 direction = pixelDirection(frame, vec2(pixel));
  float surface = INFINITE_DISTANCE;
  if (DEPTH_ENABLED) {
    float d = texelFetch(depthImage, ivec2(pixel), 0).x;
    surface = surfaceDistance(frame, vec2(pixel), d);
  }
  VolumeLayer volumes;
  volumes.any = VOLUMES_ENABLED && covered(pixel);
  volumes.state = vec4(0.0f, 0.0f, 0.0f, 1.0f);
  if (volumes.any) {
    volumes.state = volumeState(pixel);
  }
  return layerTo(pixel, direction, surface, volumes);
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
