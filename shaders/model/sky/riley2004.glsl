// SPDX-License-Identifier: MIT
// Once-scattered light and optical depth of air and one fog layer on a spherical planet, RGB, per
// unit irradiance of the light (1/sr). Follows [R04] 4.1; rewritten: the two-ended segments of
// segment.glsl are fed with spherical light depths, so few segments replace the flat closed form.
// Both species are exponential in altitude. Errors against quadrature (tests/unit/sky_test.cpp,
// sky_heights_test.cpp) of the worst channel above 1e-5, p95 and worst of random rays at any height
// from 0 to 36 000 km, clear and hazy: to 50 km 0.3 and 0.6 %, sky with suns to 80 degrees 0.5 and
// 1 %, at 88 degrees 0.5 and 1 %, at 92 degrees 1 and 2 %. Float follows double to 1e-4.

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
  vec2 columns;  // of air and fog, per unit extinction, m
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
  real count;
  real leftSkip;
  real rightSkip;
};

// The layer's depth falls along the ray like e^-E, E = slope d + 0.75 d^2, d = distance from the
// focus / sqrt(2 r H): the hazard of erfc(z) is close to z + sqrt(z^2 + 4/pi), and the depth beyond
// to 1 / hazard. Only the error of the radiance depends on the stops, so a crude model does.
const real HAZARD_0 = real(1.2732395);
// Segments for all of a layer on one side of the focus, less for less of it, and most on both.
const real STOPS_PER_SIDE = real(3.0f);
const real MOST_STOPS = real(4.0f);
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
  stops.count = clamp(ceil(STOPS_PER_SIDE * (weightLeft + weightRight)), real(1.0f), MOST_STOPS);
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

// Distance of the first stop ahead of t, its rank by the inverse of stopDistance; `reach` if none.
real nextStop(Stops stops, real t, real reach) {
  bool before = t < stops.focus;
  real d = abs(t - stops.focus) / stops.width;
  real skip = before ? stops.leftSkip : stops.rightSkip;
  real end = (before ? stops.left : stops.right) - skip;
  real e = max(d * (stops.slope + real(0.75f) * d) - skip, real(0.0f));
  real v = e * (real(1.0f) + STOP_BEND * end) /
           max(end * (real(1.0f) + STOP_BEND * e), DIRECTION_FLOOR);
  v = min(v, real(1.0f));
  real u = before ? stops.share * (real(1.0f) - v)
                  : stops.share + (real(1.0f) - stops.share) * v;
  // A stop counts as reached a little early, so that rounding never asks for it twice.
  real rank = floor(u * stops.count + real(0.05)) + real(1.0f);
  return rank < stops.count ? stopDistance(stops, rank / stops.count) : reach;
}

