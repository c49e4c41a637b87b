// SPDX-License-Identifier: MIT
// Light buffer of one batch of slabs: marches each light texel through slabs [first, first + count)
// and stores, at every plane, the optical depth from the lit side and the part of it that forward
// scattering gives back. [R04] 4.2.2, Eq. 25 as corrected: dI/dtau = -(1 - albedo F(n)) I, so
// ln I = -tau + phi with phi = integral of albedo F(n) dtau, whatever the slab count.
#include "common.glsl"
#include "../interface/slices.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 3) const uint FIELD_COUNT = 1;
layout(constant_id = 4) const bool FORWARD_SCATTERING = true;

layout(set = 0, binding = 1, std140) uniform Volume { VolumeUniforms volumeBlock; };
VolumeUniforms volume = volumeBlock;
layout(set = 0, binding = 2, LIGHT_FORMAT) uniform image3D lightBuffer;
layout(set = 0, binding = 4) uniform sampler3D field0;
layout(set = 0, binding = 5) uniform sampler3D field1;
layout(set = 0, binding = 6) uniform sampler3D field2;
layout(set = 0, binding = 7) uniform sampler3D field3;
layout(set = 0, binding = 16) uniform sampler3D pages;
layout(push_constant) uniform Push { SliceConstants sliceBlock; };
SliceConstants slice = sliceBlock;

#include "fields.glsl"

// F(n) of the fields, linear between the depth nodes.
vec4 forwardFractions(float n) {
  float x = depthCoordinate(n) * 31.0f;
  float i = min(floor(x), 30.0f);
  return mix(volumeBlock.forwardFraction[int(i)], volumeBlock.forwardFraction[int(i) + 1], x - i);
}

void main() {
  uvec2 texel = tileOf(gl_WorkGroupID.xy, gl_NumWorkGroups.xy) * 8u + gl_LocalInvocationID.xy;
  uint size = slice.lightSize;
  if (texel.x >= size || texel.y >= size) {
    return;
  }
  vec2 uv = (vec2(texel) + 0.5f) / float(size);
  vec3 base = volume.texelOrigin.xyz + uv.x * volume.texelA.xyz + uv.y * volume.texelB.xyz;
  float path = volume.texelA.w;

  vec2 state = vec2(0.0f);
  if ((slice.flags & SLICE_FIRST_BATCH) == 0u) {
    state = imageLoad(lightBuffer, ivec3(texel, int(slice.slabCount))).xy;
  }
  imageStore(lightBuffer, ivec3(texel, 0), vec4(state, 0.0f, 0.0f));

  // Stretch of the light ray inside the box, in slabs from the batch's first one. Slabs that it
  // enters or leaves count with the part inside: a volume may be dense up to its faces.
  Span inside = rayBox(base + float(slice.firstSlab) * volume.texelC.xyz, volume.texelC.xyz,
                       vec3(0.0f), vec3(1.0f));
  float batchEnd = float(slice.slabCount);
  uint enter = uint(clamp(floor(inside.begin), 0.0f, batchEnd));
  uint leave = uint(clamp(ceil(inside.end), 0.0f, batchEnd));
  base += float(slice.firstSlab) * volume.texelC.xyz;
  uint k = 0u;
  while (k < enter) {
    k += 1u;
    imageStore(lightBuffer, ivec3(texel, int(k)), vec4(state, 0.0f, 0.0f));
  }
  while (k < leave) {
    float c0 = max(float(k), inside.begin);
    float c1 = max(min(float(k) + 1.0f, inside.end), c0);
    vec4 extinction = fieldExtinction(base + 0.5f * (c0 + c1) * volume.texelC.xyz);
    float stretch = path * (c1 - c0);
    float depth = (extinction.x + extinction.y + extinction.z + extinction.w) * stretch;
    float back = 0.0f;
    if (FORWARD_SCATTERING) {
      // n at the middle of the slab: second order in the slab's depth. The albedo of a mixture is
      // weighted by extinction; phi of an empty slab is 0 without a division.
      vec4 scattered = extinction * volume.meanAlbedo * stretch;
      float n = state.x + 0.5f * depth;
      back = dot(scattered, forwardFractions(n));
    }
    state += vec2(depth, back);
    k += 1u;
    imageStore(lightBuffer, ivec3(texel, int(k)), vec4(state, 0.0f, 0.0f));
  }
  while (k < slice.slabCount) {
    k += 1u;
    imageStore(lightBuffer, ivec3(texel, int(k)), vec4(state, 0.0f, 0.0f));
  }
}
