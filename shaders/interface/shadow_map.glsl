// SPDX-License-Identifier: MIT
// One volume in a map of shadows, as 16-byte rows. d: distance (m) along the light from a plane
// across it, before all of the volume.
struct ShadowVolume {
  vec4 origin;           // box position of light ray (u, v) at d: origin + u U + v V + d D
  vec4 acrossU;          // w of these: samples per m, most samples, d of that plane in the map
  vec4 acrossV;          //   0
  vec4 along;
  vec4 extinctionScale;  // per field: extinction (1/m) at value 1
  vec4 weight;           // per field: what counts of its extinction
  vec4 absorbed;         // per field: what of its extinction absorbs, with SHADOW_ABSORBED
  ivec4 rect;            // texels x0, y0, x1, y1 that the volume may cover
  vec4 voxels;           // along the axes
  vec4 atlas[4];         // per field: 1 / texels of the atlas of its bricks
};

struct ShadowConstants {
  uint width;
  uint height;
  uint flags;  // SHADOW_*
  uint unused0;
};

const uint SHADOW_COLOR = 1u;  // as transmittance
const uint SHADOW_LAYER = 2u;  // with the depths between which it rises
const uint SHADOW_HALF = 4u;   // the image has half floats
const uint SHADOW_ABSORBED = 8u;  // of layers also the optical depth of absorption
