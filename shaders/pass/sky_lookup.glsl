// SPDX-License-Identifier: MIT
// Reads the tables that sky_table.comp wrote: mean source, radiance / opacity of what scatters, per
// unit irradiance of the light (1/sr), of light scattered at least twice. It varies slowly along a
// ray, so the pixel's own exact opacity carries the detail.

// Filters read the row after the last one, too, which holds anything, unless they stay this side.
const float LAST_ZENITH = float(SKY_BELOW - 1) - 1.0f / 64.0f;

// Table coordinates of a ray's direction, for one of the lights side by side. They do not depend on
// how the camera is turned.
vec2 skyTableDirection(AirRay ray, int light) {
  float horizon = frame.skyView.x;
  float above = frame.skyZeniths.w;
  bool below = ray.viewMu < horizon;
  float range = below ? 1.0f + horizon : frame.skyView.y - horizon;
  float rise = clamp(abs(ray.viewMu - horizon) / max(range, 1.0e-12f), 0.0f, 1.0f);
  float bend = above > float(SKY_ABOVE) ? 1.0f : 0.0f;
  rise = sqrt((1.0f + bend) * rise / (1.0f + bend * rise));
  float sines = sqrt(max((1.0f - ray.viewMu) * (1.0f + ray.viewMu), 0.0f)) *
                sqrt(max((1.0f - ray.sunMu) * (1.0f + ray.sunMu), 0.0f));
  float azimuth = clamp((ray.viewSun - ray.viewMu * ray.sunMu) / max(sines, 1.0e-6f), -1.0f, 1.0f);
  vec2 node = vec2((0.5f - 0.5f * azimuth) * float(SKY_AZIMUTHS - 1),
                   below ? above + min(rise * float(SKY_BELOW - 1), LAST_ZENITH)
                         : rise * (above - 1.0f));
  node.x += float(light * SKY_AZIMUTHS);
  return (node + 0.5f) / vec2(float(SKY_AZIMUTHS), float(SKY_ZENITHS)) *
         vec2(frame.fogAlbedo.w, 1.0f);
}

vec3 skyTableUvw(vec2 direction, float share) {
  return vec3(direction, (share * float(SKY_SHARES - 1) + 0.5f) / float(SKY_SHARES));
}

// With ALL_LIGHT the table holds all light of clear air, per unit of its phase function.
vec3 skyTableSource(vec2 direction, float share, float viewSun) {
  return rayleighPhase(1.0f - viewSun) *
         textureLod(skyTable, skyTableUvw(direction, clamp(share, 0.0f, 1.0f)), 0.0f).xyz;
}

// What the table says of a whole ray; `total` its opacity in green.
struct SkyTableRay {
  vec2 direction;
  vec3 source;
  float total;
};

SkyTableRay skyTableRay(AirRay ray, int light) {
  SkyTableRay result;
  result.direction = skyTableDirection(ray, light);
  vec4 whole = textureLod(skyTable, skyTableUvw(result.direction, 1.0f), 0.0f);
  result.source = whole.xyz;
  result.total = whole.w;
  return result;
}

// Two tables of what fog adds, one behind the other: per unit of its phase function without the
// eye's part of its peak, and of fogLobe().
vec3 skyPeakUvw(vec3 uvw, float which) {
  return vec3(uvw.xy, 0.5f * (uvw.z + which));
}

vec3 fogWithoutPeak(vec3 droplets) {
  return min(droplets * frame.fogTable.w, frame.fogBound.xyz);
}

// As FogLight::lobe().
float fogLobe(float viewSun) {
  const float PEAKED = 0.75f;
  float g = frame.fogTable.z;
  float apart = (1.0f - g) * (1.0f - g) + 2.0f * g * (1.0f - clamp(viewSun, -1.0f, 1.0f));
  return (1.0f - PEAKED) + PEAKED * (1.0f - g * g) / (apart * sqrt(apart));
}

// Mean source of the part of the ray with this opacity. droplets: the fog's phase function.
vec3 skySourceAt(SkyTableRay ray, vec3 opacity, vec3 droplets, float viewSun) {
  float share = clamp(opacity.y / max(ray.total, 1.0e-30f), 0.0f, 1.0f);
  vec3 uvw = skyTableUvw(ray.direction, share);
  vec3 source = textureLod(skyTable, uvw, 0.0f).xyz;
  if (FOG_ENABLED) {
    source += fogWithoutPeak(droplets) * textureLod(skyPeak, skyPeakUvw(uvw, 0.0f), 0.0f).xyz;
    source += fogLobe(viewSun) * textureLod(skyPeak, skyPeakUvw(uvw, 1.0f), 0.0f).xyz;
  }
  return source;
}

vec3 opacityOf(vec3 depth) {
  return vec3(oneMinusExp(depth.x), oneMinusExp(depth.y), oneMinusExp(depth.z));
}
