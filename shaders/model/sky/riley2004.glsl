// SPDX-License-Identifier: MIT
// Once-scattered light and optical depth of air and one fog layer on a spherical planet, RGB, per
// unit irradiance of the light (1/sr). Follows [R04] 4.1; rewritten: the two-ended segments of
// segment.glsl are fed with spherical light depths, so few segments replace the flat closed form.
// Both species are exponential in altitude. Errors against quadrature (tests/unit/sky_test.cpp),
// p95 and worst of random rays: air to 50 km 0.1 and 0.2 %, sky with suns to 80 degrees 0.3 and
// 1 %, to 88 degrees 2 and 3 %; with fog 0.5 and 1.5 %, fog from above 1 and 12 % (grazing). Float
// follows double to 1e-4.

struct Air {
  real planetRadius;
  vec3 airScattering;
  real airScaleHeight;
  real fogExtinction;
  real fogBaseAltitude;
  real fogScaleHeight;
  vec3 fogAlbedo;
};

// A ray at its origin: cosines of view and light with the local up and with each other.
struct AirRay {
  real altitude;
  real viewMu;
  real sunMu;
  real viewSun;
};

struct AirResult {
  vec3 radiance;
  vec3 opticalDepth;
};

// Scale heights above the base after which a layer counts as ended: e^-30 of 1e6 optical depths.
const real LAYER_EXTENT = real(30.0f);
// Rays may go this far below the lower of sea level and origin before they are stopped, in m.
const real UNDERGROUND = real(1000.0f);

// The part of a ray inside the layers.
struct AirPath {
  real altitude;
  real viewMu;
  real sunMu;
  real viewSun;
  real reach;
  // Distance to the point nearest the planet's centre, and that point's radius.
  real lowest;
  real lowestRadius;
};

// A point of a ray.
struct AirPoint {
  real distance;
  real altitude;
  LayerPoint air;
  LayerPoint fog;
};

// Area fraction of a disk of half angle `angularRadius` above the geometric horizon, 0..1: within
// 1.2e-3 of the circle's segment (odd polynomial of degree 5). The sine of the light's height above
// the horizon is (mu R + sqrt(h (2R + h)) sqrt(1 - mu^2)) / (R + h); above 90 degrees mu is larger.
const real DISK_1 = real(0.62970841);
const real DISK_3 = real(-0.06792375);
const real DISK_5 = real(-0.06178466);
const real SMALLEST_DISK = real(1e-5);
real lightVisibility(Air air, real altitude, real lightMu, real angularRadius) {
  real h = max(altitude, real(0.0f));
  real dip = sqrt(altitudePower(h, air.planetRadius));
  real sinus = sqrt(max((real(1.0f) - lightMu) * (real(1.0f) + lightMu), real(0.0f)));
  real height = (lightMu * air.planetRadius + dip * sinus) / (air.planetRadius + h);
  real x = max(height, lightMu) / max(angularRadius, SMALLEST_DISK);
  x = clamp(x, real(-1.0f), real(1.0f));
  real z = x * x;
  return clamp(real(0.5f) + x * (DISK_1 + z * (DISK_3 + z * DISK_5)), real(0.0f), real(1.0f));
}

