// SPDX-License-Identifier: MIT
// Eye buffer of one batch of slabs: each pixel marches through the slabs of the batch that its ray
// meets, nearest first, and merges the result with what earlier batches left. Rays that run with
// the slicing axis composite front to back over the batches, rays against it back to front
// (Kniss et al., [R04] 5); every ray decides for itself, so nothing flips at 90 degrees.
// [R04] Eq. 26 as corrected: opacity 1 - e^-x per stretch, light at the middle of the stretch.
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
// Slices of froxels, one behind the other, instead of pixels: rays end at the slice's distance.
layout(constant_id = 13) const bool FROXELS = false;
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
layout(set = 0, binding = 11, std430) buffer VolumeState { vec4 volumeState[]; };
layout(set = 0, binding = 12, std430) readonly buffer FogCurve { vec4 fogCurve[]; };
layout(set = 0, binding = 13) uniform sampler3D skyTable;
layout(set = 0, binding = 14) uniform sampler3D skyPeak;
layout(set = 0, binding = 15) uniform sampler3D viewSource;
layout(set = 0, binding = 16) uniform sampler3D pages;
layout(set = 0, binding = 17) uniform sampler3D viewAmbient;
// Per pixel, of all volumes and of this one: sum of what is hidden at a distance (a part of the
// background) times the distance (m), and of what is hidden.
layout(set = 0, binding = 19, std430) buffer Distances { vec4 distances[]; };
layout(push_constant) uniform Push { SliceConstants sliceBlock; };
SliceConstants slice = sliceBlock;

#include "../interface/sky_table.glsl"
#include "ray.glsl"
#include "ray_end.glsl"
#include "fog_curve.glsl"
#include "fields.glsl"
#include "air_column.glsl"
#include "sky_lookup.glsl"
#include "air_nodes.glsl"

// Copies, see common.glsl.
vec4 fieldAlbedo[4] = volume.albedo;
vec4 fieldMeanAlbedo = volume.meanAlbedo;

const float RAY_ENDS = 1.0e-6f;    // transmittance at which a ray ends; bounds its relative error
const float HIDDEN = 18.0f;         // optical depth by the grid beyond which nothing is looked at
const float LONGEST_RAY = 1.0e7f; // m inside one volume
const uint MAX_SUBSTEPS = 256u;   // per slab, for rays that run along it

#include "volume_source.glsl"

// Radiance scattered towards the eye per unit irradiance: sum of the fields' extinction * albedo *
// light * phase. Of the four `single`, values of single scattering.
// `eyeDepth`: optical depth to the eye, as far as it is known.
// `box`: where, in the unit box.
vec3 scatteredLight(vec4 extinction, vec3 single[4], vec2 light, float angle, float eyeDepth,
                    vec3 box) {
  float tau = light.x;
  vec3 sum = vec3(0.0f);
  if (TRANSPORT) {
    for (uint i = 0u; i < FIELD_COUNT; ++i) {
      float turned = (tau + eyeDepth) * fieldMeanAlbedo[i];
      vec3 source = fieldSource(i, depthCoordinate(turned), angle, box);
      sum += fieldAlbedo[i].xyz * source * extinction[i];
    }
    return sum * exp(-min(tau * volume.texelOrigin.w, 80.0f));
  }
  if (!FORWARD_SCATTERING) {
    for (int i = 0; i < int(FIELD_COUNT); ++i) {
      vec3 source = variesInside(uint(i)) ? fieldSource(uint(i), 0.0f, angle, box) : single[i];
      sum += fieldAlbedo[i].xyz * source * extinction[i];
    }
    return sum * exp(-tau);
  }
  // phi was accumulated with the mean albedo; each colour scales it by its own.
  for (uint i = 0u; i < FIELD_COUNT; ++i) {
    float mean = max(fieldMeanAlbedo[i], 1.0e-6f);
    vec3 albedo = fieldAlbedo[i].xyz;
    vec3 intensity = exp(min(light.y * albedo / mean - tau, vec3(0.0f)));
    vec3 source = fieldSource(i, depthCoordinate(tau * fieldMeanAlbedo[i]), angle, box);
    sum += intensity * albedo * source * extinction[i];
  }
  return sum;
}

