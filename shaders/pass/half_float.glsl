// SPDX-License-Identifier: MIT
// To the nearest half float, ties to even, of what is finite and at most 65504. Devices may
// truncate on storing, and in packHalf2x16 too (lavapipe does the former, NVIDIA's drivers the
// latter); after this there is nothing left to round.
vec3 roundedToHalf(vec3 v) {
  uvec3 bits = floatBitsToUint(v);
  bits += 0xfffu + (bits >> 13u & 1u);
  vec3 normal = uintBitsToFloat(bits & 0xffffe000u);
  vec3 small = roundEven(v * 16777216.0f) * (1.0f / 16777216.0f);  // multiples of 2^-24
  return mix(normal, small, lessThan(abs(v), vec3(6.103515625e-5f)));
}
