// SPDX-License-Identifier: MIT
// Light in air and fog that was scattered or reflected before it reached a ray, per unit irradiance
// of the light (1/sr): the moments of src/tables/sky_field.hpp and the fog's table of
// src/tables/fog_light.hpp gathered along the ray. What differs between this text and
// SkyField::higherOrdersAlong is held by tests/image/sky_light_test.cpp.

// A sun among four nodes in a row, as sunNodes() of src/tables/sky_table.hpp: cubic, at the texels'
// centres, as filters of 8 bits would show in twilight.
struct SunNodes {
  int first;
  vec4 weights;
};

const float SUN_BEND = 0.25f;
SunNodes sunNodes(float mu) {
  float size = abs(mu);
  float from = 0.5f * (1.0f + SUN_BEND) * mu / (SUN_BEND + size);
  float x = (0.5f + from) * float(MOMENT_SUNS - 1);
  float index = clamp(floor(x), 0.0f, float(MOMENT_SUNS - 2));
  float first = clamp(index, 1.0f, float(MOMENT_SUNS - 3)) - 1.0f;
  float t = clamp(x - index, 0.0f, 1.0f);
  float u = 1.0f - t;
  SunNodes nodes;
  nodes.first = int(first);
  nodes.weights = vec4(-0.5f * t * u * u, u * (1.0f + t - 1.5f * t * t),
                       t * (1.0f + u - 1.5f * u * u), -0.5f * u * t * t);
  if (index < first + 1.0f) {
    nodes.weights = vec4(0.5f * u * (2.0f - t), t * (2.0f - t), -0.5f * t * u, 0.0f);
  } else if (index > first + 1.0f) {
    nodes.weights = vec4(0.0f, -0.5f * t * u, u * (1.0f + t), 0.5f * t * (1.0f + t));
  }
  return nodes;
}

vec3 texelRow(int row, SunNodes sun) {
  return sun.weights.x * texelFetch(skyMoments, ivec2(sun.first, row), 0).xyz +
         sun.weights.y * texelFetch(skyMoments, ivec2(sun.first + 1, row), 0).xyz +
         sun.weights.z * texelFetch(skyMoments, ivec2(sun.first + 2, row), 0).xyz +
         sun.weights.w * texelFetch(skyMoments, ivec2(sun.first + 3, row), 0).xyz;
}

// A row of the table for one sun, RGB, between texels by hand: filters read twice the texels.
vec3 rowAt(float row, SunNodes sun) {
  int low = clamp(int(row), 0, MOMENT_ROWS - 2);
  return mix(texelRow(low, sun), texelRow(low + 1, sun), row - float(low));
}

// Diffuse light on horizontal ground at sea level, RGB.
vec3 groundLight(float sunMu) {
  vec3 light = rowAt(float(MOMENT_ROWS - 1), sunNodes(sunMu));
  return frame.skyLight.z * max(light, vec3(0.0f));
}

// Integrals over all directions w of L and of L (v w)^2.
struct SkyMoments {
  vec3 mean;
  vec3 square;
};

vec3 momentAt(float row, SunNodes sun, int moment) {
  return rowAt(row + float(moment * MOMENT_ALTITUDES), sun);
}

// v: the view in the frame of the moments, y up, x towards the light.
SkyMoments skyMomentsAt(float altitude, float sunMu, vec3 v) {
  float top = frame.skyLight.x;
  float h = clamp(altitude, 0.0f, top);
  // Whether the view shows it or not, the moments know of the fog.
  float fogHeight = frame.skyView.z;
  float high = (1.0f - frame.skyLight.y) * sqrt(h / top) +
               frame.skyLight.y * oneMinusExp(h / fogHeight) / oneMinusExp(top / fogHeight);
  SunNodes sun = sunNodes(sunMu);
  float row = high * float(MOMENT_ALTITUDES - 1);
  vec3 xx = momentAt(row, sun, 0);
  vec3 yy = momentAt(row, sun, 1);
  vec3 zz = momentAt(row, sun, 2);
  vec3 xy = momentAt(row, sun, 3);
  SkyMoments m;
  m.mean = xx + yy + zz;
  m.square = v.x * v.x * xx + v.y * v.y * yy + v.z * v.z * zz + 2.0f * v.x * v.y * xy;
  m.mean *= frame.skyLight.z;
  m.square *= frame.skyLight.z;
  return m;
}

// Relative error 3e-7.
float logOnePlus(float x) {
  return x > 1.0e-2f ? log(1.0f + x) : x * (1.0f - x * (0.5f - x / 3.0f));
}

// What fog scatters into a direction of the light around it, over lobe(), as FogLight::sourceAt();
// in twilight it darkens as the ground does. v: as for skyMomentsAt().
vec3 fogSourceAt(float altitude, float sunMu, vec3 v) {
  const float PER_PI = 0.318309886f;
  float flat_ = sqrt(max((1.0f - v.y) * (1.0f + v.y), 0.0f));
  float above =
      frame.fogTable.x * safeExp(-clamp(altitude / frame.skyView.z, 0.0f, 30.0f));
  vec3 node;
  node.x = PER_PI * acos(clamp(v.y, -1.0f, 1.0f)) * float(FOG_VIEWS - 1);
  node.y = sqrt(PER_PI * acos(clamp(v.x / max(flat_, 1.0e-6f), -1.0f, 1.0f))) *
           float(FOG_AZIMUTHS - 1);
  node.z = min(logOnePlus(above) * frame.fogTable.y, 1.0f) * float(FOG_HEIGHTS - 1);
  float high = 2.0f * PER_PI * asin(clamp(sunMu, 0.0f, 1.0f));
  float sun = exp(log(max(high, 1.0e-12f)) * (2.0f / 3.0f)) * float(FOG_SUNS - 1);
  float low = min(floor(sun), float(FOG_SUNS - 2));
  node.z += low * float(FOG_HEIGHTS);
  vec3 size = vec3(float(FOG_VIEWS), float(FOG_AZIMUTHS), float(FOG_SUNS * FOG_HEIGHTS));
  vec3 uvw = (node + 0.5f) / size;
  vec3 a = textureLod(skyFog, uvw, 0.0f).xyz;
  vec3 b = textureLod(skyFog, uvw + vec3(0.0f, 0.0f, float(FOG_HEIGHTS) / size.z), 0.0f).xyz;
  vec3 light = mix(a, b, sun - low);
  vec3 now = groundLight(min(sunMu, 0.0f));
  return light * min(now / max(groundLight(0.0f), vec3(1.0e-30f)), vec3(1.0f));
}

