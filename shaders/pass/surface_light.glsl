// SPDX-License-Identifier: MIT
// Light scattered at least twice that a surface cloud sends to the eye, from light maps and the
// source's image: the rule of model/surface with its fetches, of both maps at whole levels for all
// sets but the last, of the source per set. Needs model.glsl. Vectors are in the light's frame, z
// towards the light.
//
// columns: coverage, through (m), x and y of the lit face's normal; faces: z of that normal, x and
// y of the shaded face's, depth of the lit face along the light (m); both with mipmaps of means
// over all of a texel, filtered linearly in place and level, transparent black beyond their border.
// source, curves: SurfaceSourceImage of src/tables/surface_source, 3-D and 181 x 2, filtered
// linearly, clamped to their edge.

struct SurfaceMap {
  float texel;       // width at level 0, m
  float levels;      // index of the last level
  float extinction;  // canonical depth per metre: 1 - f of the medium's
};

// Of what the maps hold at a level; `face`: depth of the lit face above the point, m.
LightFootprint footprintOf(vec4 column, vec4 side, SurfaceMap map, float level, float face) {
  // The maps end where one texel holds the whole cloud: a wider footprint is that and nothing.
  float part = exp2(-2.0 * max(level - map.levels, 0.0));
  column *= part;
  side *= part;
  LightFootprint around;
  around.coverage = column.x;
  around.through = column.y * map.extinction;
  around.lit = vec3(column.zw, side.x);
  // The third of the shaded normal as if all were alike: the slab's normal hardly asks.
  around.shaded = vec3(side.yz, -sqrt(max(column.x * column.x - dot(side.yz, side.yz), 0.0)));
  around.rise = (footprintMean(side.w, column.x) - face) * map.extinction;
  return around;
}

LightFootprint surfaceFootprint(sampler2D columns, sampler2D faces, SurfaceMap map, vec2 place,
                                float level, float face) {
  return footprintOf(textureLod(columns, place, level), textureLod(faces, place, level), map, level,
                     face);
}

float surfaceLogSource(sampler3D source, int set, SourcePlace at) {
  float views = float(SOURCE_VIEWS - 1);
  float view = min(floor(at.view), views - 1.0);
  float azimuth = min(floor(at.azimuth), float(SOURCE_AZIMUTHS) - 2.0);
  vec3 corner = at.node + 0.5;
  corner.x += (view + (at.up ? views : 0.0)) * float(SOURCE_DEPTHS);
  corner.y += azimuth * float(SOURCE_THICKNESSES);
  corner.z += float(set * SOURCE_LIGHTS);
  vec4 nodes = textureLod(source, corner / vec3(SOURCE_SIZE), 0.0);
  vec2 both = mix(nodes.xy, nodes.zw, at.azimuth - azimuth);
  return mix(both.x, both.y, at.view - view) + at.outside;
}

// Radiance per unit irradiance and opacity, RGB: J at a point at `place` of the map, `shade` metres
// of cloud below the light. The point is that at chordDepth(SURFACE_SAMPLE, canonical depth of the
// chord); what the eye gets is this times oneMinusExp(canonical depth of the chord).
// `left`: part of each set's light that the medium does not absorb.
vec3 surfaceScattered(sampler2D columns, sampler2D faces, sampler3D source, sampler2D curves,
                      SurfaceMap map, vec2 place, float depth, float shade, vec3 toEye,
                      vec4 left[8]) {
  const vec3 TO_LIGHT = vec3(0.0, 0.0, 1.0);
  float texel = map.texel * map.extinction;
  LightFootprint here = surfaceFootprint(columns, faces, map, place, 0.0, depth - shade);
  float through = footprintMean(here.through, here.coverage);
  float share = lightDepthShare(shade * map.extinction, through);
  LightFootprint some =
      surfaceFootprint(columns, faces, map, place, footprintLevel(LOCAL_SPREAD, texel),
                       depth - shade);
  float across = footprintMean(some.through, some.coverage);
  TangentSlab local = tangentSlab(across, depthInSlab(across, share, through),
                                  directionOr(some.lit, TO_LIGHT), TO_LIGHT, toEye);
  float angle = slabAngle(-toEye.z, length(toEye.xy)) * 0.3183098861837907;
  float turn = (angle * 180.0 + 0.5) / 181.0;
  vec4 few = textureLod(curves, vec2(turn, 0.25), 0.0);
  vec4 many = textureLod(curves, vec2(turn, 0.75), 0.0);
  // Of sets of known width linear between whole levels, as the sampler would have it, but each read
  // once.
  float base = footprintMapLevel(local, texel);
  float finest = base + footprintSetLevel(0, local);
  float first = floor(finest);
  vec4 column[SURFACE_RUNGS];
  vec4 side[SURFACE_RUNGS];
  for (int rung = 0; rung < SURFACE_RUNGS; ++rung) {
    float level = max(first + float(rung), 0.0);
    column[rung] = textureLod(columns, place, level);
    side[rung] = textureLod(faces, place, level);
  }
  vec3 sum = vec3(0.0);
  for (int set = 0; set < SURFACE_SETS; ++set) {
    LightFootprint around;
    if (set < SURFACE_DIFFUSE) {
      int rung = footprintRung(set);
      float above = finest - first + footprintSetLevel(set, local) - footprintSetLevel(0, local);
      vec3 weight = max(1.0 - abs(above - vec3(rung, rung + 1, rung + 2)), 0.0);
      around = footprintOf(
          weight.x * column[rung] + weight.y * column[rung + 1] + weight.z * column[rung + 2],
          weight.x * side[rung] + weight.y * side[rung + 1] + weight.z * side[rung + 2], map,
          max(first + above, 0.0), depth - shade);
    } else {
      around = surfaceFootprint(columns, faces, map, place,
                                max(base + footprintSetLevel(set, local), 0.0), depth - shade);
    }
    SurfaceSlab found = surfaceSlab(set, around, share, through, TO_LIGHT, toEye);
    SourcePlace at = sourcePlace(set, found.slab);
    float logPhase = set < 4 ? few[set] : many[set - 4];
    sum += left[set].xyz * sourceRadiance(surfaceLogSource(source, set, at), logPhase,
                                          found.slab.muLight, found.inside);
  }
  return sum;
}
