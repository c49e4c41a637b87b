// SPDX-License-Identifier: MIT
// Once-scattered light and optical depth of air and one fog layer on a spherical planet, RGB, per
// unit irradiance of the light (1/sr). Follows [R04] 4.1; rewritten: the two-ended segments of
// segment.glsl are fed with spherical light depths, so few segments replace the flat closed form.
// Errors against quadrature (tests/unit/sky_test.cpp,
// sky_heights_test.cpp) of the worst channel above 1e-5, p95 and worst of random rays at any height
// from 0 to 36 000 km, clear and hazy: to 50 km 0.3 and 0.6 %, sky with suns to 80 degrees 0.5 and
// 1 %, at 88 degrees 0.5 and 1 %, at 92 degrees 1 and 2 %. Float follows double to 1e-4.

struct AirResult {
  vec3 radiance;
  vec3 opticalDepth;
  vec3 columns;  // of air, fog and absorber, per unit extinction, m
};

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
  // What is left of `left` and `right`.
  real leftEnd;
  real rightEnd;
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
// Less than that share of a side has no stops of its own: they would lie closer than a float tells
// apart, and the ray would not get on. Where skip is all of a side, a device that fuses the side's
// product into this difference finds such a rest, too.
const real LEAST_END = real(1e-3);
real stopsEnd(real side, real skip) {
  real end = side - skip;
  return end > LEAST_END * side ? end : real(0.0f);
}

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
  stops.leftEnd = stopsEnd(stops.left, stops.leftSkip);
  stops.rightEnd = stopsEnd(stops.right, stops.rightSkip);
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
  real end = before ? stops.leftEnd : stops.rightEnd;
  real e = skip + v * end / (real(1.0f) + STOP_BEND * (real(1.0f) - v) * end);
  real d = real(2.0f) * e / (stops.slope + sqrt(stops.slope * stops.slope + real(3.0f) * e));
  return stops.focus + (before ? -stops.width * d : stops.width * d);
}

// Distance of the first stop ahead of t, its rank by the inverse of stopDistance; `reach` if none.
real nextStop(Stops stops, real t, real reach) {
  bool before = t < stops.focus;
  real d = abs(t - stops.focus) / stops.width;
  real skip = before ? stops.leftSkip : stops.rightSkip;
  real end = before ? stops.leftEnd : stops.rightEnd;
  real e = max(d * (stops.slope + real(0.75f) * d) - skip, real(0.0f));
  real v = e * (real(1.0f) + STOP_BEND * end) /
           max(end * (real(1.0f) + STOP_BEND * e), DIRECTION_FLOOR);
  v = end > real(0.0f) ? min(v, real(1.0f)) : (before ? real(0.0f) : real(1.0f));
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
  real c = altitudePower(path.altitude, air.planetRadius) - lean * lean -
           behind * (widen * behind + real(2.0f) * lean);
  real root = sqrt(max(b * b - a * c, real(0.0f)));
  real q = b < real(0.0f) ? root - b : -root - b;
  real t0 = q / a;
  real t1 = abs(q) > real(0.0f) ? c / q : real(0.0f);
  vec2 edges = b * b > a * c ? vec2(min(t0, t1), max(t0, t1)) : vec2(real(-1.0f));
  // On the sunny side the cone is none of a shadow.
  edges.x = behind + edges.x * path.viewSun < -lean ? edges.x : real(-1.0f);
  edges.y = behind + edges.y * path.viewSun < -lean ? edges.y : real(-1.0f);
  return edges;
}

// Distance of the next stop where the light comes past the planet, at most `reach`: altitude and
// the light's distance from the surface change by GRAZING_STEP scale heights, and by a quarter of
// the latter more. Where the light is above the horizontal the steps grow and end. Smooth in the
// sun, so that the frames of a twilight follow each other.
const real GRAZING_STEP = real(1.5);
const real GRAZING_GROWTH = real(0.25f);
const real GRAZING_FOG = real(2.0f);  // the air's scale height is at most that many of the fog's
const real GRAZING_END = real(0.5f);  // widths of the air towards the light, at 1.5 degrees
real grazingStop(Air air, AirPath path, AirPoint here, real scaleHeight, real width,
                 real reach) {
  real radius = air.planetRadius + path.altitude;
  real towards = radius * path.sunMu + here.distance * path.viewSun;
  real left = real(1.0f) - towards / (GRAZING_END * width);
  if (left < real(0.01)) {
    return reach;
  }
  real r = air.planetRadius + here.altitude;
  real up = radius * path.viewMu + here.distance;
  real across = sqrt(max((r - towards) * (r + towards), real(1.0f)));
  real height = max(across - air.planetRadius, real(0.0f));
  real rate = max(abs(up) / r, abs(up - towards * path.viewSun) / across);
  real size = GRAZING_STEP * (scaleHeight + GRAZING_GROWTH * height) /
              min(left, real(1.0f));
  // The rate itself changes by 1 within the radius.
  return min(here.distance + real(2.0f) * size /
             (rate + sqrt(rate * rate + real(2.0f) * size / r)), reach);
}

