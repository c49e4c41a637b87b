// SPDX-License-Identifier: MIT
// Eye buffer of a volume whose light is stored for all slabs: each pixel marches once, front to
// back. Stretches end at multiples of the step from the box's middle, along each ray: they stay
// where they are in the volume while the eye moves along its view, and depend on no slab.
// [R04] 4.2 with Eq. 26 as corrected. Density at the middle of a stretch, light at its ends: the
// logarithm of what arrives is linear between, so that homogeneous media come out exactly, however
// thick a stretch.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common.glsl"
#include "../interface/slices.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 3) const uint FIELD_COUNT = 1;
layout(constant_id = 4) const bool FORWARD_SCATTERING = true;
layout(constant_id = 5) const bool DEPTH_ENABLED = true;
// Clear air: all of its light comes from the table.
layout(constant_id = 6) const bool ALL_LIGHT = false;
// Light scattered before comes from a grid; what forward peaks turn counts as passing.
layout(constant_id = 7) const bool TRANSPORT = false;
layout(constant_id = 8) const bool MULTIPLE_ENABLED = true;
// Light of sky and ground, from a grid of its own.
layout(constant_id = 9) const bool AMBIENT = false;
// All colours scatter alike: one is computed.
layout(constant_id = 10) const bool GREY = false;
layout(constant_id = 13) const uint RAYS = 0u;  // RAYS_OF_*
layout(constant_id = 14) const bool DISTANCE = false;

layout(set = 0, binding = 0, std140) uniform Frame { FrameUniforms frameBlock; };
FrameUniforms frame = frameBlock;
layout(set = 0, binding = 1, std140) uniform Volume { VolumeUniforms volumeBlock; };
VolumeUniforms volume = volumeBlock;
layout(set = 0, binding = 3) uniform sampler3D lightBuffer;
layout(set = 0, binding = 4) uniform sampler3D field0;
layout(set = 0, binding = 5) uniform sampler3D field1;
layout(set = 0, binding = 6) uniform sampler3D field2;
layout(set = 0, binding = 7) uniform sampler3D field3;
layout(set = 0, binding = 8) uniform sampler2DArray scatteringTable;
layout(set = 0, binding = 9) uniform sampler2D depthImage;
layout(set = 0, binding = 10, std430) buffer FrameState { vec4 frameState[]; };
layout(set = 0, binding = 12, std430) readonly buffer FogCurve { vec4 fogCurve[]; };
layout(set = 0, binding = 13) uniform sampler3D skyTable;
layout(set = 0, binding = 14) uniform sampler3D skyPeak;
layout(set = 0, binding = 15) uniform sampler3D viewSource;
layout(set = 0, binding = 16) uniform sampler3D pages;
layout(set = 0, binding = 17) uniform sampler3D viewAmbient;
layout(set = 0, binding = 18) uniform sampler3D leaps;
// Per pixel in xy, of all volumes: sum of what is hidden at a distance (a part of the background)
// times the distance (m), and of what is hidden.
layout(set = 0, binding = 19, std430) buffer Distances { vec4 distances[]; };
layout(push_constant) uniform Push { SliceConstants sliceBlock; };
SliceConstants slice = sliceBlock;

// Slices of froxels, one behind the other, instead of pixels: rays end at the slice's distance.
const bool FROXELS = RAYS == RAYS_OF_FROXELS;
const bool GRID = RAYS == RAYS_OF_GRID;
const bool LISTED = RAYS == RAYS_OF_LIST;

#include "../interface/sky_table.glsl"
#include "ray.glsl"
#include "ray_end.glsl"
#include "fog_curve.glsl"
#include "fields.glsl"
#include "leaps.glsl"
const bool TILES = LEAPS;
#include "second_pixels.glsl"
#include "air_column.glsl"
#include "sky_lookup.glsl"
#include "air_nodes.glsl"
#include "volume_source.glsl"