// Moves the ray's origin to the top of the layers if it lies above, and ends the ray there or
// underground, so that every number that follows is finite. The surface is the caller's to clip.
AirPath clipToAir(Air air, AirRay ray, real distance) {
  real top = real(1.0f);
  if (AIR_ENABLED) {
    top = LAYER_EXTENT * air.airScaleHeight;
  }
  if (FOG_ENABLED) {
    real fogTop = max(air.fogBaseAltitude, real(0.0f)) + LAYER_EXTENT * air.fogScaleHeight;
    top = max(top, fogTop);
  }
  real h = max(ray.altitude, real(-0.5f) * air.planetRadius);
  real radius = air.planetRadius + h;
  real topRadius = air.planetRadius + top;
  real lowest = radius * sqrt(max((real(1.0f) - ray.viewMu) * (real(1.0f) + ray.viewMu),
                                  real(0.0f)));
  bool above = h > top;
  bool reaches = !above || (ray.viewMu < real(0.0f) && lowest < topRadius);
  bool enters = above && reaches;
  // Entry: (r^2 - rt^2) / (r |mu| + rt |mu_t|), from above only.
  real chord = sqrt(max((topRadius - lowest) * (topRadius + lowest), real(0.0f)));
  real span = (h - top) * (radius + topRadius);
  real entry = enters ? span / (chord - radius * ray.viewMu) : real(0.0f);
  AirPath path;
  path.altitude = above ? top : h;
  path.viewMu = enters ? -chord / topRadius : ray.viewMu;
  path.sunMu = enters ? (radius * ray.sunMu + entry * ray.viewSun) / topRadius : ray.sunMu;
  path.sunMu = clamp(path.sunMu, real(-1.0f), real(1.0f));
  path.viewSun = ray.viewSun;
  path.lowestRadius = lowest;
  real r = air.planetRadius + path.altitude;
  real along = r * path.viewMu;
  path.lowest = -along;
  real leave = chord - along;
  leave = !above && along > real(0.0f) ? -span / (along + chord) : leave;
  real floorAltitude = min(path.altitude, real(0.0f)) - UNDERGROUND;
  real under = groundDistance(path.altitude - floorAltitude, path.viewMu,
                              air.planetRadius + floorAltitude);
  leave = under >= real(0.0f) ? under : leave;
  path.reach = reaches ? max(min(distance - entry, leave), real(0.0f)) : real(0.0f);
  return path;
}

AirPoint airPoint(Air air, AirPath path, real t) {
  AirPoint point;
  point.distance = t;
  point.altitude = altitudeAlongRay(path.altitude, path.viewMu, air.planetRadius, t);
  real radius = air.planetRadius + point.altitude;
  real fromLowest = t - path.lowest;
  if (AIR_ENABLED) {
    point.air = layerPoint(point.altitude, real(0.0f), air.airScaleHeight, radius, fromLowest);
  }
  if (FOG_ENABLED) {
    point.fog = layerPoint(point.altitude, air.fogBaseAltitude, air.fogScaleHeight, radius,
                           fromLowest);
  }
  return point;
}

// Columns of air (x) and fog (y) from a point of a ray to the light, per unit extinction. m.
vec2 lightColumns(Air air, AirPoint point, real lightMu) {
  vec2 columns = vec2(real(0.0f));
  real radius = air.planetRadius + point.altitude;
  if (AIR_ENABLED) {
    columns.x = layerColumn(point.air.exponent, point.air.density, air.airScaleHeight, radius,
                            lightMu);
  }
  if (FOG_ENABLED) {
    columns.y = layerColumn(point.fog.exponent, point.fog.density, air.fogScaleHeight, radius,
                            lightMu);
  }
  return columns;
}

// Optical depth of columns, RGB.
vec3 depthOfColumns(Air air, vec2 columns) {
  return air.airScattering * columns.x + vec3(air.fogExtinction * columns.y);
}

// Optical depth from `altitude` to the light, RGB. Below the horizon it grows smoothly up to
// opaque; lightVisibility says whether the planet is in the way.
vec3 lightOpticalDepth(Air air, real altitude, real lightMu) {
  AirPoint point;
  point.altitude = altitude;
  if (AIR_ENABLED) {
    point.air.exponent = layerExponent(altitude, real(0.0f), air.airScaleHeight);
    point.air.density = layerDensity(point.air.exponent);
  }
  if (FOG_ENABLED) {
    point.fog.exponent = layerExponent(altitude, air.fogBaseAltitude, air.fogScaleHeight);
    point.fog.density = layerDensity(point.fog.exponent);
  }
  return depthOfColumns(air, lightColumns(air, point, lightMu));
}

// Both layers between two points.
struct AirSpan {
  LayerSpan air;
  LayerSpan fog;
};

