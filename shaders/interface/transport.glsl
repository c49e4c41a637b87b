// SPDX-License-Identifier: MIT
// Light inside a volume on a grid of cells, as 16-byte rows: what its passes share.
//
// The grid has levels, each half as fine along every axis. Rays of a direction meet slices of cells
// across its main axis; ray (i, j) stands at (i + k u, j + k v) in slice k, modulo the grid's size:
// one that leaves through a side goes on as a ray that enters through the opposite one.
const int TRANSPORT_LEVELS = 4;
const int TRANSPORT_DIRECTIONS = 50;         // at most, on the two finest levels
const int TRANSPORT_COARSE_DIRECTIONS = 26;  // the first of them: on all others
// Real spherical harmonics of degree < 4 around the direction in which light travels: Y(l, m) is
// number l l + l + m, mean square 1.
const int TRANSPORT_TERMS = 16;
// Of degree < 3: of light scattered once.
const int FIRST_TERMS = 9;
// Nodes of the pair table over the scattering angle, for each (l, m >= 0) of degree < 3.
const int PAIR_TABLE_NODES = 128;

struct TransportDirection {
  vec4 step_;   // u, v: cells per slice; path per slice (m); weight
  ivec4 axes;   // main axis, u, v, 1 or -1 along the main axis
};

struct TransportUniforms {
  ivec4 size[TRANSPORT_LEVELS];   // cells along the box's axes, and in all
  // x: first cell of the level in lists that hold all levels; y: number of its directions.
  ivec4 place[TRANSPORT_LEVELS];
  TransportDirection directions[TRANSPORT_LEVELS * TRANSPORT_DIRECTIONS];
  TransportDirection light;       // the light's own, at twice the resolution
  vec4 harmonics[TRANSPORT_DIRECTIONS * 4];  // of the directions
  // Of the phase function, once and twice, between two harmonics: row l * 3 + l', m in xyz.
  vec4 products[24];
  // Source of light scattered twice in each direction, from the terms of that scattered once; in
  // the last row's w 1 / the phase function twice.
  vec4 directed[TRANSPORT_DIRECTIONS * 3];
  vec4 lightFrame[3];             // world to the frame of the harmonics, rows
  vec4 worldFromBox[3];           // columns, without the translation
  vec4 gridOrigin;                // of the grid in the unit box, which it may exceed
  vec4 gridSize;
  vec4 extinctionScale;           // per field: extinction (1/m) at value 1
  vec4 fieldMoments[4];           // per field: albedo * moments of what is not in the peak
  // Extinction without the peak over extinction; samples per half cell and axis.
  vec4 peak;
  vec4 voxels;                             // along the axes
  vec4 atlas[4];         // per field: 1 / texels of the atlas of its bricks
};

struct TransportPush {
  uint level;
  uint flags;  // TRANSPORT_*
  uint unused0;
  uint unused1;
};

const uint TRANSPORT_FIRST_SWEEP = 1u;   // of light scattered once
const uint TRANSPORT_SECOND_SWEEP = 2u;  // of light scattered twice
const uint TRANSPORT_COARSER = 4u;       // adds the correction of the level below