const float RAY_ENDS = 14.0f;      // optical depth at which a ray ends: 1e-6 of its light is left
const float LONGEST_RAY = 1.0e7f;  // m inside one volume
// lavapipe ends a shader silently after 65535 rounds of all its loops together. A step takes one of
// the march and two to see that it may not leap; leaps of eight rays that take turns across volumes
// 2048 voxels wide take 12000 more. Without leaps as well, for the same picture.
const float MAX_STEPS = 17000.0f;
// Shortest step as a share of the distance from the point nearest the box's middle: steps are
// counted from there, and ends of shorter ones would be the same float.
const float LEAST_STEP = 2.4e-7f;  // 2^-22
const bool AIR_SEEN = AIR_ENABLED || FOG_ENABLED;

// Copies, see common.glsl.
vec4 fieldAlbedo[4] = volume.albedo;
vec4 fieldMeanAlbedo = volume.meanAlbedo;
float notPeak = TRANSPORT ? volume.texelOrigin.w : 1.0f;  // share of extinction, see VolumeUniforms

// The ray, affine in the distance s (m) from the point nearest the box's middle.
struct March {
  vec3 box;  // position in the unit box, and per m
  vec3 boxStep;
  vec3 light;  // in the light buffer
  vec3 lightStep;
  float angle;  // table coordinate of the scattering angle
  vec3 single[4];
};

// ln of the light that a stretch's end scatters towards the eye, per field: source (1/sr per unit
// irradiance) times what the light has lost to there and loses on the way to the eye.
struct End {
  vec3 field[4];
};

// Keeps clear of subnormal numbers, which are slow.
vec3 cutExp(vec3 x) {
  if (GREY) {
    return vec3(exp(max(x.x, -EXP_CUT)));
  }
  return exp(max(x, vec3(-EXP_CUT)));
}

vec3 meanLight(vec3 near, vec3 far, vec3 d) {
  if (GREY) {
    return vec3(meanExp(near.x, far.x, d.x));
  }
  return vec3(meanExp(near.x, far.x, d.x), meanExp(near.y, far.y, d.y),
              meanExp(near.z, far.z, d.z));
}

End endAt(March m, float s, float eyeDepth) {
  End end;
  vec2 light = textureLod(lightBuffer, m.light + s * m.lightStep, 0.0f).xy;
  float keep = notPeak;
  vec3 box = m.box + s * m.boxStep;
  for (int i = 0; i < int(FIELD_COUNT); ++i) {
    vec3 ln;
    if (TRANSPORT) {
      float turned = (light.x + eyeDepth) * fieldMeanAlbedo[i];
      ln = logFieldSource(uint(i), depthCoordinate(turned), m.angle, box) - light.x * keep;
    } else if (FORWARD_SCATTERING) {
      // phi was accumulated with the mean albedo; each colour scales it by its own.
      vec3 back = light.y * fieldAlbedo[i].xyz / max(fieldMeanAlbedo[i], 1.0e-6f);
      float turned = light.x * fieldMeanAlbedo[i];
      ln = logFieldSource(uint(i), depthCoordinate(turned), m.angle, box) +
           min(back - light.x, 0.0f);
    } else if (variesInside(uint(i))) {
      ln = logFieldSource(uint(i), 0.0f, m.angle, box) - light.x;
    } else {
      ln = m.single[i] - light.x;
    }
    end.field[i] = ln - eyeDepth * keep;
  }
  return end;
}

