// SPDX-License-Identifier: MIT
// What the parity test evaluates, as text that GLSL and C++ share like the models themselves: row
// of inputs in, up to eight numbers out. One case per group of model functions.

struct ParityRow {
  vec4 a;
  vec4 b;
  vec4 c;
  vec4 d;
  vec4 e;
};

struct ParityResult {
  vec4 first;
  vec4 second;
};

#include "case_list.glsl"

vec3 head(vec4 v) {
  return vec3(v.x, v.y, v.z);
}

Air parityAir(ParityRow r) {
  Air air;
  air.planetRadius = r.a.x;
  air.airScattering = vec3(r.a.y, r.a.z, r.a.w);
  air.airScaleHeight = r.b.x;
  air.fogExtinction = r.b.y;
  air.fogBaseAltitude = r.b.z;
  air.fogScaleHeight = r.b.w;
  air.fogAlbedo = head(r.c);
  air.absorption = vec3(r.c.w, real(3.0f) * r.c.w, real(0.1f) * r.c.w);
  air.absorberPeak = real(25000.0f);
  air.absorberWidth = real(15000.0f);
  return air;
}

AirRay parityRay(ParityRow r) {
  AirRay ray;
  ray.altitude = r.d.x;
  ray.viewMu = r.d.y;
  ray.sunMu = r.d.z;
  ray.viewSun = r.d.w;
  return ray;
}

