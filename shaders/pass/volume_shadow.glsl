// SPDX-License-Identifier: MIT
// What volumes take from the first light before air and fog scatter it towards the eye: single
// scattering along the ray by the midpoint rule, times the light that a map of layers (optical
// depth and the distances along the light between which it rises evenly) lacks there. The map also
// tells roughly where on the ray the volumes hide what lies behind; how much, the pixel knows.
layout(constant_id = 12) const bool SHADOWS_ENABLED = false;
layout(set = 0, binding = 11) uniform sampler2D shadowMap;

const int SHADOW_STEPS = 24;
const float THINNEST_LAYER = 1.0f;  // m

// Optical depth to the light, and extinction (1/m), of volumes at a position relative to the eye.
vec2 volumeShadow(vec3 position) {
  vec4 p = vec4(position, 1.0f);
  vec2 uv = vec2(dot(frame.shadow[0], p), dot(frame.shadow[1], p));
  vec3 layer = textureLod(shadowMap, uv, 0.0f).xyz;  // its border is empty
  float thickness = max(layer.z - layer.y, THINNEST_LAYER);
  float rise = (dot(frame.shadow[2], p) - layer.y) / thickness;
  float within = rise > 0.0f && rise < 1.0f ? layer.x / thickness : 0.0f;
  return vec2(layer.x * clamp(rise, 0.0f, 1.0f), within);
}

// Stretch of the ray that the map covers, not nearer to the light than all volumes.
Span shadowSpan(vec3 direction, float reach) {
  vec4 d = vec4(direction, 0.0f);
  vec3 rate = vec3(dot(frame.shadow[0], d), dot(frame.shadow[1], d), dot(frame.shadow[2], d));
  vec3 at = vec3(frame.shadow[0].w, frame.shadow[1].w, frame.shadow[2].w - frame.shadowRange.x);
  Span span = rayBox(at, rate, vec3(0.0f), vec3(1.0f, 1.0f, 1.0e9f));
  span.end = max(min(span.end, reach), span.begin);
  return span;
}

// Ends of the steps are denser towards the eye.
float shadowStop(Span span, int i) {
  float s = float(i) / float(SHADOW_STEPS);
  return span.begin + (span.end - span.begin) * s * s;
}

// Radiance that the shadows take from air and fog on the ray. `passes`: transmittance of all
// volumes on it. From above the air nothing.
vec3 shadowedLight(Air air, AirRay ray, vec3 direction, float reach, float passes) {
  AirPath path = clipToAir(air, ray, reach);
  Span span = shadowSpan(direction, ray.altitude > path.altitude ? 0.0f : path.reach);
  // Extinction of the volumes by the map, which gives the pixel's own its place.
  float all = 0.0f;
  float before = span.begin;
  int i = 1;
  do {
    float next = shadowStop(span, i);
    all += volumeShadow(direction * (0.5f * (before + next))).y * (next - before);
    before = next;
    i += 1;
  } while (i <= SHADOW_STEPS);
  float hides = -log(max(passes, 1.0e-20f)) / max(all, 1.0e-20f);

  LightUniforms light = frame.lights[0];
  float airPhase = rayleighPhase(1.0f - ray.viewSun);
  vec3 droplets = FOG_ENABLED ? fogPhaseOf(direction, light.direction.xyz) : vec3(0.0f);
  vec3 seen = exp(-airOpticalDepth(air, ray, span.begin));
  float crossed = 0.0f;
  vec3 lost = vec3(0.0f);
  before = span.begin;
  i = 1;
  do {
    float next = shadowStop(span, i);
    float step_ = next - before;
    float t = 0.5f * (before + next);
    vec2 volume = volumeShadow(direction * t);
    AirRay there = advanceRay(air, ray, t);
    vec3 source = vec3(0.0f);
    vec3 extinction = vec3(0.0f);
    if (AIR_ENABLED) {
      vec3 beta = air.airScattering * exp(-max(there.altitude, 0.0f) / air.airScaleHeight);
      source += beta * airPhase;
      extinction += beta;
    }
    if (FOG_ENABLED) {
      float height = max(there.altitude - air.fogBaseAltitude, 0.0f);
      float beta = air.fogExtinction * exp(-height / air.fogScaleHeight);
      source += air.fogAlbedo * droplets * beta;
      extinction += vec3(beta);
    }
    vec3 x = extinction * step_;
    vec3 average = vec3(phi1(x.x), phi1(x.y), phi1(x.z)) * step_;
    vec3 sun = exp(-lightOpticalDepth(air, there.altitude, there.sunMu)) *
               lightVisibility(air, there.altitude, there.sunMu, light.direction.w);
    crossed += 0.5f * volume.y * step_;
    float shown = exp(-min(hides * crossed, 46.0f));
    crossed += 0.5f * volume.y * step_;
    lost += seen * sun * source * average * (shown * oneMinusExp(volume.x));
    seen *= exp(-x);
    before = next;
    i += 1;
  } while (i <= SHADOW_STEPS);
  return lost * light.irradiance.xyz;
}