AirSpan airSpan(Air air, AirPath path, AirPoint a, AirPoint b) {
  real length = b.distance - a.distance;
  real radius = air.planetRadius + real(0.5f) * (a.altitude + b.altitude);
  real across = length * path.lowestRadius / radius;
  real sag = across * across / (real(8.0f) * radius);
  AirSpan span;
  span.air.column = real(0.0f);
  span.air.lean = real(0.0f);
  span.fog.column = real(0.0f);
  span.fog.lean = real(0.0f);
  if (AIR_ENABLED) {
    span.air = layerSpan(a.air, b.air, air.airScaleHeight, length, sag);
  }
  if (FOG_ENABLED) {
    span.fog = layerSpan(a.fog, b.fog, air.fogScaleHeight, length, sag);
  }
  return span;
}

// Where the stops of one layer lie on a ray: close together near `focus`, the ray's point in the
// densest part of the layer, and roughly at equal steps of the layer's depth to either side; but in
// an opaque layer where the light comes from, a few optical depths below its surface.
struct Stops {
  real focus;
  real width;
  real slope;
  real left;
  real right;
  real share;
  real leftSkip;
  real rightSkip;
};

// The layer's depth falls along the ray like e^-E, E = slope d + 0.75 d^2, d = distance from the
// focus / sqrt(2 r H): the hazard of erfc(z) is close to z + sqrt(z^2 + 4/pi), and the depth beyond
// to 1 / hazard. Only the error of the radiance depends on the stops, so a crude model does.
const real HAZARD_0 = real(1.2732395);
// Depth from which a layer counts as opaque, for the stops.
const real OPAQUE = real(2.0f);
Stops layerStops(Air air, AirPath path, real focus, real extinction, real base, real scaleHeight) {
  real low = altitudeAlongRay(path.altitude, path.viewMu, air.planetRadius, focus);
  real radius = air.planetRadius + low;
  Stops stops;
  stops.focus = focus;
  stops.width = sqrt(real(2.0f) * radius * scaleHeight);
  real z = abs(focus - path.lowest) / stops.width;
  stops.slope = z + sqrt(z * z + HAZARD_0);
  real left = focus / stops.width;
  real right = (path.reach - focus) / stops.width;
  stops.left = left * (stops.slope + real(0.75f) * left);
  stops.right = right * (stops.slope + real(0.75f) * right);
  real depth = extinction * layerDensity(layerExponent(low, base, scaleHeight)) * stops.width;
  real lightZ = ((air.planetRadius + path.altitude) * path.sunMu + focus * path.viewSun) /
                stops.width;
  lightZ = max(lightZ, real(-8.0f));
  real light = depth / (lightZ + sqrt(lightZ * lightZ + HAZARD_0));
  real view = depth * stops.left / ((real(1.0f) + stops.left) * stops.slope);
  stops.leftSkip = min(log(max((light + view) / OPAQUE, real(1.0f))), stops.left);
  stops.rightSkip = min(log(max(light / OPAQUE, real(1.0f))), stops.right);
  real weightLeft = stops.left / (real(1.0f) + stops.left);
  real weightRight = stops.right / (real(1.0f) + stops.right);
  stops.share = weightLeft / (weightLeft + weightRight + DIRECTION_FLOOR);
  return stops;
}

// Distance of the stop with rank u in (0, 1): E = v Ee / (1 + k (1 - v) Ee) steps evenly when the
// end's Ee is small and much like -ln(1 - v) when it is large. k = 0.7 and OPAQUE = 2 are the best
// of 0.7, 1, 1.4 and 1, 2, 4 over random rays with suns to 88 degrees, with and without fog.
const real STOP_BEND = real(0.7);
real stopDistance(Stops stops, real u) {
  bool before = u < stops.share;
  real v = before ? real(1.0f) - u / stops.share : (u - stops.share) / (real(1.0f) - stops.share);
  real skip = before ? stops.leftSkip : stops.rightSkip;
  real end = (before ? stops.left : stops.right) - skip;
  real e = skip + v * end / (real(1.0f) + STOP_BEND * (real(1.0f) - v) * end);
  real d = real(2.0f) * e / (stops.slope + sqrt(stops.slope * stops.slope + real(3.0f) * e));
  return stops.focus + (before ? -stops.width * d : stops.width * d);
}

