// SPDX-License-Identifier: MIT
// What volumes and opaque surfaces take from the first light before air and fog scatter it towards
// the eye: single scattering along the ray by the midpoint rule, times the light that is lacking
// there. Of volumes a map of layers says that (optical depth and the distances along the light
// between which it rises evenly), of surfaces the engine's shadow map. The former also tells
// roughly where on the ray the volumes hide what lies behind; how much, the pixel knows.
// Sum of 1: by volumes; 2: by the engine's map.
layout(constant_id = 12) const uint SHADOW_KIND = 0u;
const bool SHADOWS_ENABLED = SHADOW_KIND > 0u;
const bool VOLUME_SHADOWS = (SHADOW_KIND & 1u) != 0u;
const bool MAP_SHADOWS = (SHADOW_KIND & 2u) != 0u;
layout(set = 0, binding = 11) uniform sampler2D shadowMap;
#include "light_shadow.glsl"

const int SHADOW_STEPS = 24;
const float THINNEST_LAYER = 1.0f;  // m

// Of volumes between a position relative to the eye and the light: optical depth as the map counts
// it, that of absorption; the extinction (1/m) at the position.
vec3 volumeShadow(vec3 position) {
  vec4 p = vec4(position, 1.0f);
  vec2 uv = vec2(dot(frame.shadow[0], p), dot(frame.shadow[1], p));
  vec4 layer = textureLod(shadowMap, uv, 0.0f);  // its border is empty
  float thickness = max(layer.z - layer.y, THINNEST_LAYER);
  float rise = (dot(frame.shadow[2], p) - layer.y) / thickness;
  float within = rise > 0.0f && rise < 1.0f ? layer.x / thickness : 0.0f;
  return vec3(layer.xw * clamp(rise, 0.0f, 1.0f), within);
}

// Share of the light that does not arrive behind optical depth s and one of absorption a. Of the
// first order alone what was scattered is lost (a is 0 then). Else it goes on, as through a level
// slab by Eddington's approximation (Shettle and Weinman 1970, without absorption), whose s counts
// scattering by its mean of 1 - cosine; what thin absorption takes is s / 2 + a. Within 0.05 for
// suns of 30 degrees and more and white particles (VolumeShadow.*). Nothing cancels.
float lostBehind(vec2 depth) {
  float s = depth.x;
  float met = oneMinusExp(s);
  float level = frame.shadowRange.w;  // cosine of the sun's zenith angle
  float turned = (level * s + (2.0f / 3.0f - level) * met) / (level * s + 4.0f / 3.0f);
  float lost = turned + (1.0f - turned) * oneMinusExp(depth.y);
  return level == 0.0f ? met : lost;
}

// Share of the light that shadows leave at a position relative to the eye.
float shadowTransmittance(vec3 position) {
  float passes = 1.0f;
  if (VOLUME_SHADOWS) {
    passes = 1.0f - lostBehind(volumeShadow(position).xy);
  }
  if (MAP_SHADOWS) {
    passes *= 1.0f - mapShadow(position);
  }
  return passes;
}

// Stretch of the ray that the maps cover, not nearer to the light than all volumes.
Span shadowSpan(vec3 direction, float reach) {
  Span span;
  span.begin = reach;
  span.end = reach;
  if (VOLUME_SHADOWS) {
    vec4 d = vec4(direction, 0.0f);
    vec3 rate = vec3(dot(frame.shadow[0], d), dot(frame.shadow[1], d), dot(frame.shadow[2], d));
    vec3 at = vec3(frame.shadow[0].w, frame.shadow[1].w, frame.shadow[2].w - frame.shadowRange.x);
    span = rayBox(at, rate, vec3(0.0f), vec3(1.0f, 1.0f, 1.0e9f));
    span.end = max(min(span.end, reach), span.begin);
  }
  if (MAP_SHADOWS) {
    Span map = mapSpan(direction, reach);
    bool only = !(span.end > span.begin);
    bool none = !(map.end > map.begin);
    span.begin = only ? map.begin : (none ? span.begin : min(span.begin, map.begin));
    span.end = only ? map.end : (none ? span.end : max(span.end, map.end));
  }
  return span;
}