// Optical depth without the peak between two points of a ray in the unit box, by the grid's cells.
float gridDepth(vec3 origin, vec3 step_, float begin, float end) {
  const int STEPS = 32;
  float dt = max(end - begin, 0.0f) / float(STEPS);
  float sum = 0.0f;
  int i = 0;
  do {
    sum += textureLod(viewSource, gridPlace(origin + (begin + (float(i) + 0.5f) * dt) * step_),
                      0.0f).w;
    i += 1;
  } while (i < STEPS);
  return sum * dt;
}

void main() {
  uvec2 offset = tileOf(gl_WorkGroupID.xy, gl_NumWorkGroups.xy) * 8u + gl_LocalInvocationID.xy;
  uvec2 pixel = uvec2(volume.rect.xy) + offset;
  if (pixel.x >= uint(volume.rect.z) || pixel.y >= uint(volume.rect.w)) {
    return;
  }
  uint layer = FROXELS ? gl_WorkGroupID.z + uint(frame.froxelRange.x) : 0u;
  uint index = (layer * uint(frame.viewport.y) + pixel.y) * uint(frame.viewport.x) + pixel.x;
  vec3 direction = pixelDirection(frame, vec2(pixel));
  float surface = INFINITE_DISTANCE;
  if (DEPTH_ENABLED) {
    float d = texelFetch(depthImage, ivec2(pixel), 0).x;
    surface = surfaceDistance(frame, vec2(pixel), d);
  }
  surface = FROXELS ? froxelDistance(frame, layer) : endOfRay(frame, direction, surface);

  // Everything on the ray is affine in the distance t (m).
  vec3 boxOrigin = volume.boxFromEye[3].xyz;
  vec3 boxStep = (volume.boxFromEye * vec4(direction, 0.0f)).xyz;
  Span span = rayBox(boxOrigin, boxStep, vec3(0.0f), vec3(1.0f));
  span.end = min(min(span.end, surface), span.begin + LONGEST_RAY);
  vec3 lightOrigin = vec3(volume.lightU.w, volume.lightV.w, volume.plane.w);
  vec3 lightStep = vec3(dot(direction, volume.lightU.xyz), dot(direction, volume.lightV.xyz),
                        dot(direction, volume.plane.xyz));
  float rate = abs(lightStep.z) < 1.0e-12f ? 1.0e-12f : lightStep.z;  // planes per m
  float ahead = rate > 0.0f ? 1.0f : -1.0f;
  float enterPlane = float(slice.firstSlab) + (rate > 0.0f ? 0.0f : float(slice.slabCount));
  float leavePlane = float(slice.firstSlab) + (rate > 0.0f ? float(slice.slabCount) : 0.0f);
  float t = max(span.begin, (enterPlane - lightOrigin.z) / rate);
  float last = min(span.end, (leavePlane - lightOrigin.z) / rate);

  vec4 state = vec4(0.0f, 0.0f, 0.0f, 1.0f);
  if ((slice.flags & SLICE_FIRST_BATCH) == 0u) {
    state = volumeState[index];
  }
  vec2 hidden = vec2(0.0f);
  if (DISTANCE && (slice.flags & SLICE_FIRST_BATCH) == 0u) {
    hidden = distances[index].zw;
  }

  if (last > t && !(rate > 0.0f && state.w < RAY_ENDS)) {
    float angle = phaseCoordinate(oneMinusCosine(direction, frame.lights[0].direction.xyz));
    vec3 single[4];
    for (int i = 0; i < 4; ++i) {
      single[i] = vec3(0.0f);
    }
    if (LIGHT_ENABLED && !FORWARD_SCATTERING && !TRANSPORT) {
      for (int i = 0; i < int(FIELD_COUNT); ++i) {
        single[i] = exp(logLayerSource(float(i), 0.0f, angle));
      }
    }
    AirNodes nodes = airNodes(direction, span.begin, span.end);

    // The buffer may have room for larger batches.
    float layers = float(textureSize(lightBuffer, 0).z);
    float maxStep = min(volume.texelC.w, flatStep(boxStep));
    vec4 batch = vec4(0.0f, 0.0f, 0.0f, 1.0f);
    vec2 batchHidden = vec2(0.0f);
    // Plane at the far side of the current slab, in ray order; the half step keeps rounding at a
    // batch's edge from repeating its last slab.
    float plane = enterPlane;
    float planeAtT = lightOrigin.z + t * rate;
    plane += ahead * (floor(max(ahead * (planeAtT - enterPlane), 0.0f)) + 1.0f);
    float stop = min(last, (plane - lightOrigin.z) / rate);
    uint left = uint(clamp(ceil((stop - t) / maxStep), 1.0f, float(MAX_SUBSTEPS)));
    float dt = max(stop - t, 0.0f) / float(left);
    uint guard = 0u;
    float eyeDepth = 0.0f;
    float shape = 1.0f;
    vec4 zonal = vec4(0.0f);
    if (TRANSPORT) {
      shape = pairShape(dot(direction, frame.lights[0].direction.xyz));
      zonal = gridZonal(direction);
      // Rays against the light come to what is nearer in later batches.
      float before = -log(max(state.w, 1.0e-20f));
      if (rate < 0.0f) {
        before = gridDepth(boxOrigin, boxStep, span.begin, t);
        // What that hides ends before its first step.
        last = before < HIDDEN ? last : t;
      }
      eyeDepth = before / volume.texelOrigin.w;
    }
    // Tested in front, as in eye_march.comp.
    while (t < last && batch.w > RAY_ENDS && guard < 65000u) {
      float middle = t + 0.5f * dt;
      vec4 extinction = fieldExtinction(boxOrigin + middle * boxStep);
      float beta = extinction.x + extinction.y + extinction.z + extinction.w;
      float x = beta * dt;
      if (TRANSPORT) {
        x *= volume.texelOrigin.w;
      }
      vec3 source = vec3(0.0f);
      AirAt air = airAt(nodes, middle);
      if (LIGHT_ENABLED) {
        vec3 at = lightOrigin + middle * lightStep;
        at.z = (at.z - float(slice.firstSlab) + 0.5f) / layers;
        vec2 light = textureLod(lightBuffer, at, 0.0f).xy;
        source = scatteredLight(extinction, single, light, angle, eyeDepth + 0.5f * beta * dt,
                                boxOrigin + middle * boxStep);
        if (TRANSPORT) {
          vec3 more = gridSource(boxOrigin + middle * boxStep, shape, zonal);
          source += more * (beta * volume.texelOrigin.w);
        }
        source *= air.light;
        eyeDepth += beta * dt;
      }
      if (AMBIENT) {
        float emits = TRANSPORT ? beta * volume.texelOrigin.w : beta;
        source += ambientAt(boxOrigin + middle * boxStep) * emits;
      }
      float average = phi1(x) * dt;  // (1 - e^-x) / extinction without the division
      float opacity = x * phi1(x);
      batch.xyz += batch.w * (source * average * air.transmittance + air.radiance * opacity);
      if (DISTANCE) {
        // Mean of u e^(-x u) over the step, u from 0 to 1, times x.
        float inside = x < 0.01f ? 0.5f * x : phi1(x) - (1.0f - opacity);
        batchHidden += batch.w * vec2(opacity * t + inside * dt, opacity);
      }
      batch.w *= 1.0f - opacity;
      t += dt;
      left -= 1u;
      if (left == 0u) {
        t = stop;
        plane += ahead;
        stop = min(last, (plane - lightOrigin.z) / rate);
        left = uint(clamp(ceil((stop - t) / maxStep), 1.0f, float(MAX_SUBSTEPS)));
        dt = max(stop - t, 0.0f) / float(left);
      }
      guard += 1u;
    }

    if (DISTANCE) {
      hidden = rate > 0.0f ? hidden + state.w * batchHidden : batchHidden + batch.w * hidden;
    }
    if (rate > 0.0f) {
      state = vec4(state.xyz + state.w * batch.xyz, state.w * batch.w);
    } else {
      state = vec4(batch.xyz + batch.w * state.xyz, state.w * batch.w);
    }
  }

  if (DISTANCE) {
    vec4 kept = vec4(hidden, hidden);
    if ((slice.flags & SLICE_FIRST_VOLUME) == 0u) {
      kept.xy = distances[index].xy;
      if ((slice.flags & SLICE_LAST_BATCH) != 0u) {
        kept.xy += frameState[index].w * hidden;
      }
    }
    distances[index] = kept;
  }
  if ((slice.flags & SLICE_LAST_BATCH) != 0u) {
    if ((slice.flags & SLICE_FIRST_VOLUME) == 0u) {
      vec4 front = frameState[index];
      state = vec4(front.xyz + front.w * state.xyz, front.w * state.w);
    }
    frameState[index] = state;
  } else {
    volumeState[index] = state;
  }
}
