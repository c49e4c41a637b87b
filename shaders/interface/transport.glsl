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
// number l l + l + m, mean square 1. In a layer, around whose normal they are, Y(4, 0), Y(4, 1) and
// Y(4, 2) take the places of Y(3, -3) to Y(3, -1): an even layer's light has none of what is odd
// across the light's plane, and needs degree 4 for views of some 60 degrees.
const int TRANSPORT_TERMS = 16;
const int LAYER_FOURTH = 9;  // the number of Y(4, 0) in a layer; Y(4, 1) and Y(4, 2) follow
// Of light scattered once and twice, over the phase functions: 9 harmonics of degree < 3, or 12
// functions of a layer: for each side of its plane (first those with a positive z) values in
// LAYER_RINGS rings of directions, between which it is a polynomial in |z|; then x and y of both
// sides.
const int FIRST_TERMS = 12;
const int LAYER_RINGS = 4;  // of a side, at the nodes of a Gauss quadrature
const int LAYER_TURNS = 6;  // directions of a ring
// A layer's responses, over those of no direction: in zenith angles i / (n - 1) pi and azimuths
// from the light k / (n - 1) pi.
const int RESPONSE_ZENITHS = 48;
const int RESPONSE_AZIMUTHS = 24;
// Nodes of the pair table over the scattering angle, for each (l, m >= 0) of degree < 3.
const int PAIR_TABLE_NODES = 128;

const uint TRANSPORT_GROUP = 64u;  // threads

const int FIRST_ROWS = TRANSPORT_DIRECTIONS * 4;
const int SECOND_ROWS = TRANSPORT_DIRECTIONS * 7;

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
  // Of the directions: harmonics; then, from FIRST_ROWS, what they add to the terms of the light
  // scattered once; from SECOND_ROWS twice. Where harmonics are these terms, the former holds
  // instead the source of light scattered twice from the terms of that scattered once, and in the
  // last row's w 1 / the phase function twice.
  vec4 rows[TRANSPORT_DIRECTIONS * 10 + 1];
  // Of the phase function, once and twice, between two harmonics: row l * 3 + l', m in xyz.
  vec4 products[24];
  vec4 lightFrame[3];             // world to the frame of the harmonics, rows
  vec4 travel;                    // of the light in that frame; w: 1 in a layer
  vec4 worldFromBox[3];           // columns, without the translation
  vec4 gridOrigin;                // of the grid in the unit box, which it may exceed
  vec4 gridSize;
  vec4 extinctionScale;           // per field: extinction (1/m) at value 1
  vec4 fieldMoments[4];           // per field: albedo * moments of what is not in the peak
  vec4 fieldFourth;               // per field: the moment of degree 4, of the same
  // Extinction without the peak over extinction; samples per half cell and axis.
  vec4 peak;
  vec4 voxels;                             // along the axes
  vec4 atlas[4];         // per field: 1 / texels of the atlas of its bricks
};

struct TransportPush {
  uint level;
  uint flags;  // TRANSPORT_*
  uint first;  // row of groups, or group, that the dispatch begins with
  // Of what is shown towards the eye; the rest is what the dispatch before has written.
  float weight;
};

const uint TRANSPORT_FIRST_SWEEP = 1u;   // of light scattered once
const uint TRANSPORT_SECOND_SWEEP = 2u;  // of light scattered twice
const uint TRANSPORT_COARSER = 4u;       // adds the correction of the level below
