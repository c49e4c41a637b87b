// SPDX-License-Identifier: MIT
// What a surface sends to the eye in each pixel, in front of what is already there or behind it:
// light scattered once along the chord, light scattered more often by surface_light.glsl, and what
// the cloud and the air before it hide. [B08] 6 as docs/models.md has it.
//
// Light of the forward peak counts as passing, for what is hidden as for what reaches a point.
// What has been in the peak exactly once is seen next to the light itself (a corona), dimmed by the
// whole extinction.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common.glsl"
#include "../interface/slices.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
// Clear air: all of its light comes from the table.
layout(constant_id = 6) const bool ALL_LIGHT = false;
// Detail under the faces: drivers such as lavapipe run every branch.
layout(constant_id = 7) const bool DETAIL = true;
layout(constant_id = 8) const bool MULTIPLE_ENABLED = true;
// Light of sky and ground.
layout(constant_id = 9) const bool AMBIENT = false;
// Pixels between fourth ones, then between second ones, take on their light.
layout(constant_id = 13) const bool HALF = false;
layout(constant_id = 14) const bool DISTANCE = false;

layout(set = 0, binding = 0, std140) uniform Frame { FrameUniforms frameBlock; };
FrameUniforms frame = frameBlock;
layout(set = 0, binding = 6, std430) buffer FrameState { vec4 frameState[]; };
layout(set = 0, binding = 7, rgba32f) readonly uniform image2D depths;
layout(set = 0, binding = 10) uniform sampler2D columns;
layout(set = 0, binding = 11) uniform sampler2D faces;
layout(set = 0, binding = 12) uniform sampler3D source;
layout(set = 0, binding = 13) uniform sampler2D curves;
// At nodes of a phase curve, RGB, 1/sr: P without the forward peak, below it what is in the peak.
layout(set = 0, binding = 14) uniform sampler2D phase;
layout(set = 0, binding = 15, std430) readonly buffer FogCurve { vec4 fogCurve[]; };
layout(set = 0, binding = 16) uniform sampler3D skyTable;
layout(set = 0, binding = 17) uniform sampler3D skyPeak;
layout(set = 0, binding = 18, std430) buffer Distances { vec4 distances[]; };
layout(set = 0, binding = 19) uniform sampler2D upDepths;
layout(set = 0, binding = 20) uniform sampler2D upColumns;
layout(set = 0, binding = 21) uniform sampler2D upFaces;
layout(set = 0, binding = 22) uniform sampler2D skyShare;
layout(push_constant) uniform Push { SliceConstants sliceBlock; };
SliceConstants slice = sliceBlock;

#include "surface_mesh.glsl"
layout(set = 0, binding = 29) uniform usamplerBuffer frameTexels;
#include "frame_state.glsl"
#include "surface_list.glsl"
#include "../interface/sky_table.glsl"
#include "surface_spread.glsl"
#include "surface_point.glsl"
#include "ray.glsl"
#include "fog_curve.glsl"
#include "air_column.glsl"
#include "sky_lookup.glsl"
#include "air_nodes.glsl"
#include "surface_light.glsl"
#include "surface_place.glsl"
#include "surface_shell.glsl"

// Along a chord, and what of its opacity lies in front of their ends. Errors of pictures, with all
// else that is not exact, and of those with four even ones: docs/results/surface-numerics.csv.
const int STRETCHES = 3;
const float STRETCH_ENDS[STRETCHES] = {0.35f, 0.8f, 1.0f};
// At the detail on the way to the light: from where the cloud begins, and from the point whose
// light stands for all. Errors: docs/results/surface-looks.csv.
const int LOOKS_FIRST = 2;
const int LOOKS = 4;
const float LONGEST_CHORD = 1.0e7f;  // m