ParityResult parityCase(int which, ParityRow r) {
  ParityResult o;
  o.first = vec4(real(0.0f));
  o.second = vec4(real(0.0f));
  if (which == CASE_NUMERIC) {
    o.first.x = oneMinusExp(r.a.x);
    o.first.y = phi1(r.a.x);
    o.first.z = safeExp(r.a.y);
    o.first.w = erfcxPositive(r.a.z);
  }
  if (which == CASE_BOX) {
    Span span = rayBox(head(r.a), head(r.b), head(r.c), head(r.d));
    o.first.x = span.begin;
    o.first.y = span.end;
  }
  if (which == CASE_ALTITUDE) {
    o.first.x = altitudeAlongRay(r.a.x, r.a.y, r.a.z, r.a.w);
    o.first.y = altitudePower(r.a.x, r.a.z);
    o.first.z = horizonMu(r.a.x, r.a.z);
  }
  if (which == CASE_GROUND) {
    o.first.x = groundDistance(r.a.x, r.a.y, r.a.z);
  }
  if (which == CASE_PHASE) {
    o.first.x = rayleighPhase(r.a.x);
    o.first.y = fogPhase(henyeyGreensteinOnly(r.a.y), r.a.x);
    o.first.z = fogPhase(rayleighAsDraine(), r.a.x);
    o.first.w = drainePhase(r.a.z, real(1.0f) - r.a.z, r.a.w, r.a.x);
    o.second.x = henyeyGreenstein(r.a.y, real(1.0f) - r.a.y, r.a.x);
  }
  if (which == CASE_FOG_PARAMETERS) {
    FogPhase p = fogPhaseFromDiameter(r.a.x);
    o.first = vec4(p.gHg, p.gapHg, p.gD, p.gapD);
    o.second.x = p.alpha;
    o.second.y = p.weightD;
  }
  if (which == CASE_FOG_PHASE) {
    FogPhase p;
    p.gHg = r.c.x;
    p.gapHg = r.c.y;
    p.gD = r.c.z;
    p.gapD = r.c.w;
    p.alpha = r.d.x;
    p.weightD = r.d.y;
    o.first.x = oneMinusCosine(head(r.a), head(r.b));
    o.first.y = fogPhase(p, o.first.x);
  }
  if (which == CASE_SAMPLE) {
    o.first.x = sampleHenyeyGreenstein(r.a.x, r.a.y, r.a.z);
  }
  if (which == CASE_CURVE) {
    o.first.x = curveNode(r.a.x);
    o.first.y = curveCellValue(r.b.x, r.b.y, r.b.z, r.b.w, r.c.x);
    o.first.z = curveCellInvert(r.b.x, r.b.y, r.b.z, r.b.w, r.c.y);
    o.first.w = curveCellEnergy(r.b.x, r.b.y, r.b.z, r.b.w);
  }
  if (which == CASE_SCATTERING_TABLE) {
    o.first.x = phaseCoordinate(r.a.x);
    o.first.y = depthCoordinate(r.a.y);
    o.first.z = forwardLoss(r.a.z, r.a.w);
  }
  if (which == CASE_CANONICAL) {
    o.first = vec4(canonicalThickness(r.a.x), canonicalDepth(r.a.y, r.a.x), canonicalCosine(r.a.z),
                   canonicalLength(r.a.y, r.a.x, r.a.z));
    vec2 inside = canonicalInside(r.a.x, r.a.y);
    vec4 weights = canonicalCubic(r.a.w);
    o.second = vec4(inside.y, canonicalRadiance(r.b.x, r.b.y, r.b.z, o.first.w), weights.x,
                    weights.y);
  }
  if (which == CASE_CHORD) {
    ChordLight near = chordStretch(emptyChord(), r.a.x, r.a.y, r.a.z);
    ChordLight both = chordStretch(near, r.a.y, r.a.w, r.b.x);
    o.first = vec4(both.transmittance, both.inscatter, chordDepth(r.b.y, r.a.z),
                   chordLogarithm(r.b.y));
    o.second = vec4(shellDepth(r.b.z), shellDensity(r.b.w, r.b.z, real(0.3f)), real(0.0f),
                    real(0.0f));
  }
  if (which == CASE_TANGENT_SLAB) {
    TangentSlab slab = tangentSlab(r.a.w, r.b.w, head(r.a), head(r.b), head(r.c));
    o.first = vec4(slab.thickness, slab.depth, slab.muLight, slab.muView);
    o.second.x = slab.phi;
  }
  if (which == CASE_COLLECTOR) {
    vec2 centre = vec2(r.a.x, r.a.y);
    vec2 found = vec2(r.a.z, r.a.w);
    vec2 next = collectorStep(centre, found, r.b.x);
    o.first = vec4(next.x, next.y, collectorResidual(centre, found, r.b.x),
                   footprintLevel(r.b.x, r.b.y));
    o.second.x = footprintMean(r.b.z, r.b.w);
  }
  if (which == CASE_FOOTPRINT) {
    LightFootprint around;
    around.coverage = r.a.w;
    around.through = r.b.w;
    around.lit = head(r.a);
    around.shaded = head(r.b);
    around.rise = r.e.y;
    SurfaceSlab found = surfaceSlab(int(r.e.x), around, r.c.w, r.e.z, head(r.d), head(r.c));
    o.first = vec4(found.slab.thickness, found.slab.depth, found.slab.muLight, found.inside);
    o.second.x = footprintSpread(int(r.e.x), found.slab);
  }
  if (which == CASE_SOURCE) {
    TangentSlab slab;
    slab.thickness = r.a.x;
    slab.depth = r.a.y;
    slab.muLight = r.a.z;
    slab.muView = r.a.w;
    slab.phi = r.b.x;
    SourcePlace place = sourcePlace(int(r.e.x), slab);
    o.first = vec4(place.node, place.view);
    o.second = vec4(place.azimuth, place.outside, place.up ? real(1.0f) : real(0.0f),
                    sourceRadiance(r.b.y, r.b.z, r.a.z, r.b.w));
  }
  if (which == CASE_SLICES) {
    vec3 axis = halfAngleAxis(head(r.a), head(r.b));
    o.first = vec4(axis, slabOpacity(r.c.x));
  }
  if (which == CASE_COMPOSITE) {
    vec3 over = compositeOver(head(r.a), r.a.w, head(r.b));
    o.first = vec4(over, finiteValue(r.b.w, r.c.x));
  }
  if (which == CASE_SEGMENT) {
    o.first.x = segmentInscatter(r.a.x, r.a.y, r.a.z);
    o.first.y = exponentialDepth(r.b.x, r.b.y, r.b.z);
  }
  if (which == CASE_FLAT_SEGMENT) {
    Segment s = flatExponentialSegment(r.a.x, r.a.y, r.a.z, r.a.w, r.b.x);
    o.first.x = s.opticalDepth;
    o.first.y = s.inscatter;
  }
  if (which == CASE_LIGHT) {
    vec3 depth = lightOpticalDepth(parityAir(r), r.d.x, r.d.z);
    o.first = vec4(depth, lightVisibility(parityAir(r), r.d.x, r.e.y, r.e.z));
  }
  if (which == CASE_AIR_DEPTH) {
    o.first = vec4(airOpticalDepth(parityAir(r), parityRay(r), r.e.x), real(0.0f));
  }
  if (which == CASE_AIR) {
    AirResult result = airAlongRay(parityAir(r), parityRay(r), r.e.x, r.e.y, r.e.z, r.e.w);
    o.first = vec4(result.radiance, real(0.0f));
    o.second = vec4(result.opticalDepth, real(0.0f));
  }
  return o;
}
