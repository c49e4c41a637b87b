// SPDX-License-Identifier: MIT
// Once-scattered light and optical depth of air and one fog layer on a spherical planet, RGB, per
// unit irradiance of the light (1/sr). Follows [R04] 4.1; rewritten: the two-ended segments of
// segment.glsl are fed with spherical light depths, so few segments replace the flat closed form.
// Both species are exponential in altitude. Errors against quadrature: tests/unit/sky_test.cpp.

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

// Exponent of the relative density is kept in this range: e^-60 is vacuum without subnormal
// numbers, e^30 times any extinction is opaque.
const real LAYER_VACUUM = real(-60.0f);
const real LAYER_SOLID = real(30.0f);
const real VACUUM_DENSITY = real(1e-27);
// Scale heights above the base after which a layer counts as ended: e^-30 of 1e6 optical depths.
const real LAYER_EXTENT = real(30.0f);
const real SQRT_PI_HALF = real(0.886226925452758);
// Rays may go this far below the lower of sea level and origin before they are stopped, in m.
const real UNDERGROUND = real(1000.0f);

// Lower-order parts of a ray inside the layers.
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

// One exponential layer at one point of a ray.
struct LayerPoint {
  real exponent;
  real density;
  // Depth per unit extinction from here along the ray to infinity, away from the lowest point. m.
  real column;
};

// A point of a ray.
struct AirPoint {
  real distance;
  real altitude;
  LayerPoint air;
  LayerPoint fog;
};

real layerExponent(real altitude, real base, real scaleHeight) {
  return (base - altitude) / scaleHeight;
}

real layerDensity(real exponent) {
  return exp(clamp(exponent, LAYER_VACUUM, LAYER_SOLID));
}

// Depth per unit extinction (m) from radius r towards a direction with cosine mu to the up: density
// H sqrt(pi X/2) erfcx(sqrt(X/2) |mu|), X = r/H; for mu < 0 twice the lowest point's horizontal
// value less the opposite direction. Within 0.2 % of the sphere's integral for X > 400.
real layerColumn(real exponent, real density, real scaleHeight, real radius, real mu) {
  real width = sqrt(real(2.0f) * radius * scaleHeight);
  real up = density * erfcxPositive(radius * abs(mu) / width);
  real sinus = sqrt(max((real(1.0f) - mu) * (real(1.0f) + mu), real(0.0f)));
  real drop = radius * mu * mu / (scaleHeight * (real(1.0f) + sinus));
  real down = real(2.0f) * sqrt(sinus) * layerDensity(exponent + drop) - up;
  // At the nadir the chord is no exponential column; keep it monotone and never negative.
  return SQRT_PI_HALF * width * (mu < real(0.0f) ? max(down, up) : up);
}

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

