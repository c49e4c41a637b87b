// SPDX-License-Identifier: MIT
// Perlin's gradient noise (1985, its curve and edges of 2002) computed at a point, SHELL_OCTAVES of
// it: the noise that [B08] 8 evaluates. In no shipped pass. Corners four at a time, what they share
// computed once.

#ifndef SHELL_OCTAVES
#define SHELL_OCTAVES 3
#endif

const uvec3 LATTICE = uvec3(1597334677u, 3812015801u, 2798796415u);

// Four corners' gradients, each to one of the twelve edges' middles of a cube, times x, y, z.
vec4 latticeTimes(uvec4 corner, vec4 x, vec4 y, float z) {
  uvec4 h = ((corner ^ (corner >> 15)) * 2246822519u) >> 28;
  vec4 u = mix(y, x, lessThan(h, uvec4(8u)));
  vec4 v = mix(mix(vec4(z), x, equal(h & 13u, uvec4(12u))), y, lessThan(h, uvec4(4u)));
  vec4 one = mix(-u, u, equal(h & 1u, uvec4(0u)));
  return one + mix(-v, v, equal(h & 2u, uvec4(0u)));
}

float gradientNoise(vec3 place) {
  vec3 cell = floor(place);
  vec3 p = place - cell;
  uvec3 c = uvec3(ivec3(cell)) * LATTICE;
  uvec4 column = uvec4(c.x, c.x + LATTICE.x, c.x, c.x + LATTICE.x) ^
                 uvec4(c.y, c.y, c.y + LATTICE.y, c.y + LATTICE.y);
  vec4 x = vec4(p.x, p.x - 1.0f, p.x, p.x - 1.0f);
  vec4 y = vec4(p.y, p.y, p.y - 1.0f, p.y - 1.0f);
  vec3 w = p * p * p * (p * (p * 6.0f - 15.0f) + 10.0f);
  vec4 across = mix(latticeTimes(column ^ c.z, x, y, p.z),
                    latticeTimes(column ^ (c.z + LATTICE.z), x, y, p.z - 1.0f), w.z);
  vec2 along = mix(across.xy, across.zw, w.y);
  return mix(along.x, along.y, w.x);
}

// Octaves of half the size and weight each, the weights adding up to 1, the first one's lumps as
// large as those of src/tables/detail_noise.
float computedNoise(vec3 periods) {
  vec3 place = 8.0f * periods;
  float weight = 1.0f / (2.0f - exp2(1.0f - float(SHELL_OCTAVES)));
  float sum = 0.5f;
  for (int i = 0; i < SHELL_OCTAVES; ++i) {
    sum += weight * gradientNoise(place);
    place = 2.0f * place + 3.7f;
    weight *= 0.5f;
  }
  return clamp(sum, 0.0f, 1.0f);
}