// The next stop strictly ahead: `stop` if it lies between t and `nearest`, else `nearest`.
real nearerStop(real stop, real t, real nearest) {
  return stop > t && stop < nearest ? stop : nearest;
}

// Change per metre along the ray of the columns to the light and to the eye together: moving
// towards the light shortens its column, moving across turns it around the planet.
vec2 columnRates(Air air, AirPath path, AirPoint point, real lightMu, vec3 lightColumn) {
  real radius = air.planetRadius + point.altitude;
  real viewMu = ((air.planetRadius + path.altitude) * path.viewMu + point.distance) / radius;
  real across = viewMu - lightMu * path.viewSun;
  // A light below the horizontal comes past the planet, where the way across is level.
  if (lightMu < real(0.0f)) {
    across = across / sqrt(max((real(1.0f) - lightMu) * (real(1.0f) + lightMu), real(0.01)));
  }
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

// Share of a span before which half of its column lies, where the density is exponential.
real halfColumn(LayerPoint a, LayerPoint b) {
  real growth = clamp(b.exponent - a.exponent, LAYER_VACUUM, -LAYER_VACUUM);
  return abs(growth) < real(0.01)
             ? real(0.5f) + real(0.125f) * growth
             : log(real(0.5f) + real(0.5f) * exp(growth)) / growth;
}

// Depth by which a gas that the span does not follow changes its mean transmittance: a parabola of
// what scatters through the gas's columns to eye and light at the ends, whose mean is given, and
// where half of the scattering lies. Cuts the p95 of ozone's errors from 2-9 % to 0.4 %
// (tests/unit/absorber_test.cpp).
vec3 absorberBend(Air air, AirPath path, AirPoint here, AirPoint next, real viewColumn, real mean,
                  vec3 rise) {
  real share = real(0.5f);
  if (AIR_ENABLED) {
    share = halfColumn(here.air, next.air);
  } else if (FOG_ENABLED) {
    share = halfColumn(here.fog, next.fog);
  }
  real t = here.distance + share * (next.distance - here.distance);
  real altitude = altitudeAlongRay(path.altitude, path.viewMu, air.planetRadius, t);
  real lightMu = ((air.planetRadius + path.altitude) * path.sunMu + t * path.viewSun) /
                 (air.planetRadius + altitude);
  real seen = absorberColumn(path.absorber, t - path.lowest, air.planetRadius, air.absorberPeak,
                             air.absorberWidth) - here.absorber;
  real light = absorberColumnTo(altitude, clamp(lightMu, real(-1.0f), real(1.0f)),
                                air.planetRadius, air.absorberPeak, air.absorberWidth);
  vec3 slope = air.absorption * (real(4.0f) * (viewColumn + seen + light - mean));
  return bentDepth3(slope, -slope, rise);
}

// Where a segment may be wrong by more than REFINE it is tried again, shorter: its error is taken
// as the light times the squares of the depth's bend and of the displacement, against the radiance
// so far or a quarter of what any trial gave, and REFINE_FLOOR. Trials per ray: air alone, sky by
// day 3, to 50 km 1.2; air and haze 5 and 2.4; several times as many in twilight. From
// REFINED_SEGMENTS on all are kept, so that the remaining stops fit: 3 of each layer, the lowest
// point, two edges of the shadow, two of the penumbra and the end.
const int MAX_SEGMENTS = 48;
const int REFINED_SEGMENTS = 36;
const int MAX_CUTS = 3;
// The gas's parabola errs by more than its square where the gas ends within a segment.
const real GAS_DOUBT = real(4.0f);
const real REFINE = real(1.5e-3);
const real REFINE_FLOOR = real(1e-9);
const real REFINE_KEPT = real(0.25f);
const real REFINE_CAP = real(8.0f);  // of displacements, so that their squares are finite
// Error of the seen part of the light by its change over the segment and by its bend.
const real PENUMBRA_CHANGE = real(4e-3);
const real PENUMBRA_BEND = real(2e-2);
// A fog layer with less optical depth than this around the ray gets no stops.
const real FOG_MATTERS = real(1e-4);

// Fog thinner than that share of the air's scale height has no finer steps, and no step of light
// that grazes is shorter than that of the ray: thin layers must not use all segments up.
const real THINNEST_GRAZING = real(0.07);
const real SHORTEST_GRAZING = real(0.01);
// What is left of a ray is one segment where it can bring no more than this of the radiance.
const real DIM_REST = real(1e-3);

// Roughly the light of a ray that leaves the planet's shadow at `edge`, from one scale height above
// it: what segments in the penumbra may be measured by, which have next to none.
vec3 lightBeyond(Air air, AirPath path, AirPoint here, real edge, real airPhase, vec3 fogPhase) {
  real radius = air.planetRadius + path.altitude;
  real low = altitudeAlongRay(path.altitude, path.viewMu, air.planetRadius, edge);
  low = low + air.planetRadius;
  real rise = max((radius * path.viewMu + edge) / low, real(0.0f));
  real way = air.airScaleHeight / (rise + sqrt(air.airScaleHeight / low));
  real t = min(edge + way, path.reach);
  AirPoint point = airPoint(air, path, t);
  real lightMu = (radius * path.sunMu + t * path.viewSun) / (air.planetRadius + point.altitude);
  AirSpan span = airSpan(air, path, here, point);
  vec3 columns = lightColumns(air, point, clamp(lightMu, real(-1.0f), real(1.0f)));
  vec3 source = vec3(real(0.0f));
  if (AIR_ENABLED) {
    source = air.airScattering * (point.air.density * airPhase);
  }
  if (FOG_ENABLED) {
    source = source + air.fogAlbedo * fogPhase * (air.fogExtinction * point.fog.density);
  }
  return source * safeExp3(-depthOfColumns(air, columns + columnsOf(span))) * way;
}

// A ray of that optical depth scatters no more than this once: its opacity times the largest phase
// function. The sum may be more where layers are opaque that no segment follows.
vec3 mostLight(Air air, vec3 opticalDepth, real airPhase, vec3 fogPhase) {
  vec3 phase = vec3(AIR_ENABLED ? airPhase : real(0.0f));
  if (FOG_ENABLED) {
    phase = max(phase, air.fogAlbedo * fogPhase);
  }
  return phase * vec3(oneMinusExp(opticalDepth.x), oneMinusExp(opticalDepth.y),
                      oneMinusExp(opticalDepth.z));
}

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
  vec2 penumbra = shadowStops(air, path, -angularRadius);
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
  real fogStep = max(GRAZING_FOG * air.fogScaleHeight, THINNEST_GRAZING * air.airScaleHeight);
  real grazing = fogMatters ? min(air.airScaleHeight, fogStep) : air.airScaleHeight;
  AirPoint here = airPoint(air, path, real(0.0f));
  vec3 hereColumns = lightColumns(air, here, path.sunMu);
  vec2 hereRates = columnRates(air, path, here, path.sunMu, hereColumns);
  SegmentEnd hereEnd;
  hereEnd.depth = depthOfColumns(air, hereColumns);
  hereEnd.transmittance = safeExp3(-hereEnd.depth);
  // Where the light stands higher than its radius, the planet hides nothing of it.
  real hereMu = path.sunMu;
  real hereLit = real(1.0f);
  if (hereMu < angularRadius) {
    hereLit = lightVisibility(air, path.altitude, hereMu, angularRadius);
  }
  vec3 viewColumns = vec3(real(0.0f));
  // Trials may not go beyond.
  real limit = path.reach;
  int cuts = 0;
  vec3 kept = vec3(real(0.0f));
  if (shadow.y > real(0.0f) && shadow.y < path.reach) {
    kept = lightBeyond(air, path, here, shadow.y, airPhase, fogPhase) * REFINE_KEPT;
  }
  AirResult result;
  result.radiance = vec3(real(0.0f));
  // A counted loop with a break: lavapipe 22.3 computes a do-while of this length wrongly for lanes
  // that finish before their neighbours (tests/parity, AirAlongRay).
  for (int segment = 0; segment < MAX_SEGMENTS; ++segment) {
    real airStop = AIR_ENABLED ? nextStop(airStops, here.distance, path.reach) : path.reach;
    real fogStop = fogMatters ? nextStop(fogStops, here.distance, path.reach) : path.reach;
    real t = nearerStop(airStop, here.distance, path.reach);
    t = nearerStop(fogStop, here.distance, t);
    t = nearerStop(penumbra.x, here.distance, nearerStop(penumbra.y, here.distance, t));
    bool isBehind = radius * path.sunMu + here.distance * path.viewSun < real(0.0f);
    bool dark = isBehind && shadow.x <= here.distance && here.distance < shadow.y;
    // No stops in the dark.
    t = dark ? path.reach : t;
    real shortest = min(t, here.distance + path.reach * SHORTEST_GRAZING);
    t = dark ? t : max(grazingStop(air, path, here, grazing, airStops.width, t), shortest);
    vec3 rest = vec3(real(0.0f));
    if (AIR_ENABLED) {
      rest = air.airScattering * (here.air.column * airPhase);
    }
    if (FOG_ENABLED) {
      rest = rest + air.fogAlbedo * fogPhase * (air.fogExtinction * here.fog.column);
    }
    rest = rest - result.radiance * DIM_REST;
    bool dim = here.distance >= path.lowest && max(max(rest.x, rest.y), rest.z) < real(0.0f);
    t = dim ? path.reach : t;
    t = nearerStop(path.lowest, here.distance, t);
    t = nearerStop(shadow.x, here.distance, t);
    t = nearerStop(shadow.y, here.distance, t);
    t = segment + 1 < MAX_SEGMENTS && !dim ? min(t, limit) : path.reach;
    real length = t - here.distance;

    AirPoint next = airPoint(air, path, t);
    AirSpan span = airSpan(air, path, here, next);
    vec3 seenColumns = viewColumns + columnsOf(span);
    real nextRadius = air.planetRadius + next.altitude;
    real nextMu = (radius * path.sunMu + t * path.viewSun) / nextRadius;
    nextMu = clamp(nextMu, real(-1.0f), real(1.0f));
    vec3 nextColumns = lightColumns(air, next, nextMu);
    vec2 nextRates = columnRates(air, path, next, nextMu, nextColumns);
    nextColumns = nextColumns + seenColumns;
    SegmentEnd nextEnd;
    nextEnd.depth = depthOfColumns(air, nextColumns);
    nextEnd.transmittance = safeExp3(-nextEnd.depth);
    vec3 change = nextColumns - hereColumns;
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
    vec3 gas = vec3(real(0.0f));
    if (ABSORBER_ENABLED) {
      gas = absorberBend(air, path, here, next, viewColumns.z,
                         real(0.5f) * (hereColumns.z + nextColumns.z), rise);
      bend = bend + gas;
      fogBend = fogBend + gas;
    }
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

    doubt = doubt + light * gas * gas * GAS_DOUBT;

    // The planet's shadow; the edges of its penumbra are stops.
    real nextLit = real(1.0f);
    if (min(hereMu, nextMu) < angularRadius) {
      nextLit = lightVisibility(air, next.altitude, nextMu, angularRadius);
      real between = here.distance + real(0.5f) * length;
      real middle = altitudeAlongRay(path.altitude, path.viewMu, air.planetRadius, between);
      real middleMu = (radius * path.sunMu + between * path.viewSun) / (air.planetRadius + middle);
      real lit = lightVisibility(air, middle, clamp(middleMu, real(-1.0f), real(1.0f)),
                                 angularRadius);
      vec3 growth = vec3(AIR_ENABLED ? next.air.exponent - here.air.exponent
                                     : next.fog.exponent - here.fog.exponent) - rise;
      vec3 seen = meanVisibility(hereLit, lit, nextLit, growth);
      real change = abs(nextLit - hereLit);
      real bow = abs(lit - real(0.5f) * (hereLit + nextLit));
      doubt = doubt * seen + light * (PENUMBRA_CHANGE * change + PENUMBRA_BEND * bow);
      light = light * seen;
    }
    vec3 sum = result.radiance + light;
    kept = max(kept, sum * REFINE_KEPT + vec3(REFINE_FLOOR));
    vec3 errors = doubt / max(sum, kept);
    real error = max(max(errors.x, errors.y), errors.z);

    bool refines = segment < REFINED_SEGMENTS;
    bool accepted = dim || !refines || !(error > REFINE) || cuts >= MAX_CUTS;
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
      hereMu = nextMu;
      hereLit = nextLit;
    }
    if (!(here.distance < path.reach)) {
      break;
    }
  }
  result.opticalDepth = depthOfColumns(air, viewColumns);
  result.radiance = min(result.radiance, mostLight(air, result.opticalDepth, airPhase, fogPhase));
  result.columns = viewColumns;
  return result;
}

// The same with one fog phase function for all colours.
AirResult airAlongRay(Air air, AirRay ray, real distance, real airPhase, real fogPhase,
                      real angularRadius) {
  return airAlongRay(air, ray, distance, airPhase, vec3(fogPhase), angularRadius);
}