Inside insideOf(SurfaceCover cover, float metre, float first) {
  Inside inside;
  // From inside the first crossing leaves.
  inside.front = cover.front != 0u ? first + float(~cover.front) * metre : first;
  inside.leave = first + float(~cover.leave) * metre;
  if (cover.front == 0u || ~cover.leave < ~cover.front) {
    inside.front = first;
  }
  inside.back = first + float(cover.back) * metre;
  inside.chord = min(float(cover.chord) * metre, LONGEST_CHORD);
  inside.back = max(inside.back, inside.front);
  inside.leave = clamp(inside.leave, inside.front, inside.back);
  return inside;
}

// For a surface's detail.
ShellRay shellRay(Inside inside, vec3 direction) {
  ShellRay ray;
  ray.origin = vec3(surface.cellX.w, surface.cellY.w, surface.cellZ.w);
  ray.slope = vec3(dot(surface.cellX.xyz, direction), dot(surface.cellY.xyz, direction),
                   dot(surface.cellZ.xyz, direction));
  ray.width = surface.detail.w * inside.front;
  return ray;
}

// From the point at distance t of another one.
ShellRay shellRayTo(ShellRay from, float t, vec3 direction) {
  ShellRay ray;
  ray.origin = from.origin + t * from.slope;
  ray.slope = vec3(dot(surface.cellX.xyz, direction), dot(surface.cellY.xyz, direction),
                   dot(surface.cellZ.xyz, direction));
  ray.width = from.width;
  return ray;
}

vec3 phaseAt(int table, vec3 direction) {
  float x = phaseCoordinate(oneMinusCosine(direction, frame.lights[0].direction.xyz)) *
            float(CURVE_NODES - 1);
  int i = min(int(x), CURVE_NODES - 2);
  return mix(texelFetch(phase, ivec2(i, table), 0).xyz,
             texelFetch(phase, ivec2(i + 1, table), 0).xyz, x - float(i));
}

// The source that sky and ground make at a point: in the slab along the vertical that the footprint
// of a set of some scatterings finds, each of its faces in what its side sees of both.
const int AMBIENT_SET = 4;
vec3 ambientAt(vec3 direction, ShellRay shell, float distance_) {
  const vec3 UP = vec3(0.0f, 0.0f, 1.0f);
  MapRay ray = mapRay(surface.upX, surface.upY, surface.upZ, surface.upMap, direction);
  MapPlace at = mapPlace(ray, distance_);
  float shade = shadeOf(at, texelFetch(upDepths, at.first, 0),
                        texelFetch(upDepths, at.first + ivec2(1, 0), 0),
                        texelFetch(upDepths, at.first + ivec2(0, 1), 0),
                        texelFetch(upDepths, at.first + ivec2(1, 1), 0));
  if (DETAIL) {
    float lost = shellShadeLost(shellRayTo(shell, distance_, -surface.upZ.xyz), shade, LOOKS);
    shade -= lost;
    at.depth -= lost;
  }
  vec4 q = vec4(distance_ * direction, 1.0f);
  vec2 place = vec2(dot(surface.upX, q), dot(surface.upY, q));
  vec3 toEye = eyeInMap(surface.upX, surface.upY, surface.upZ, surface.upMap, direction);
  SurfaceMap map = mapOf(surface.upMap);
  LightFootprint here = surfaceFootprint(upColumns, upFaces, map, place, 0.0f, at.depth - shade);
  float through = footprintMean(here.through, here.coverage);
  float share = lightDepthShare(shade * map.extinction, through);
  TangentSlab local =
      tangentSlab(through, through * share, directionOr(here.lit, UP), UP, toEye);
  float level = max(footprintMapLevel(local, map.texel * map.extinction) +
                        footprintSetLevel(AMBIENT_SET, local),
                    0.0f);
  LightFootprint around =
      surfaceFootprint(upColumns, upFaces, map, place, level, at.depth - shade);
  TangentSlab slab = surfaceSlab(AMBIENT_SET, around, share, through, UP, toEye).slab;
  SharePlace node = sharePlace(slab.thickness, slab.depth, slab.muView);
  float view = min(floor(node.view), float(SHARE_VIEWS) - 2.0f);
  float rows = float(SHARE_THICKNESSES);
  vec2 texel = node.node + 0.5f;
  texel.y += (view + (node.up ? float(SHARE_VIEWS) : 0.0f)) * rows;
  vec2 scale = 1.0f / vec2(float(SHARE_DEPTHS), 2.0f * float(SHARE_VIEWS) * rows);
  float one = textureLod(skyShare, texel * scale, 0.0f).x;
  float next = textureLod(skyShare, (texel + vec2(0.0f, rows)) * scale, 0.0f).x;
  float lit = clamp(mix(one, next, node.view - view) + node.diffuse, 0.0f, 1.0f);
  float seen = 0.5f + 0.5f * slab.muLight;
  return mix(mix(surface.sky.xyz, surface.ground.xyz, seen),
             mix(surface.ground.xyz, surface.sky.xyz, seen), lit) *
         surface.orders[2].xyz;
}

