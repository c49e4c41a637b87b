// SPDX-License-Identifier: MIT
// Source of the light scattered at least twice in a slab: radiance per unit depth that a point
// sends to the eye, per unit irradiance facing the light. What is tabulated
// (src/tables/surface_source) is ln(J / (mu_L P)) with P the phase function of the set: the
// canonical table differentiated along the ray, J = T + dT/ds, on so many of its nodes that linear
// filters will do.
const int SOURCE_DEPTHS = 21;
const int SOURCE_THICKNESSES = 23;
const int SOURCE_LIGHTS = 5;
const int SOURCE_VIEWS = 5;     // of each hemisphere
const int SOURCE_AZIMUTHS = 4;  // 0 .. pi
// Of the image: depth and view, thickness and azimuth, light and set. A texel has the values at a
// view and an azimuth, at the next view, the next azimuth, and both, so that one fetch filters all
// five axes' nodes but for two weights.
const ivec3 SOURCE_SIZE = ivec3(SOURCE_DEPTHS * (SOURCE_VIEWS - 1) * 2,
                                SOURCE_THICKNESSES * (SOURCE_AZIMUTHS - 1),
                                SOURCE_LIGHTS * SURFACE_SETS);

// Where a slab lies among the nodes.
struct SourcePlace {
  vec3 node;     // depth, thickness, light, from 0
  real view;     // in its hemisphere, from 0
  bool up;
  real azimuth;  // from 0
  real outside;  // to be added to the tabulated logarithm
};

// First scattering order of a set less one: how many scatterings need the slab's own depth.
real sourceOrders(int set) {
  if (set < 4) {
    return set < 2 ? (set < 1 ? real(1.0f) : real(2.0f)) : (set < 3 ? real(4.0f) : real(6.0f));
  }
  return set < 6 ? (set < 5 ? real(8.0f) : real(12.0f)) : (set < 7 ? real(18.0f) : real(30.0f));
}

// Depth behind a face at which light of many orders would vanish: 0.71 / (1 - g), g = 0.752.
const real SOURCE_BEHIND = real(2.863);
real diffuseLeft(real thickness, real depth) {
  return (thickness - depth + SOURCE_BEHIND) / (thickness + real(2.0f) * SOURCE_BEHIND);
}

// Thinner slabs than the table's scale as the power of their thickness; in thicker ones light of
// many orders falls linearly across ([B08] 5.2 leaves both open).
SourcePlace sourcePlace(int set, TangentSlab slab) {
  real thickness = clamp(slab.thickness, real(1e-6), real(1e6));
  real depth = clamp(slab.depth, real(0.0f), thickness);
  vec2 inside = canonicalInside(thickness, depth);
  real within = clamp(inside.y, real(0.0f), inside.x);
  SourcePlace place;
  place.node = vec3(canonicalDepth(within, inside.x) * real(SOURCE_DEPTHS - 1),
                    canonicalThickness(inside.x) * real(SOURCE_THICKNESSES - 1),
                    canonicalCosine(slab.muLight) * real(SOURCE_LIGHTS - 1));
  place.view = canonicalCosine(abs(slab.muView)) * real(SOURCE_VIEWS - 1);
  place.up = slab.muView < real(0.0f);
  place.azimuth = clamp(slab.phi * real(0.3183098861837907), real(0.0f), real(1.0f)) *
                  real(SOURCE_AZIMUTHS - 1);
  real thin = sourceOrders(set) * log(min(thickness / CANONICAL_THINNEST, real(1.0f)));
  real thick = set == SURFACE_DIFFUSE
                   ? log(diffuseLeft(thickness, depth) / diffuseLeft(inside.x, within))
                   : real(0.0f);
  place.outside = thickness > inside.x ? thick : thin;
  return place;
}

// From the tabulated logarithm, the phase function and the part that stays inside.
real sourceRadiance(real logSource, real logPhase, real muLight, real inside) {
  return inside * muLight * safeExp(logSource + logPhase);
}
