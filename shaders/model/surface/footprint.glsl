// SPDX-License-Identifier: MIT
// Which slab stands for a surface cloud, for light of each set of scattering orders, and how much
// of that light stays inside: [B08] 6.1 without its search. Lengths and depths are optical, those
// of the medium without its forward peak (canonical_phase.hpp); directions are unit vectors.
//
// Where the light of a set comes in spreads by nearly the same width in any slab, so the footprint
// is known before the slab is, and no fixed point is sought. The slab is what light maps hold in
// the mean over the footprint: a few scatterings see the face nearby, many see the whole cloud.
// Light that a body of this width loses sideways is taken from how much of the footprint is cloud.
// Errors against Monte Carlo: docs/models.md, tests/unit/surface_rule_test.cpp.

// Sets of orders from 2, 3, 5, 7, 9, 13, 19, 31, as in canonical_table.hpp.
const int SURFACE_SETS = 8;
const int SURFACE_DIFFUSE = 7;

// Of the light map over a footprint: means over all of it, nothing counting as 0.
struct LightFootprint {
  real coverage;  // part that is cloud
  real through;   // depth of the cloud along the light
  vec3 lit;       // normal of the face towards the light, outwards
  vec3 shaded;    // of the last face along the light, outwards
  real rise;      // of the lit face at the point over that of the footprint, towards the light
};

struct SurfaceSlab {
  TangentSlab slab;
  real inside;  // part of the slab's light that a cloud of this width keeps
};

// Root of the mean square distance between entry points and their mean, over both axes: from the
// canonical table, mean over views, light at 45 degrees. The first two sets count 0.7 of theirs, as
// most of their light comes straight and a few far flights make the width.
real collectorWidth(int set) {
  if (set < 4) {
    return set < 2 ? (set < 1 ? real(0.42) : real(0.98)) : (set < 3 ? real(2.5f) : real(3.5f));
  }
  return set < 6 ? (set < 5 ? real(4.8) : real(6.9)) : (set < 7 ? real(9.6) : real(14.0f));
}

// The same for light of any number of scatterings, which spreads as far as the slab is thick.
const real DIFFUSE_WIDTH = real(130.0f);
real diffuseWidth(real thickness, real depth) {
  return sqrt(DIFFUSE_WIDTH + real(12.0f) * thickness +
              depth * max(real(0.75f) * thickness - real(12.0f), real(0.0f)));
}

// Of the slab that widths are taken from: single texels of a bumpy face would draw their light rays
// on the other side of the cloud.
const real LOCAL_SPREAD = real(1.7);

// Spread of a set's footprint on one axis of the light map, seen along the light; `local`: the slab
// at the point itself.
const real SPREAD_THICKEST = real(1e6);
real footprintSpread(int set, TangentSlab local) {
  real thickness = min(local.thickness, SPREAD_THICKEST);
  real width = set < SURFACE_DIFFUSE ? collectorWidth(set)
                                     : diffuseWidth(thickness, min(local.depth, thickness));
  return width * sqrt(real(0.5f) * local.muLight);
}

// Its level in the light map, footprintLevel(footprintSpread), in two terms, as sets have that of
// the light map in common: below 0 what is seen is level 0. `texel`: width at level 0, optical.
real footprintMapLevel(TangentSlab local, real texel) {
  real scale = sqrt(real(0.5f) * local.muLight) * (GAUSSIAN_TEXEL / max(texel, real(1e-20)));
  return LEVELS_PER_E_FOLD * log(max(scale, real(1e-20)));
}
real footprintSetLevel(int set, TangentSlab local) {
  real thickness = min(local.thickness, SPREAD_THICKEST);
  return LEVELS_PER_E_FOLD *
         log(set < SURFACE_DIFFUSE ? collectorWidth(set)
                                   : diffuseWidth(thickness, min(local.depth, thickness)));
}

// Whole levels from that of the first set, rounded down, to a set's, likewise, for sets of known
// width: so few levels serve all of these.
const int SURFACE_RUNGS = 7;
int footprintRung(int set) {
  return set < 3 ? set : (set < 5 ? 3 : 4);
}

