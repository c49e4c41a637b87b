// SPDX-License-Identifier: MIT
// Radiance and transmittance of clear air, whose light of all orders is in the sky table. Written
// for few operations: a frame of clear sky spends most of its time here.

// Farther than any air, and far from the end of floats when squared. m.
const float FARTHEST = 1.0e15f;
// Sag of a ray's chord, in scale heights, up to which layerSpan() is exact with the ray's lowest
// point between its ends, too: 320 km on Earth.
const float STRAIGHT_SAG = 0.25f;

// A ray from within the air, without an end: clipToAir() where it clips nothing.
AirPath rayWithinAir(Air air, AirRay ray) {
  float radius = air.planetRadius + ray.altitude;
  AirPath path;
  path.altitude = ray.altitude;
  path.viewMu = ray.viewMu;
  path.sunMu = ray.sunMu;
  path.viewSun = ray.viewSun;
  path.reach = FARTHEST;
  path.lowest = -radius * ray.viewMu;
  path.lowestRadius = radius * sqrt(max((1.0f - ray.viewMu) * (1.0f + ray.viewMu), 0.0f));
  if (ABSORBER_ENABLED) {
    path.absorber = absorberRay(ray.altitude, radius * ray.viewMu, air.planetRadius,
                                air.absorberPeak, air.absorberWidth);
  }
  return path;
}

// Of a clear ray: where it was cut and where the table's ends, and whether that is on the planet.
struct ClearRay {
  AirPath path;
  float own;
  float end;
  bool meets;
};

ClearRay clearRay(Air air, AirRay ray, float reach, float ground) {
  ClearRay clear;
  clear.path = rayWithinAir(air, ray);
  clear.meets = ground >= 0.0f;
  // As clipToAir(): below the horizon rays are stopped underground.
  float depth = max(ray.altitude, 0.0f) + UNDERGROUND;
  float under = groundDistance(depth, ray.viewMu, air.planetRadius + ray.altitude - depth);
  float longest = clear.meets && under >= 0.0f ? under : FARTHEST;
  clear.own = min(reach, longest);
  clear.end = min(skyTableReach(ground, true), longest);
  return clear;
}

// Columns of air up to the cut and along all of the table's ray. m.
struct ClearColumns {
  float seen;
  float whole;
};

ClearColumns clearColumns(Air air, ClearRay ray) {
  AirPath path = ray.path;
  LayerPoint there;
  float height = altitudeAlongRay(path.altitude, path.viewMu, air.planetRadius, ray.own);
  there.exponent = min(layerExponent(height, 0.0f, air.airScaleHeight), LAYER_SOLID);
  there.density = layerDensity(there.exponent);
  float radius = air.planetRadius + 0.5f * (path.altitude + height);
  float across = ray.own * path.lowestRadius / radius;
  float sag = across * across / (8.0f * radius);
  bool sky = !ray.meets && ray.own >= FARTHEST;
  bool near = sag < STRAIGHT_SAG * air.airScaleHeight;
  bool sinks = path.lowest > 0.0f;
  bool remote = !near && ray.own < ray.end;
  // Columns to infinity, away from the ray's lowest point. lavapipe runs both sides of a branch but
  // leaves loops: many rays need the eye's only, few the third.
  LayerPoint eye;
  float turn = 0.0f;
  float last = 0.0f;
  int point = 0;
  float t = 0.0f;
  for (;;) {
    float altitude = altitudeAlongRay(path.altitude, path.viewMu, air.planetRadius, t);
    LayerPoint next = layerPoint(altitude, 0.0f, air.airScaleHeight, air.planetRadius + altitude,
                                 t - path.lowest);
    if (point == 0) {
      eye = next;
    } else if (point == 1) {
      turn = next.column;
    } else {
      last = next.column;
    }
    bool toTurn = point == 0 && sinks;
    if (!toTurn && (!remote || point == 2)) {
      break;
    }
    point = toTurn ? 1 : 2;
    t = toTurn ? (ray.meets ? ray.end : path.lowest) : ray.own;
  }
  ClearColumns columns;
  float both = ray.meets ? turn : 2.0f * turn;
  columns.whole = sinks ? max(both - eye.column, 0.0f) : eye.column;
  bool past = sinks && !ray.meets && ray.own > path.lowest;
  float beyond = past ? max(columns.whole - last, 0.0f) : abs(eye.column - last);
  float straight = layerSpan(eye, there, air.airScaleHeight, ray.own, sag).column;
  columns.seen = near ? straight : (remote ? beyond : columns.whole);
  columns.seen = sky ? columns.whole : columns.seen;
  return columns;
}

// 1 - e^-x, given e^-x: as oneMinusExp().
float opacityFrom(float x, float transmittance) {
  return x < 0.5f ? x * phi1Small(x) : 1.0f - transmittance;
}

// Radiance and transmittance of clear air over `reach`.
PixelLayer clearAir(Air air, AirRay ray, vec3 direction, float reach, float ground) {
  ClearRay clear = clearRay(air, ray, reach, ground);
  ClearColumns columns = clearColumns(air, clear);
  vec3 depth = air.airScattering * columns.seen;
  vec3 passed = exp(-depth);
  vec3 opacity = vec3(opacityFrom(depth.x, passed.x), opacityFrom(depth.y, passed.y),
                      opacityFrom(depth.z, passed.z));
  float total = oneMinusExp(air.airScattering.y * columns.whole);
  float share = clear.own >= clear.end ? 1.0f : opacity.y / max(total, 1.0e-30f);
  PixelLayer layer;
  layer.radiance = vec3(0.0f);
  for (int i = 0; i < int(LIGHT_COUNT); ++i) {
    LightUniforms light = frameBlock.lights[i];
    AirRay lit = airRayOf(frame, light, direction);
    vec3 source = skyTableSource(skyTableDirection(lit, i), share, lit.viewSun);
    layer.radiance += source * light.irradiance.xyz;
  }
  layer.radiance *= opacity;
  layer.transmittance = passed;
  if (ABSORBER_ENABLED) {
    AirPath path = clear.path;
    float gas = absorberColumn(path.absorber, clear.own - path.lowest, air.planetRadius,
                               air.absorberPeak, air.absorberWidth) -
                absorberColumn(path.absorber, -path.lowest, air.planetRadius, air.absorberPeak,
                               air.absorberWidth);
    layer.transmittance *= exp(-air.absorption * max(gas, 0.0f));
  }
  return layer;
}