// Ends of the steps are denser towards the eye. What is thinner than a step is met or missed by
// chance: with the engine's map by that of the pixel (interleaved gradient noise, Jimenez 2014),
// which stands still, since the same chance in all pixels would draw bands.
float shadowStop(Span span, int i, float chance) {
  float s = float(i) / float(SHADOW_STEPS);
  if (MAP_SHADOWS) {
    s = min((float(i - 1) + chance) / float(SHADOW_STEPS - 1), 1.0f);
  }
  return span.begin + (span.end - span.begin) * s * s;
}

float pixelChance(uvec2 pixel) {
  return fract(52.9829189f * fract(dot(vec2(pixel), vec2(0.06711056f, 0.00583715f))));
}

// Radiance that the shadows take from air and fog on the ray. `passes`: transmittance of all
// volumes on it. From above the air nothing.
vec3 shadowedLight(Air air, AirRay ray, vec3 direction, float reach, float passes, uvec2 pixel) {
  AirPath path = clipToAir(air, ray, reach);
  Span span = shadowSpan(direction, ray.altitude > path.altitude ? 0.0f : path.reach);
  float chance = pixelChance(pixel);
  float before = span.begin;
  int i = 1;
  float hides = 0.0f;
  if (VOLUME_SHADOWS) {
    // Extinction of the volumes by the map, which gives the pixel's own its place.
    float all = 0.0f;
    do {
      float next = shadowStop(span, i, chance);
      all += volumeShadow(direction * (0.5f * (before + next))).z * (next - before);
      before = next;
      i += 1;
    } while (i <= SHADOW_STEPS);
    hides = -log(max(passes, 1.0e-20f)) / max(all, 1.0e-20f);
  }

  LightUniforms light = frame.lights[0];
  float airPhase = rayleighPhase(1.0f - ray.viewSun);
  vec3 droplets = FOG_ENABLED ? fogPhaseOf(direction, light.direction.xyz) : vec3(0.0f);
  vec3 seen = exp(-airOpticalDepth(air, ray, span.begin));
  float crossed = 0.0f;
  MapMarch march;
  march.at = span.begin;
  march.dark = 0.0f;
  if (MAP_SHADOWS) {
    march.dark = mapShadow(direction * span.begin);
  }
  vec3 lost = vec3(0.0f);
  before = span.begin;
  i = 1;
  do {
    float next = shadowStop(span, i, chance);
    float step_ = next - before;
    float t = 0.5f * (before + next);
    AirRay there = advanceRay(air, ray, t);
    vec3 source = vec3(0.0f);
    vec3 extinction = vec3(0.0f);
    if (AIR_ENABLED) {
      vec3 beta = air.airScattering *
                  layerDensity(layerExponent(there.altitude, 0.0f, air.airScaleHeight));
      source += beta * airPhase;
      extinction += beta;
    }
    if (FOG_ENABLED) {
      float exponent = layerExponent(there.altitude, air.fogBaseAltitude, air.fogScaleHeight);
      float beta = air.fogExtinction * layerDensity(exponent);
      source += air.fogAlbedo * droplets * beta;
      extinction += vec3(beta);
    }
    if (ABSORBER_ENABLED) {
      float below = abs(there.altitude - air.absorberPeak) / air.absorberWidth;
      extinction += air.absorption * max(1.0f - below, 0.0f);
    }
    vec3 x = extinction * step_;
    vec3 average = vec3(phi1(x.x), phi1(x.y), phi1(x.z)) * step_;
    vec3 sun = exp(-lightOpticalDepth(air, there.altitude, there.sunMu)) *
               lightVisibility(air, there.altitude, there.sunMu, light.direction.w);
    // Without the volumes' own map they hide all that lies behind the nearest one.
    float shown = t < frame.shadowRange.z ? 1.0f : passes;
    float gone = 0.0f;
    if (VOLUME_SHADOWS) {
      vec3 volume = volumeShadow(direction * t);
      crossed += 0.5f * volume.z * step_;
      shown = exp(-min(hides * crossed, 46.0f));
      crossed += 0.5f * volume.z * step_;
      gone = lostBehind(volume.xy);
    }
    if (MAP_SHADOWS) {
      gone += (1.0f - gone) * marchMap(march, direction, next);
    }
    lost += seen * sun * source * average * (shown * gone);
    seen *= exp(-x);
    before = next;
    i += 1;
  } while (i <= SHADOW_STEPS);
  return lost * light.irradiance.xyz;
}
