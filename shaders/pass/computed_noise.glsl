// SPDX-License-Identifier: MIT
// A hypertexture as [B08] 8 has it, to measure what that costs: marched in steps of a 512th of the
// body, noise computed at each, three octaves of Perlin's (1985, 2002) of the sizes of
// src/tables/detail_noise. In no shipped pass.

float voxelOf(SurfaceUniforms s) {
  float cell = s.detailShift.w * s.detail.x;
  return cell * float(max(max(s.cells.x, s.cells.y), s.cells.z)) / 512.0f;
}

// A lattice point's gradient, to one of the twelve edges' middles of a cube, times p.
float latticeTimes(uvec3 lattice, vec3 p) {
  uint h = lattice.x * 1597334677u ^ lattice.y * 3812015801u ^ lattice.z * 2798796415u;
  h = (h ^ (h >> 15)) * 2246822519u;
  h = (h ^ (h >> 13)) & 15u;
  float u = h < 8u ? p.x : p.y;
  float v = h < 4u ? p.y : (h == 12u || h == 14u ? p.x : p.z);
  return ((h & 1u) == 0u ? u : -u) + ((h & 2u) == 0u ? v : -v);
}

float gradientNoise(vec3 place) {
  vec3 cell = floor(place);
  vec3 p = place - cell;
  uvec3 first = uvec3(ivec3(cell));
  vec3 w = p * p * p * (p * (p * 6.0f - 15.0f) + 10.0f);
  vec4 near;
  vec4 far;
  for (uint i = 0u; i < 4u; ++i) {
    uvec3 corner = uvec3(i & 1u, i >> 1, 0u);
    near[i] = latticeTimes(first + corner, p - vec3(corner));
    corner.z = 1u;
    far[i] = latticeTimes(first + corner, p - vec3(corner));
  }
  vec4 across = mix(near, far, w.z);
  vec2 along = mix(across.xy, across.zw, w.y);
  return mix(along.x, along.y, w.x);
}

float computedNoise(vec3 periods) {
  vec3 place = 8.0f * periods;
  float sum = 0.5f * gradientNoise(place) + 0.3f * gradientNoise(2.0f * place + 3.7f) +
              0.2f * gradientNoise(4.0f * place + 9.1f);
  return clamp(0.5f + sum, 0.0f, 1.0f);
}