// Normal of the slab: of the lit face, turned towards the mean of both faces where the light goes
// through, since a wedge or a ball passes light as the slab across its middle does. Never shorter
// than 0.3 before it is normalised.
const real SHADED_WEIGHT = real(0.7);
vec3 slabNormal(vec3 lit, vec3 shaded, real acrossInWidths) {
  return normalize(lit - shaded * (SHADED_WEIGHT * safeExp(-acrossInWidths)));
}

// Unit vector along v; `other` where there is none.
vec3 directionOr(vec3 v, vec3 other) {
  real square = dot(v, v);
  return square > real(1e-12) ? v * (real(1.0f) / sqrt(max(square, real(1e-12)))) : other;
}

// Part of a set's light that never left the cloud sideways, if the part `coverage` of its entry
// points lies in it. Of a walk whose end lies in a disc with the probability 1 - e^-x a smaller
// part has stayed there all the way, the less the more steps it takes: the power 1 + l / x of that
// probability is the shape of the walk's survival, and light that has gone deep has walked longer.
const real LEAK_FEW = real(0.06);
const real LEAK_MANY = real(0.40);
const real LEAK_DEPTH = real(2.6);
real footprintSurvival(int set, real coverage, real depthShare) {
  real a = clamp(coverage, real(1e-6), real(0.999999));
  real leak = set < 2 ? real(0.0f) : (set < SURFACE_DIFFUSE ? LEAK_FEW : LEAK_MANY);
  real x = max(-log(real(1.0f) - a), real(1e-3));
  real power = real(1.0f) + leak * (real(1.0f) + LEAK_DEPTH * depthShare) / x;
  return coverage > real(0.0f) ? safeExp(power * log(a)) : real(0.0f);
}

// Part of a set's light that stays where the face stands `rise` over its surroundings, across the
// slab: hills lose light at their sides, of which the slab knows nothing, and valleys have theirs
// from such hills, so that a valley as deep keeps as much. Diffuse light falls to 0 HILL_FACE above
// a face; wider collectors see more of the hill. Where the footprint is not all cloud,
// footprintSurvival counts what is lost sideways.
const real HILL_LOSS = real(1.05);
const real HILL_FACE = real(2.86);  // SOURCE_BEHIND
const real HILL_WIDTH = real(0.2);
real hillKept(int set, real coverage, real rise) {
  real a = clamp(coverage, real(0.0f), real(1.0f));
  real covered = a * a * a * a * a;
  real loss = HILL_LOSS / (HILL_FACE + HILL_WIDTH * collectorWidth(set));
  return safeExp(-loss * covered * abs(rise));
}

// Depth in a slab `through` thick of a point that the part `share` of the `here` of cloud on its
// light ray shades: next to either face as far from it as on the ray, half way down half way. Where
// `here` is `through`, the depth on the ray.
real depthInSlab(real through, real share, real here) {
  real weight = share * share * (real(3.0f) - real(2.0f) * share);
  real depth = (real(1.0f) - weight) * share * here +
               weight * (through - (real(1.0f) - share) * here);
  return clamp(depth, real(0.0f), max(through, real(0.0f)));
}

// The slab of a set at a point that the part depthShare in [0, 1] of the cloud on its light ray,
// `here` in all, shades, from the means over the set's footprint.
SurfaceSlab surfaceSlab(int set, LightFootprint around, real depthShare, real here, vec3 toLight,
                        vec3 toEye) {
  real through = footprintMean(max(around.through, real(0.0f)), around.coverage);
  vec3 lit = directionOr(around.lit, toLight);
  vec3 shaded = directionOr(around.shaded, -toLight);
  real inWidths = (set < 2 ? real(0.7) : real(1.0f)) / collectorWidth(set);
  real across = through * max(dot(lit, toLight), real(0.0f));
  vec3 normal = slabNormal(lit, shaded, across * inWidths);
  SurfaceSlab result;
  result.slab =
      tangentSlab(through, depthInSlab(through, depthShare, here), normal, toLight, toEye);
  result.inside = footprintSurvival(set, around.coverage, depthShare) *
                  hillKept(set, around.coverage, around.rise * result.slab.muLight);
  return result;
}

// Part of the cloud on a point's light ray that lies towards the light: `depth` of `through`.
real lightDepthShare(real depth, real through) {
  return clamp(depth / max(through, real(1e-6)), real(0.0f), real(1.0f));
}

// Part of a chord's opacity in front of the point whose light stands for all of the chord's.
const real SURFACE_SAMPLE = real(0.7);