// A ray as far as it was gathered.
struct SkyMarch {
  AirPoint at;
  vec3 columns;
  vec3 light;
  // First order of what fog turned within its forward peak only, per unit of its phase function.
  vec3 peak;
  // What fog scattered of other light, over lobe().
  vec3 fog;
};

SkyMarch skyMarchBegin(Air air, AirPath path) {
  SkyMarch march;
  march.at = airPoint(air, path, 0.0f);
  march.columns = vec3(0.0f);
  march.light = vec3(0.0f);
  march.peak = vec3(0.0f);
  march.fog = vec3(0.0f);
  return march;
}

// Share of a stretch's light that arrives, where `before` lies in front of it: e^-before times the
// mean transmittance of its own depth.
vec3 seenThrough(vec3 before, vec3 own) {
  return safeExp3(-before) * vec3(phi1(own.x), phi1(own.y), phi1(own.z));
}

// On to distance t. lightRadius: angular radius of the light.
SkyMarch skyMarchTo(Air air, AirPath path, SkyMarch march, float t, float lightRadius) {
  AirPoint next = airPoint(air, path, t);
  AirSpan span = airSpan(air, path, march.at, next);
  vec3 own = columnsOf(span);
  // Air as the eye sees it: part of the fog's peak counts as unscattered.
  Air eyeAir = air;
  eyeAir.fogExtinction = frame.eyeFog.w;
  vec3 before = depthOfColumns(eyeAir, march.columns);
  vec3 depth = depthOfColumns(eyeAir, own);
  vec3 seen = seenThrough(before, depth);
  // Where the light comes from in the mean: 1/x - 1/(e^x - 1) of the way.
  float x = depth.y;
  float centre = x > 1.0e-2f ? 1.0f / x - (1.0f - oneMinusExp(x)) / oneMinusExp(x)
                             : 0.5f - x / 12.0f;
  float place = mix(march.at.distance, t, centre);
  float altitude = altitudeAlongRay(path.altitude, path.viewMu, air.planetRadius, place);
  float radius = air.planetRadius + altitude;
  float origin = air.planetRadius + path.altitude;
  float sunMu = clamp((origin * path.sunMu + place * path.viewSun) / radius, -1.0f, 1.0f);
  vec3 v;
  v.y = clamp((origin * path.viewMu + place) / radius, -1.0f, 1.0f);
  float sine = sqrt(max((1.0f - sunMu) * (1.0f + sunMu), 0.0f));
  float flat_ = sqrt(max((1.0f - v.y) * (1.0f + v.y), 0.0f));
  v.x = clamp((path.viewSun - sunMu * v.y) / max(sine, 1.0e-4f), -flat_, flat_);
  v.z = sqrt(max((flat_ - v.x) * (flat_ + v.x), 0.0f));
  SkyMoments m = skyMomentsAt(altitude, sunMu, v);
  vec3 airPart = air.airScattering * own.x;
  vec3 fogPart = frame.eyeFog.xyz * (frame.eyeFog.w * own.y);
  // Cubics may run below zero in the dark.
  march.light += seen * airPart * RAYLEIGH_NORM * max(m.mean + m.square, vec3(0.0f));
  if (FOG_ENABLED) {
    march.fog += seen * fogPart * fogSourceAt(altitude, sunMu, v) * frame.skyLight.z;
    // Light of the peak: first order in the eye's air, less first order in all of the fog.
    vec3 seenLess = seenThrough(depthOfColumns(air, march.columns), depthOfColumns(air, own));
    vec3 sun = safeExp3(-lightOpticalDepth(eyeAir, altitude, sunMu));
    vec3 sunLess = safeExp3(-lightOpticalDepth(air, altitude, sunMu));
    float visible = lightVisibility(air, altitude, sunMu, lightRadius);
    vec3 more = max(seen * sun - seenLess * sunLess, vec3(0.0f)) * visible;
    march.light += more * airPart * rayleighPhase(1.0f - path.viewSun);
    march.peak += more * fogPart;
  }
  march.columns += own;
  march.at = next;
  return march;
}

// Distance of stop x (0..1): dense towards the eye, or towards the lowest point of a ray that
// sinks.
float skyStop(AirPath path, float x) {
  if (path.lowest <= 0.0f) {
    return path.reach * x * x;
  }
  if (path.lowest >= path.reach) {
    return path.reach * x * (2.0f - x);
  }
  float y = x < 0.5f ? 2.0f * x : 2.0f * x - 1.0f;
  return x < 0.5f ? path.lowest * y * (2.0f - y)
                  : path.lowest + (path.reach - path.lowest) * y * y;
}