// Distances between which the ray is inside the planet's shadow, if it is behind the planet there:
// inside the cone in which the light stays below the horizon by angularRadius, where nothing of the
// disk is seen; for 0 the cylinder in which its centre is hidden. -1 if there is none.
vec2 shadowStops(Air air, AirPath path, real angularRadius) {
  real radius = air.planetRadius + path.altitude;
  real behind = radius * path.sunMu;
  real widen = real(1.0f) + angularRadius * angularRadius;
  real lean = air.planetRadius * angularRadius;
  real a = max(real(1.0f) - widen * path.viewSun * path.viewSun, DIRECTION_FLOOR);
  real b = radius * path.viewMu - (widen * behind + lean) * path.viewSun;
  real c = altitudePower(path.altitude, air.planetRadius) -
           behind * (widen * behind + real(2.0f) * lean);
  real root = sqrt(max(b * b - a * c, real(0.0f)));
  real q = b < real(0.0f) ? root - b : -root - b;
  real t0 = q / a;
  real t1 = abs(q) > real(0.0f) ? c / q : real(0.0f);
  return b * b > a * c ? vec2(min(t0, t1), max(t0, t1)) : vec2(real(-1.0f));
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

// Change per metre along the ray of the columns to the light and to the eye together: moving
// towards the light shortens its column, moving across turns it around the planet.
vec2 columnRates(Air air, AirPath path, AirPoint point, real lightMu, vec2 lightColumn) {
  real radius = air.planetRadius + point.altitude;
  real viewMu = ((air.planetRadius + path.altitude) * path.viewMu + point.distance) / radius;
  real across = viewMu - lightMu * path.viewSun;
  real along = real(1.0f) - path.viewSun;
  vec2 rates = vec2(real(0.0f));
  if (AIR_ENABLED) {
    rates.x = point.air.density * along - across * lightColumn.x / air.airScaleHeight;
  }
  if (FOG_ENABLED) {
    rates.y = point.fog.density * along - across * lightColumn.y / air.fogScaleHeight;
  }
  return rates;
}

// Where a segment may be wrong by more than REFINE it is tried again, shorter: its error is taken
// as the light times the squares of the depth's bend and of the displacement, against the radiance
// so far or a quarter of what any trial gave, and REFINE_FLOOR. Trials per ray (of them kept): air
// alone, sky by day 3.0 (3.0), suns at 85 to 94 degrees 4.6 (4.2), to 50 km 1.4; air and haze 5.2
// (4.9), 9.9 (8.0) and 2.4. One segment more per side and 2e-3 cost a fifth more by day. From
// REFINED_SEGMENTS on all are kept, so that the remaining stops fit: 3 of each layer, the lowest
// point, two edges of the shadow, two places of half penumbra and the end.
const int MAX_SEGMENTS = 48;
const int REFINED_SEGMENTS = 36;
const int MAX_CUTS = 3;
const real REFINE = real(1.5e-3);
const real REFINE_FLOOR = real(1e-5);
const real REFINE_KEPT = real(0.25f);
const real REFINE_CAP = real(8.0f);  // of displacements, so that their squares are finite
// A stop where the centre is that share of the angular radius above the horizon, 4/5 of the disk.
const real HALF_PENUMBRA = real(-0.5f);
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
  vec2 shadow = shadowStops(air, path, angularRadius);
  vec2 penumbra = shadowStops(air, path, HALF_PENUMBRA * angularRadius);
  Stops airStops = layerStops(air, path, focus, air.airScattering.y, real(0.0f),
                              air.airScaleHeight);
  Stops fogStops = layerStops(air, path, focus, air.fogExtinction, air.fogBaseAltitude,
                              air.fogScaleHeight);
  bool fogMatters = false;
  if (FOG_ENABLED) {
    real low = altitudeAlongRay(path.altitude, path.viewMu, air.planetRadius, focus);
    real dense = layerDensity(layerExponent(low, air.fogBaseAltitude, air.fogScaleHeight));
    fogMatters = air.fogExtinction * dense * fogStops.width > FOG_MATTERS;
  }
  AirPoint here = airPoint(air, path, real(0.0f));
  vec2 hereColumns = lightColumns(air, here, path.sunMu);
  vec2 hereRates = columnRates(air, path, here, path.sunMu, hereColumns);
  SegmentEnd hereEnd;
  hereEnd.depth = depthOfColumns(air, hereColumns);
  hereEnd.transmittance = safeExp3(-hereEnd.depth);
  vec2 viewColumns = vec2(real(0.0f));
  // Trials may not go beyond.
  real limit = path.reach;
  int cuts = 0;
  vec3 kept = vec3(real(0.0f));
  AirResult result;
  result.radiance = vec3(real(0.0f));
  // A counted loop with a break: lavapipe 22.3 computes a do-while of this length wrongly for lanes
  // that finish before their neighbours (tests/parity, AirAlongRay).
  for (int segment = 0; segment < MAX_SEGMENTS; ++segment) {
    real airStop = AIR_ENABLED ? nextStop(airStops, here.distance, path.reach) : path.reach;
    real fogStop = fogMatters ? nextStop(fogStops, here.distance, path.reach) : path.reach;
    real t = clamp(min(airStop, fogStop), here.distance, path.reach);
    t = nearerStop(penumbra.x, here.distance, nearerStop(penumbra.y, here.distance, t));
    bool isBehind = radius * path.sunMu + here.distance * path.viewSun < real(0.0f);
    bool dark = isBehind && shadow.x <= here.distance && here.distance < shadow.y;
    // No stops in the dark.
    t = dark ? path.reach : t;
    t = nearerStop(path.lowest, here.distance, t);
    t = nearerStop(shadow.x, here.distance, t);
    t = nearerStop(shadow.y, here.distance, t);
    t = segment + 1 < MAX_SEGMENTS ? min(t, limit) : path.reach;
    real length = t - here.distance;

    AirPoint next = airPoint(air, path, t);
    AirSpan span = airSpan(air, path, here, next);
    vec2 seenColumns = viewColumns + vec2(span.air.column, span.fog.column);
    real nextRadius = air.planetRadius + next.altitude;
    real nextMu = (radius * path.sunMu + t * path.viewSun) / nextRadius;
    nextMu = clamp(nextMu, real(-1.0f), real(1.0f));
    vec2 nextColumns = lightColumns(air, next, nextMu);
    vec2 nextRates = columnRates(air, path, next, nextMu, nextColumns);
    nextColumns = nextColumns + seenColumns;
    SegmentEnd nextEnd;
    nextEnd.depth = depthOfColumns(air, nextColumns);
    nextEnd.transmittance = safeExp3(-nextEnd.depth);
    vec2 change = nextColumns - hereColumns;
    vec3 rise = nextEnd.depth - hereEnd.depth;

    vec3 bend = vec3(real(0.0f));
    vec3 fogBend = vec3(real(0.0f));
    if (AIR_ENABLED) {
      Bend own = layerBend(here.air, next.air, hereRates.x, nextRates.x, span.air.column, change.x);
      bend = bentDepth3(air.airScattering * own.near, air.airScattering * own.far, rise);
    }
    if (FOG_ENABLED) {
      Bend own = layerBend(here.fog, next.fog, hereRates.y, nextRates.y, span.fog.column, change.y);
      fogBend = bentDepth3(vec3(air.fogExtinction * own.near), vec3(air.fogExtinction * own.far),
                           rise);
    }
    fogBend = fogBend + bend;
    vec3 airPart = air.airScattering * (span.air.column * airPhase);
    vec3 fogPart = air.fogAlbedo * fogPhase * (air.fogExtinction * span.fog.column);
    vec3 light;
    vec3 doubt;
    if (AIR_ENABLED && FOG_ENABLED) {
      real fogRise = air.fogExtinction * change.y;
      vec3 airRise = air.airScattering * change.x;
      real moved = bulge(slopeOf(hereRates.y, here.air.density, RATE_CAP),
                         slopeOf(nextRates.y, next.air.density, RATE_CAP), span.air.column);
      real airShare = abs(moved) < abs(change.y) ? moved / change.y : sign(moved) * sign(change.y);
      // What no share can express: the fog's depth rises and falls again.
      real rest = real(0.5f) * air.fogExtinction * (moved - airShare * change.y);
      bend = bend + vec3(clamp(rest, -BEND_CAP, BEND_CAP));
      real fogShare = displacement(here.fog, next.fog, fogRise, span.air.lean);
      vec3 airLight = airPart * displacedMean(hereEnd, nextEnd, vec3(fogRise), airShare) *
                      bentTransmittance3(bend);
      vec3 fogLight = fogPart * displacedMean(hereEnd, nextEnd, airRise, fogShare) *
                      bentTransmittance3(fogBend);
      light = airLight + fogLight;
      real airMoved = min(abs(fogRise * airShare), REFINE_CAP);
      vec3 fogMoved = min(abs(airRise * fogShare), vec3(REFINE_CAP));
      doubt = airLight * (bend * bend + vec3(airMoved * airMoved)) +
              fogLight * (fogBend * fogBend + fogMoved * fogMoved);
    } else {
      light = (airPart + fogPart) * bentTransmittance3(fogBend) *
              meanTransmittance3(hereEnd.transmittance, nextEnd.transmittance, rise);
      doubt = light * fogBend * fogBend;
    }

    // The planet's shadow at the middle; its edges are stops.
    real between = here.distance + real(0.5f) * length;
    real middle = altitudeAlongRay(path.altitude, path.viewMu, air.planetRadius, between);
    real middleMu = (radius * path.sunMu + between * path.viewSun) / (air.planetRadius + middle);
    real lit = lightVisibility(air, middle, clamp(middleMu, real(-1.0f), real(1.0f)),
                               angularRadius);
    vec3 sum = result.radiance + light * lit;
    kept = max(kept, sum * REFINE_KEPT + vec3(REFINE_FLOOR));
    vec3 errors = doubt * lit / max(sum, kept);
    real error = max(max(errors.x, errors.y), errors.z);

    bool refines = segment < REFINED_SEGMENTS;
    bool accepted = !refines || !(error > REFINE) || cuts >= MAX_CUTS;
    // The error falls with the fifth power of the length.
    real shorter = error > real(30.0f) * REFINE ? real(0.25f) : real(0.5f);
    real longer = error > real(0.03) * REFINE ? real(1.3) : real(2.0f);
    bool wasCut = refines && limit <= t;
    real ahead = wasCut ? t + longer * length : path.reach;
    limit = accepted ? ahead : here.distance + shorter * length;
    cuts = accepted ? 0 : cuts + 1;
    if (accepted) {
      result.radiance = sum;
      viewColumns = seenColumns;
      here = next;
      hereColumns = nextColumns;
      hereRates = nextRates;
      hereEnd = nextEnd;
    }
    if (!(here.distance < path.reach)) {
      break;
    }
  }
  result.opticalDepth = depthOfColumns(air, viewColumns);
  result.columns = viewColumns;
  return result;
}

// The same with one fog phase function for all colours.
AirResult airAlongRay(Air air, AirRay ray, real distance, real airPhase, real fogPhase,
                      real angularRadius) {
  return airAlongRay(air, ray, distance, airPhase, vec3(fogPhase), angularRadius);
}
