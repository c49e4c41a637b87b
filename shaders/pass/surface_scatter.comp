// SPDX-License-Identifier: MIT
// Light scattered more than once, added to the pixels of a list at the points that the shading has
// left (surface_light.glsl); fourth and second pixels keep it for those between them.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "common.glsl"
#include "../interface/slices.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 13) const bool HALF = false;

layout(set = 0, binding = 0, std140) uniform Frame { FrameUniforms frameBlock; };
FrameUniforms frame = frameBlock;
layout(set = 0, binding = 6, std430) buffer FrameState { vec4 frameState[]; };
layout(set = 0, binding = 7, rgba32f) readonly uniform image2D depths;
layout(set = 0, binding = 10) uniform sampler2D columns;
layout(set = 0, binding = 11) uniform sampler2D faces;
layout(set = 0, binding = 12) uniform sampler3D source;
layout(set = 0, binding = 13) uniform sampler2D curves;
layout(push_constant) uniform Push { SliceConstants sliceBlock; };
SliceConstants slice = sliceBlock;

#include "surface_mesh.glsl"
#include "surface_list.glsl"
#include "surface_point.glsl"
layout(set = 0, binding = 29) uniform usamplerBuffer frameTexels;
#include "frame_state.glsl"
#include "ray.glsl"
#include "surface_light.glsl"
#include "surface_place.glsl"

// Light scattered at least twice: J at the point, per unit irradiance. `lost`: what detail takes of
// the metres between it and the light.
vec3 scatteredAt(vec3 direction, float distance_, float lost) {
  vec3 p = distance_ * direction;
  float shade = shadeAt(lightRay(direction), distance_);
  vec4 q = vec4(p, 1.0f);
  vec3 toEye = eyeInMap(surface.lightX, surface.lightY, surface.lightZ, surface.map, direction);
  vec2 place = vec2(dot(surface.lightX, q), dot(surface.lightY, q));
  return surfaceScattered(columns, faces, source, curves, mapOf(surface.map), place,
                          dot(surface.lightZ, q) - lost, max(shade - lost, 0.0f), toEye,
                          surface.orders);
}

void main() {
  ivec2 pixel = listedPixel(slice.firstSlab);
  if (pixel.x < 0) {
    return;
  }
  uint at = coverIndex(pixel);
  uvec4 row = coverRow(at);
  vec3 weight = surfacePointWeight(row);
  float range = uintBitsToFloat(row.w);
  vec3 direction = pixelDirection(frame, vec2(pixel));
  vec3 light = scatteredAt(direction, range, uintBitsToFloat(row.z));
  if (HALF && slice.firstSlab != SURFACE_LIST_OWN) {
    surfaceRows[at] = floatBitsToUint(vec4(light, range));
  }
  uint index = uint(pixel.y) * uint(frame.viewport.x) + uint(pixel.x);
  frameState[index].xyz = stateAt(index).xyz + light * weight;
}