// Distances at which the ray crosses the edge of the planet's shadow, behind the planet as seen
// from the light; -1 or out of reach if there is none.
vec2 shadowStops(Air air, AirPath path) {
  real radius = air.planetRadius + path.altitude;
  real behind = radius * path.sunMu;
  real a = max(real(1.0f) - path.viewSun * path.viewSun, DIRECTION_FLOOR);
  real b = radius * path.viewMu - behind * path.viewSun;
  real c = altitudePower(path.altitude, air.planetRadius) - behind * behind;
  real root = sqrt(max(b * b - a * c, real(0.0f)));
  real q = b < real(0.0f) ? root - b : -root - b;
  real t0 = q / a;
  real t1 = abs(q) > real(0.0f) ? c / q : real(0.0f);
  bool hits = b * b > a * c;
  vec2 stops;
  stops.x = hits && behind + t0 * path.viewSun < real(0.0f) ? t0 : real(-1.0f);
  stops.y = hits && behind + t1 * path.viewSun < real(0.0f) ? t1 : real(-1.0f);
  return stops;
}

// The next stop strictly ahead: `stop` if it lies between t and `nearest`, else `nearest`.
real nearerStop(real stop, real t, real nearest) {
  return stop > t && stop < nearest ? stop : nearest;
}

// Optical depth along a ray of `distance` m (may be infinite; the ground is the caller's to clip).
vec3 airOpticalDepth(Air air, AirRay ray, real distance) {
  AirPath path = clipToAir(air, ray, distance);
  AirPoint first = airPoint(air, path, real(0.0f));
  AirPoint middle = airPoint(air, path, clamp(path.lowest, real(0.0f), path.reach));
  AirPoint last = airPoint(air, path, path.reach);
  AirSpan before = airSpan(air, path, first, middle);
  AirSpan after = airSpan(air, path, middle, last);
  return depthOfColumns(air, vec2(before.air.column + after.air.column,
                                  before.fog.column + after.fog.column));
}

// Segments per ray: stops of each layer, the lowest point, two shadow edges and the end.
const int AIR_STOPS = 5;
const int FOG_STOPS = 5;
const int MAX_SEGMENTS = 12;
// A fog layer with less optical depth than this around the ray gets no stops.
const real FOG_MATTERS = real(1e-4);