void main() {
  ivec2 pixel = listedPixel(slice.firstSlab);
  if (pixel.x < 0) {
    return;
  }
  uint at = coverIndex(pixel);
  SurfaceCover cover = coverOf(at);
  uint index = uint(pixel.y) * uint(frame.viewport.x) + uint(pixel.x);
  vec2 hidden = vec2(0.0f);
  vec3 direction = pixelDirection(frame, vec2(pixel));
  float along = 1.0f / max(dot(direction, surface.axis.xyz), 1.0e-4f);
  Inside inside = insideOf(cover, along / surface.steps.y, along * surface.steps.x);
  ShellRay shell;
  ShellMarch march;
  march.filled = inside.chord;
  march.lost = 0.0f;
  if (DETAIL) {
    shell = shellRay(inside, direction);
    float most = chordDepth(SURFACE_SAMPLE, surface.optics.z * inside.chord);
    march = shellMarch(inside, shell, surface.optics.y, most / max(surface.optics.z, 1.0e-20f));
  }
  // Of stretches, read before them: see ShellDetail.
  float extinction = surface.optics.x;
  float withoutPeak = surface.optics.y;
  MapRay light = lightRay(direction);
  float tau = withoutPeak * march.filled;
  AirNodes nodes = airNodes(direction, inside.front, inside.back);
  float through = 1.0f;
  vec3 sum = vec3(0.0f);
  vec3 smooth_ = vec3(0.0f);
  vec3 peak = vec3(0.0f);
  if (LIGHT_ENABLED) {
    smooth_ = phaseAt(0, direction) * surface.albedo.xyz;
    peak = phaseAt(1, direction) * surface.albedo.xyz;
  }
  // Stretches of what detail leaves; in [B08] of the whole chord.
#ifdef SHELL_NOISE_COMPUTED
  float cut = withoutPeak * inside.chord;
  float first_ = 0.0f;
#else
  float cut = tau;
  float first_ = march.lost;
#endif
  float opacity = oneMinusExp(cut);
  float thin = 1.0f / max(withoutPeak, 1.0e-20f);
  float begin = 0.0f;
  ChordLight whole = emptyChord();
  float depth = surface.optics.z * march.filled;
  float sample_ = min(chordDepth(SURFACE_SAMPLE, depth) / max(surface.optics.z, 1.0e-20f),
                      march.filled);
  float distance_ = pointAt(inside, march.lost + sample_);
  float near = pointAt(inside, march.lost);
  float shadeNear = LIGHT_ENABLED ? shadeAt(light, near) : 0.0f;
  // What detail takes from the way to the light at the first point and at the one whose light
  // stands for all; between them linear.
  vec2 lost = vec2(0.0f);
  if (LIGHT_ENABLED && DETAIL) {
    vec3 toLight = frame.lights[0].direction.xyz;
    lost.x = shellShadeLost(shellRayTo(shell, near, toLight), shadeNear, LOOKS_FIRST);
    lost.y =
        shellShadeLost(shellRayTo(shell, distance_, toLight), shadeAt(light, distance_), LOOKS);
    shadeNear -= lost.x;
  }
  float perSample = 1.0f / max(sample_, 1.0e-20f);
  for (int i = 0; i < STRETCHES; ++i) {
    float end = chordDepthOf(STRETCH_ENDS[i], opacity, cut) * thin;
    float length_ = max(end - begin, 0.0f);
    AirAt air = airAt(nodes, pointAt(inside, first_ + begin + 0.5f * length_));
#ifdef SHELL_NOISE_COMPUTED
    if (DETAIL) {
      length_ = shellStretch(inside, shell, begin, length_);
    }
    float passed = through * exp(-withoutPeak * length_);
#else
    float passed = exp(-min(withoutPeak * end, EXP_CUT));
#endif
    if (LIGHT_ENABLED) {
      float taken = mix(lost.x, lost.y, min(end * perSample, 1.0f));
      float shadeFar = max(shadeAt(light, pointAt(inside, first_ + end)) - taken, 0.0f);
      float once = through * segmentInscatter(withoutPeak * shadeNear,
                                              withoutPeak * shadeFar,
                                              withoutPeak * length_);
      float before = whole.inscatter;
      whole = chordStretch(whole, extinction * shadeNear, extinction * shadeFar,
                           extinction * length_);
      sum += (smooth_ * once + peak * (whole.inscatter - before)) * air.light *
             air.transmittance;
      shadeNear = shadeFar;
    }
    sum += air.radiance * (through - passed);
    if (DISTANCE) {
      float middle = pointAt(inside, first_ + begin + 0.5f * length_);
      hidden += (through - passed) * vec2(middle, 1.0f);
    }
    through = passed;
    begin = end;
  }
#ifdef SHELL_NOISE_COMPUTED
  through = exp(-min(tau, EXP_CUT));
#endif
  bool first = (slice.flags & SLICE_FIRST_VOLUME) != 0u;
  vec3 scattered = vec3(0.0f);
  // Drivers such as lavapipe read either way: the first, which has nothing in front, one row, which
  // lies behind those of all pixels and is never written.
  vec4 before = stateAt(first ? uint(frame.viewport.x) * uint(frame.viewport.y) : index);
  vec4 front = first ? vec4(0.0f, 0.0f, 0.0f, 1.0f) : before;
  if (LIGHT_ENABLED || AMBIENT) {
    AirAt air = airAt(nodes, distance_);
    if (LIGHT_ENABLED) {
      vec3 weight = front.w * oneMinusExp(depth) * air.light * air.transmittance;
      // In the place of the cover, in one store: drivers such as lavapipe run each for all.
      bool own = true;
      bool second = HALF && slice.firstSlab == SURFACE_LIST_SECONDS;
      uvec4 row = surfacePointRow(weight, lost.y, distance_);
      if (HALF) {
        vec4 between = lightBetween(pixel, at, distance_, second ? 4 : 2);
        // What nothing is seen of needs no light, but where others may take it on.
        bool unseen = max(max(weight.x, weight.y), weight.z) == 0.0f;
        own = slice.firstSlab == SURFACE_LIST_FOURTHS || (between.w == 0.0f && (second || !unseen));
        scattered = between.w == 0.0f || own ? vec3(0.0f) : between.xyz * weight;
        row = own ? row : floatBitsToUint(vec4(between.xyz, distance_));
        if (own) {
          listOwn(pixel, slice.firstSlab);
        }
      }
      if (own || second) {
        surfaceRows[at] = row;
      }
    }
    if (AMBIENT) {
      sum += (1.0f - through) * ambientAt(direction, shell, distance_) *
             air.transmittance;
    }
  }
  if (DISTANCE) {
    vec2 nearer = first ? vec2(0.0f) : distances[index].xy;
    distances[index] = vec4(nearer + front.w * hidden, hidden);
  }
  frameState[index] = vec4(front.xyz + front.w * sum + scattered, front.w * through);
}
