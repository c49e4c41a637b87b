// SPDX-License-Identifier: MIT
// Light in air and fog that was scattered or reflected before it reached a ray, per unit irradiance
// of the light (1/sr): the moments of src/tables/sky_field.hpp gathered along the ray. What differs
// between this text and SkyField::higherOrdersAlong is held by tests/image/sky_light_test.cpp.
const int MOMENT_SUNS = 48;
const int MOMENT_ALTITUDES = 32;
const int MOMENT_COUNT = 6;
const float MOMENT_ROWS = 193.0f;  // of the image: 6 blocks of altitudes, then the ground's row
const float ISOTROPIC_PHASE = 0.0795774715f;

float sunCoordinate(float mu) {
  float x = 0.5f + 0.5f * sign(mu) * sqrt(abs(mu));
  return (x * float(MOMENT_SUNS - 1) + 0.5f) / float(MOMENT_SUNS);
}

// Diffuse light on horizontal ground at sea level, RGB.
vec3 groundLight(float sunMu) {
  vec2 uv = vec2(sunCoordinate(sunMu), (MOMENT_ROWS - 0.5f) / MOMENT_ROWS);
  return frame.skyLight.z * textureLod(skyMoments, uv, 0.0f).xyz;
}

// Integrals over all directions w of L, of L (v w) and of L (v w)^2.
struct SkyMoments {
  vec3 mean;
  vec3 along;
  vec3 square;
};

vec3 momentAt(vec2 uv, int moment) {
  uv.y += float(moment * MOMENT_ALTITUDES) / MOMENT_ROWS;
  return textureLod(skyMoments, uv, 0.0f).xyz;
}

// v: the view in the frame of the moments, y up, x towards the light.
SkyMoments skyMomentsAt(float altitude, float sunMu, vec3 v) {
  float top = frame.skyLight.x;
  float h = clamp(altitude, 0.0f, top);
  // Whether the view shows it or not, the moments know of the fog.
  float fogHeight = frame.skyView.z;
  float high = (1.0f - frame.skyLight.y) * sqrt(h / top) +
               frame.skyLight.y * oneMinusExp(h / fogHeight) / oneMinusExp(top / fogHeight);
  vec2 uv = vec2(sunCoordinate(sunMu),
                 (high * float(MOMENT_ALTITUDES - 1) + 0.5f) / MOMENT_ROWS);
  vec3 xx = momentAt(uv, 0);
  vec3 yy = momentAt(uv, 1);
  vec3 zz = momentAt(uv, 2);
  vec3 xy = momentAt(uv, 3);
  SkyMoments m;
  m.mean = xx + yy + zz;
  m.square = v.x * v.x * xx + v.y * v.y * yy + v.z * v.z * zz + 2.0f * v.x * v.y * xy;
  m.along = vec3(0.0f);
  if (FOG_ENABLED) {
    m.along = v.x * momentAt(uv, 4) + v.y * momentAt(uv, 5);
  }
  m.mean *= frame.skyLight.z;
  m.square *= frame.skyLight.z;
  m.along *= frame.skyLight.z;
  return m;
}

// A ray as far as it was gathered.
struct SkyMarch {
  AirPoint at;
  vec2 columns;
  vec3 light;
  // First order of what fog turned within its forward peak only, per unit of its phase function.
  vec3 peak;
};

SkyMarch skyMarchBegin(Air air, AirPath path) {
  SkyMarch march;
  march.at = airPoint(air, path, 0.0f);
  march.columns = vec2(0.0f);
  march.light = vec3(0.0f);
  march.peak = vec3(0.0f);
  return march;
}

// Share of a stretch's light that arrives, where `before` lies in front of it: e^-before times the
// mean transmittance of its own depth.
vec3 seenThrough(vec3 before, vec3 own) {
  return safeExp3(-before) * vec3(phi1(own.x), phi1(own.y), phi1(own.z));
}

// On to distance t.
SkyMarch skyMarchTo(Air air, AirPath path, SkyMarch march, float t) {
  AirPoint next = airPoint(air, path, t);
  AirSpan span = airSpan(air, path, march.at, next);
  vec2 own = vec2(span.air.column, span.fog.column);
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
  march.light += seen * airPart * RAYLEIGH_NORM * (m.mean + m.square);
  if (FOG_ENABLED) {
    vec3 source = m.mean + frame.fogFirst.xyz * m.along +
                  frame.fogSecond.xyz * (3.0f * m.square - m.mean);
    march.light += seen * fogPart * ISOTROPIC_PHASE * max(source, vec3(0.0f));
    // Light of the peak: first order in the eye's air, less first order in all of the fog.
    vec3 seenLess = seenThrough(depthOfColumns(air, march.columns), depthOfColumns(air, own));
    vec3 sun = safeExp3(-lightOpticalDepth(eyeAir, altitude, sunMu));
    vec3 sunLess = safeExp3(-lightOpticalDepth(air, altitude, sunMu));
    float visible = lightVisibility(air, altitude, sunMu, frame.light.w);
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
