// SPDX-License-Identifier: MIT
// What a pixel's shading leaves for light scattered more than once, one row of the cover: what its
// point's light counts in the picture in two words, three times 18 bits and the exponent of the
// most, 4e-6 of which they miss; then two floats.

uvec4 surfacePointRow(vec3 weight, float lost, float range) {
  // Below 2^-103 they miss more, from 2^-121 on all.
  uint exponent =
      max(floatBitsToUint(max(max(weight.x, weight.y), weight.z)) >> 23, 24u);  // + 127
  float scale = uintBitsToFloat((271u - exponent) << 23);
  uvec3 part = uvec3(min(weight * scale + 0.5f, vec3(262143.0f)));
  return uvec4(part.x | (part.y << 18), (part.y >> 14) | (part.z << 4) | (exponent << 22),
               floatBitsToUint(lost), floatBitsToUint(range));
}

vec3 surfacePointWeight(uvec4 row) {
  float scale = uintBitsToFloat(((row.y >> 22) - 17u) << 23);
  return scale * vec3(row.x & 0x3ffffu, (row.x >> 18) | ((row.y & 15u) << 14),
                      (row.y >> 4) & 0x3ffffu);
}