LayerPoint layerPoint(real altitude, real base, real scaleHeight, real radius, real fromLowest) {
  LayerPoint point;
  point.exponent = min(layerExponent(altitude, base, scaleHeight), LAYER_SOLID);
  point.density = layerDensity(point.exponent);
  real width = sqrt(real(2.0f) * radius * scaleHeight);
  point.column = SQRT_PI_HALF * width * point.density * erfcxPositive(abs(fromLowest) / width);
  return point;
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

// A layer between two points of a ray.
struct LayerSpan {
  // Depth per unit extinction. m.
  real column;
  // How far the layer's centre lies before the middle, as a share of the span: -0.5..0.5.
  real lean;
};

// Two points on the same side of the ray's lowest one, at most `sag` m above the ray's chord.
// Nearly straight: logarithmic mean of the densities, all from c = (b/2) coth(b/2), b the
// difference of exponents, times the curvature's series in g sag/H, g = 8 (c - 1) / b^2 the first
// moment (error <= 5e-4 at the switch). Else: difference of columns.
const real CURVATURE_2 = real(0.6);
const real CURVATURE_3 = real(0.857);
LayerSpan layerSpan(LayerPoint a, LayerPoint b, real scaleHeight, real length, real sag) {
  real rise = a.exponent - b.exponent;
  real size = abs(rise);
  real z = rise * rise;
  real sum = a.density + b.density;
  real fall = max(abs(a.density - b.density), VACUUM_DENSITY);
  real slope = size < real(0.5f) ? cothSeries(z)
                                 : (real(0.5f) * size * sum / fall - real(1.0f)) / z;
  real g = min(real(8.0f) * slope, real(1.0f));
  real s = sag / scaleHeight;
  real p = g * s;
  real p2 = (real(1.0f) - CURVATURE_2 * g) * p;
  real p3 = (real(1.0f) - CURVATURE_3 * g) * p;
  real curvature = real(1.0f) + p * (real(1.0f) + p2 * (real(1.0f) + p3));
  real straight = length * real(0.5f) * sum / (real(1.0f) + z * slope) * curvature;
  LayerSpan span;
  span.column = s < real(0.25f) ? straight : abs(a.column - b.column);
  span.lean = clamp(rise * slope, real(-0.5f), real(0.5f));
  return span;
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
// from the light; out of [0, length] or beyond if there is none.
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

// Logarithmic mean of e0 = e^-t0 and e1 = e^-t1, with rise = t1 - t0: segmentInscatter per unit
// depth, with exponentials that neighbouring segments share.
real meanTransmittance(real e0, real e1, real rise) {
  return abs(rise) < real(0.5f) ? e0 * phi1Small(rise) : (e0 - e1) / rise;
}

vec3 meanTransmittance3(vec3 e0, vec3 e1, vec3 rise) {
  vec3 mean;
  mean.x = meanTransmittance(e0.x, e1.x, rise.x);
  mean.y = meanTransmittance(e0.y, e1.y, rise.y);
  mean.z = meanTransmittance(e0.z, e1.z, rise.z);
  return mean;
}

vec3 safeExp3(vec3 x) {
  return vec3(safeExp(x.x), safeExp(x.y), safeExp(x.z));
}

// One end of a segment: light depth + view depth in front of it, and its exponential.
struct SegmentEnd {
  vec3 depth;
  vec3 transmittance;
};

// Mean transmittance for a layer whose centre lies `late` (share of the segment, -1..1) behind the
// other layer's, which adds `other` to the depth over the segment. Of it the share |2 late| is
// passed before (late > 0) or after (late < 0) all of the layer, the rest evenly along it.
vec3 displacedMean(SegmentEnd a, SegmentEnd b, vec3 other, real late) {
  real share = clamp(real(2.0f) * late, real(-1.0f), real(1.0f));
  vec3 moved = (share > real(0.0f) ? a.depth : b.depth) + other * share;
  vec3 e = safeExp3(-moved);
  vec3 e0 = share > real(0.0f) ? e : a.transmittance;
  vec3 e1 = share > real(0.0f) ? b.transmittance : e;
  return meanTransmittance3(e0, e1, b.depth - a.depth - other * abs(share));
}

// Where along a segment (-0.5..0.5 from its middle) the light of a layer comes from whose depth
// changes by `own` over the segment: at the depth share y with mean weight e^(-own x), close to
// 1/2 - L(own/2)/2, L(x) = x / (2 + sqrt(1 + x^2)) near Langevin's function; y taken back to the
// distance through the exponential profile, by its second-order term where that is nearly flat.
real layerCentre(LayerPoint a, LayerPoint b, real own) {
  real x = real(0.5f) * own;
  real y = real(0.5f) - real(0.5f) * x / (real(2.0f) + sqrt(real(1.0f) + x * x));
  real growth = max(b.exponent, LAYER_VACUUM) - max(a.exponent, LAYER_VACUUM);
  real density = a.density + (b.density - a.density) * y;
  real steep = (log(density) - max(a.exponent, LAYER_VACUUM)) / growth;
  real flat_ = y + real(0.5f) * growth * y * (real(1.0f) - y);
  return (abs(growth) < real(0.5f) ? flat_ : steep) - real(0.5f);
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
// lightVisibility. airPhase and fogPhase are the phase functions' values (1/sr) at the angle
// between the light's travel and the way to the eye.
AirResult airAlongRay(Air air, AirRay ray, real distance, real airPhase, real fogPhase,
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
  int segment = 0;
  do {
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
    vec3 fogPart = air.fogAlbedo * (air.fogExtinction * span.fog.column * fogPhase);
    vec3 light;
    if (AIR_ENABLED && FOG_ENABLED) {
      vec2 rise = nextColumns - hereColumns;
      real late = span.fog.lean - span.air.lean;
      real fogLate = layerCentre(here.fog, next.fog, air.fogExtinction * rise.y) + span.air.lean;
      light = airPart * displacedMean(hereEnd, nextEnd, vec3(air.fogExtinction * rise.y), late) +
              fogPart * displacedMean(hereEnd, nextEnd, air.airScattering * rise.x, fogLate);
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
    segment += 1;
  } while (here.distance < path.reach && segment < MAX_SEGMENTS);
  result.opticalDepth = depthOfColumns(air, viewColumns);
  return result;
}