// Light scattered once towards the ray's origin, and the ray's optical depth. `distance` may be
// infinite; the caller ends it at the scene or at groundDistance. The light fades with
// lightVisibility. airPhase and fogPhase (RGB) are the phase functions' values (1/sr) at the angle
// between the light's travel and the way to the eye.
AirResult airAlongRay(Air air, AirRay ray, real distance, real airPhase, vec3 fogPhase,
                      real angularRadius) {
  AirPath path = clipToAir(air, ray, distance);
  real radius = air.planetRadius + path.altitude;
  real focus = clamp(path.lowest, real(0.0f), path.reach);
  vec2 shadow = shadowStops(air, path);
  Stops airStops = layerStops(air, path, focus, air.airScattering.y, real(0.0f),
                              air.airScaleHeight);
  Stops fogStops = layerStops(air, path, focus, air.fogExtinction, air.fogBaseAltitude,
                              air.fogScaleHeight);
  int airRank = AIR_ENABLED ? 1 : AIR_STOPS;
  int fogRank = FOG_STOPS;
  if (FOG_ENABLED) {
    real low = altitudeAlongRay(path.altitude, path.viewMu, air.planetRadius, focus);
    real dense = layerDensity(layerExponent(low, air.fogBaseAltitude, air.fogScaleHeight));
    fogRank = air.fogExtinction * dense * fogStops.width > FOG_MATTERS ? 1 : FOG_STOPS;
  }
  AirPoint here = airPoint(air, path, real(0.0f));
  vec2 hereColumns = lightColumns(air, here, path.sunMu);
  SegmentEnd hereEnd;
  hereEnd.depth = depthOfColumns(air, hereColumns);
  hereEnd.transmittance = safeExp3(-hereEnd.depth);
  vec2 viewColumns = vec2(real(0.0f));
  AirResult result;
  result.radiance = vec3(real(0.0f));
  // A counted loop with a break: lavapipe 22.3 computes a do-while of this length wrongly for lanes
  // that finish before their neighbours (tests/parity, AirAlongRay).
  for (int segment = 0; segment < MAX_SEGMENTS; ++segment) {
    real airStop = airRank < AIR_STOPS
                       ? stopDistance(airStops, real(airRank) / real(AIR_STOPS)) : path.reach;
    real fogStop = fogRank < FOG_STOPS
                       ? stopDistance(fogStops, real(fogRank) / real(FOG_STOPS)) : path.reach;
    real t = clamp(min(airStop, fogStop), here.distance, path.reach);
    t = nearerStop(path.lowest, here.distance, t);
    t = nearerStop(shadow.x, here.distance, t);
    t = nearerStop(shadow.y, here.distance, t);
    t = segment + 1 < MAX_SEGMENTS ? t : path.reach;
    airRank = airStop <= t ? airRank + 1 : airRank;
    fogRank = fogStop <= t ? fogRank + 1 : fogRank;

    AirPoint next = airPoint(air, path, t);
    AirSpan span = airSpan(air, path, here, next);
    viewColumns = viewColumns + vec2(span.air.column, span.fog.column);
    real nextRadius = air.planetRadius + next.altitude;
    real nextMu = (radius * path.sunMu + t * path.viewSun) / nextRadius;
    nextMu = clamp(nextMu, real(-1.0f), real(1.0f));
    vec2 nextColumns = lightColumns(air, next, nextMu) + viewColumns;
    SegmentEnd nextEnd;
    nextEnd.depth = depthOfColumns(air, nextColumns);
    nextEnd.transmittance = safeExp3(-nextEnd.depth);

    vec3 airPart = air.airScattering * (span.air.column * airPhase);
    vec3 fogPart = air.fogAlbedo * fogPhase * (air.fogExtinction * span.fog.column);
    vec3 light;
    if (AIR_ENABLED && FOG_ENABLED) {
      vec2 rise = nextColumns - hereColumns;
      real fogOwn = air.fogExtinction * rise.y;
      real airShare = real(2.0f) * (span.fog.lean - span.air.lean);
      real fogShare = displacement(here.fog, next.fog, fogOwn, span.air.lean);
      light = airPart * displacedMean(hereEnd, nextEnd, vec3(fogOwn), airShare) +
              fogPart * displacedMean(hereEnd, nextEnd, air.airScattering * rise.x, fogShare);
    } else {
      light = (airPart + fogPart) * meanTransmittance3(hereEnd.transmittance, nextEnd.transmittance,
                                                       nextEnd.depth - hereEnd.depth);
    }

    // The planet's shadow at the middle: its edges are stops.
    real between = real(0.5f) * (here.distance + t);
    real middle = altitudeAlongRay(path.altitude, path.viewMu, air.planetRadius, between);
    real middleMu = (radius * path.sunMu + between * path.viewSun) / (air.planetRadius + middle);
    real lit = lightVisibility(air, middle, clamp(middleMu, real(-1.0f), real(1.0f)),
                               angularRadius);
    result.radiance = result.radiance + light * lit;

    here = next;
    hereColumns = nextColumns;
    hereEnd = nextEnd;
    if (!(here.distance < path.reach)) {
      break;
    }
  }
  result.opticalDepth = depthOfColumns(air, viewColumns);
  return result;
}

// The same with one fog phase function for all colours.
AirResult airAlongRay(Air air, AirRay ray, real distance, real airPhase, real fogPhase,
                      real angularRadius) {
  return airAlongRay(air, ray, distance, airPhase, vec3(fogPhase), angularRadius);
}
