// SPDX-License-Identifier: MIT
// What volumes and surfaces have left in a pixel, of an earlier dispatch. Before: texels.glsl,
// `frameState`, and the same buffer as `frameTexels`.
vec4 stateAt(uint index) {
  if (TEXELS) {
    return uintBitsToFloat(texelFetch(frameTexels, int(index)));
  }
  return frameState[index];
}
