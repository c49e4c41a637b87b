// SPDX-License-Identifier: MIT
// Light of sky and ground inside a volume, in red, green and blue at once, on a grid of cells as in
// transport.glsl: 16-byte rows that its passes share.
const int AMBIENT_DIRECTIONS = TRANSPORT_COARSE_DIRECTIONS;

// Zenith angles from the world's y axis and azimuths from x to z, in middles of equal parts.
const int FINE_ZENITHS = 16;
const int FINE_AZIMUTHS = 16;

struct AmbientUniforms {
  ivec4 size[TRANSPORT_LEVELS];   // cells along the box's axes, and in all
  ivec4 place[TRANSPORT_LEVELS];  // x: first cell of the level in lists that hold all levels
  TransportDirection directions[TRANSPORT_LEVELS * AMBIENT_DIRECTIONS];
  vec4 harmonics[AMBIENT_DIRECTIONS * 4];  // of the directions, in the world's axes
  vec4 incoming[AMBIENT_DIRECTIONS];       // radiance that comes in along each, RGB
  // What an unshaded cell scatters in each direction by degrees over 3, RGB.
  vec4 fine[FINE_ZENITHS * FINE_AZIMUTHS];
  vec4 worldFromBox[3];                    // columns, without the translation
  vec4 gridOrigin;                         // of the grid in the unit box, which it may exceed
  vec4 gridSize;
  vec4 voxels;                             // along the axes
  vec4 atlas[4];         // per field: 1 / texels of the atlas of its bricks
  vec4 extinctionScale;  // per field: extinction (1/m) at value 1
  // Per field and degree, RGB: albedo * moment of what is not in the peak.
  vec4 moments[16];
  // Extinction without the peak over extinction; samples per half cell and axis.
  vec4 peak;
};

struct AmbientPush {
  uint level;
  uint flags;  // AMBIENT_*
  uint unused0;
  uint unused1;
};

const uint AMBIENT_INCOMING = 1u;  // rays come in with the light outside, else with none
const uint AMBIENT_COARSER = 2u;   // adds the correction of the level below
const uint AMBIENT_ALONE = 8u;     // light that was not scattered: its share of that outside
const uint AMBIENT_WHOLE = 4u;     // scatters by the whole phase function, peak included