void main() {
  uvec2 tile = tileOf(gl_WorkGroupID.xy, gl_NumWorkGroups.xy);
  uvec2 offset = tile * 8u + gl_LocalInvocationID.xy;
  uvec2 pixel = uvec2(volume.rect.xy) + offset;
  bool everySecond = (slice.flags & SLICE_SECONDS) != 0u;
  bool ofSecond = GRID || (LISTED && everySecond);
  if (GRID) {
    uvec2 number = (everySecond ? firstSecond() : firstFourth()) + offset;
    uvec2 last = everySecond ? lastSecond() : lastFourth();
    if (offset == uvec2(0u)) {
      for (uint list = 0u; list < TILE_DRAW; list += LIST_SIZE) {
        seconds[list] = LIST_ROW;
        seconds[list + 1u] = 0u;
        seconds[list + 2u] = 1u;
        seconds[list + 3u] = 0u;
      }
      seconds[TILE_DRAW] = 0u;
      seconds[TILE_DRAW + 1u] = 1u;
      seconds[TILE_DRAW + 2u] = 0u;
      seconds[TILE_DRAW + 3u] = 0u;
    }
    if (number.x > last.x || number.y > last.y) {
      return;
    }
    pixel = number * (everySecond ? 2u : 4u);
  } else if (LISTED) {
    uint number = (tile.y * LIST_ROW + tile.x) * 64u + gl_LocalInvocationIndex;
    if (number >= seconds[ofSecond ? 3u : LIST_SIZE + 3u]) {
      return;
    }
    pixel = listed(number) * (ofSecond ? 2u : 1u);
  } else if (pixel.x >= uint(volume.rect.z) || pixel.y >= uint(volume.rect.w)) {
    return;
  }
  uint layer = FROXELS ? gl_WorkGroupID.z + uint(frame.froxelRange.x) : 0u;
  uint index = (layer * uint(frame.viewport.y) + pixel.y) * uint(frame.viewport.x) + pixel.x;
  vec3 direction = pixelDirection(frame, vec2(pixel));
  float surface = INFINITE_DISTANCE;
  if (DEPTH_ENABLED) {
    ivec2 inside = GRID || LISTED ? insideView(pixel) : ivec2(pixel);
    float d = texelFetch(depthImage, inside, 0).x;
    surface = surfaceDistance(frame, vec2(pixel), d);
  }
  surface = FROXELS ? froxelDistance(frame, layer) : endOfRay(frame, direction, surface);

  March m;
  m.boxStep = (volume.boxFromEye * vec4(direction, 0.0f)).xyz;
  Span span = rayBox(volume.boxFromEye[3].xyz, m.boxStep, vec3(0.0f), vec3(1.0f));
  float boxEnd = span.end;
  span.end = min(min(span.end, surface), span.begin + LONGEST_RAY);
  vec4 state = vec4(0.0f, 0.0f, 0.0f, 1.0f);
  vec2 hidden = vec2(0.0f);
  if (span.end > span.begin) {
    float nearest = dot(volume.middle.xyz, direction);
    m.box = volume.boxFromEye[3].xyz + nearest * m.boxStep;
    // The buffer may have room for more slabs.
    float layers = float(textureSize(lightBuffer, 0).z);
    m.lightStep = vec3(dot(direction, volume.lightU.xyz), dot(direction, volume.lightV.xyz),
                       dot(direction, volume.plane.xyz) / layers);
    m.light = vec3(volume.lightU.w, volume.lightV.w, (volume.plane.w + 0.5f) / layers) +
              nearest * m.lightStep;
    m.angle = phaseCoordinate(oneMinusCosine(direction, frame.lights[0].direction.xyz));
    for (int i = 0; i < 4; ++i) {
      m.single[i] = vec3(0.0f);
    }
    if (LIGHT_ENABLED && !FORWARD_SCATTERING && !TRANSPORT) {
      for (int i = 0; i < int(FIELD_COUNT); ++i) {
        m.single[i] = logLayerSource(float(i), 0.0f, m.angle);
      }
    }
    AirNodes nodes = airNodes(direction, span.begin, span.end);
    float keep = notPeak;
    float s = span.begin - nearest;
    float last = span.end - nearest;
    float longest = min(volume.middle.w, flatStep(m.boxStep));
    float dt = max(longest, (last - s) / MAX_STEPS);
    dt = max(dt, LEAST_STEP * max(abs(s), abs(last)));
    float shape = TRANSPORT ? pairShape(dot(direction, frame.lights[0].direction.xyz)) : 1.0f;
    vec4 zonal = TRANSPORT ? gridZonal(direction) : vec4(0.0f);
    float first = floor(s / dt) + 1.0f;  // the stretch's far end, in steps
    float eyeDepth = 0.0f;
    float through = 1.0f;
    vec3 sum = vec3(0.0f);
    // Of the light's own scattering: one colour where all are alike, times what no stretch changes.
    vec3 lit = vec3(0.0f);
    End end;
    vec3 ends[4];
    if (LIGHT_ENABLED) {
      end = endAt(m, s, 0.0f);
      for (int i = 0; i < int(FIELD_COUNT); ++i) {
        ends[i] = cutExp(end.field[i]);
      }
    }
    LeapRay leap = leapRay(m.boxStep, dt);
    // The test stands in front: lavapipe goes on with lanes whose loop has ended, so that what a
    // test at the end leaves is computed once more, from arrays that are already a stretch further.
    uint guard = 0u;
    while (s < last && eyeDepth * keep < RAY_ENDS && guard < 17500u) {
      float leapt = 0.0f;
      if (LEAPS) {
        // The stretch takes up those after it in which there is nothing: no sample is lost.
        leapt = emptyStretches(m.box, m.boxStep, leap, s, last, dt, first);
        first += max(leapt - 1.0f, 0.0f);
      }
      float next = min(first * dt, last);
      float stretch = max(next - s, 0.0f);
      float middle = s + 0.5f * stretch;
      vec4 extinction = extinctionInside(m.box + middle * m.boxStep);
      // The middle of all that was leapt may lie in none of the cubes that were: around a corner.
      extinction = leapt > 0.0f ? vec4(0.0f) : extinction;
      float beta = extinction.x + extinction.y + extinction.z + extinction.w;
      eyeDepth += beta * stretch;
      float passed = through;
      if (AIR_SEEN || TRANSPORT || AMBIENT || DISTANCE) {
        passed = exp(-min(eyeDepth * keep, EXP_CUT));
      }
      AirAt air = airAt(nodes, nearest + middle);
      if (LIGHT_ENABLED) {
        End far = endAt(m, next, eyeDepth);
        vec3 source = vec3(0.0f);
        for (int i = 0; i < int(FIELD_COUNT); ++i) {
          vec3 farEnd = cutExp(far.field[i]);
          vec3 d = end.field[i] - far.field[i];
          source += fieldAlbedo[i].xyz * meanLight(ends[i], farEnd, d) *
                    (extinction[i] * stretch);
          ends[i] = farEnd;
        }
        if (TRANSPORT) {
          source += gridSource(m.box + middle * m.boxStep, shape, zonal) * (through - passed);
        }
        end = far;
        if (AIR_SEEN) {
          sum += source * air.light * air.transmittance;
        } else if (GREY && !TRANSPORT) {
          lit.x += source.x;
        } else {
          lit += source;
        }
      }
      if (AMBIENT) {
        sum += ambientAt(m.box + middle * m.boxStep) * air.transmittance * (through - passed);
      }
      if (AIR_SEEN) {
        sum += air.radiance * (through - passed);
      }
      if (DISTANCE) {
        // Mean of u e^(-x u) over the stretch, u from 0 to 1, times x.
        float x = beta * stretch * keep;
        float inside = x < 0.01f ? 0.5f * x : phi1(x) - exp(-min(x, EXP_CUT));
        vec2 part = vec2(x * phi1(x) * (nearest + s) + inside * stretch, x * phi1(x));
        hidden += through * part;
      }
      through = passed;
      s = next;
      first += 1.0f;
      guard += 1u;
    }
    if (!AIR_SEEN) {
      lit = GREY && !TRANSPORT ? lit.xxx : lit;
      sum += lit * frame.lights[0].irradiance.xyz;
    }
    state = vec4(sum, exp(-min(eyeDepth * keep, EXP_CUT)));
  }

  if (ofSecond) {
    bool cut = DEPTH_ENABLED && boxEnd > span.begin && span.end < boxEnd;
    storeSecond(pixel / 2u, state, span.end > span.begin ? span.end : 0.0f, hidden, cut);
    return;
  }
  if (DISTANCE) {
    vec4 kept = vec4(hidden, hidden);
    if ((slice.flags & SLICE_FIRST_VOLUME) == 0u) {
      kept.xy = distances[index].xy + frameState[index].w * hidden;
    }
    distances[index] = kept;
  }
  if ((slice.flags & SLICE_FIRST_VOLUME) == 0u) {
    vec4 front = frameState[index];
    state = vec4(front.xyz + front.w * state.xyz, front.w * state.w);
  }
  frameState[index] = state;
}
