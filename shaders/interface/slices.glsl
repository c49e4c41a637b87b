// SPDX-License-Identifier: MIT
// One volume's constants in one view, as 16-byte rows. "Plane coordinate" c counts slabs along the
// slicing axis: slab k lies between c = k and c = k + 1.
struct VolumeUniforms {
  mat4 boxFromEye;       // position relative to the eye to the unit box
  vec4 lightU;           // light-buffer u = dot(p, xyz) + w, p relative to the eye
  vec4 lightV;           // light-buffer v
  vec4 plane;            // plane coordinate c = dot(p, xyz) + w
  vec4 texelOrigin;      // box position of light texel ray (u, v) at c: origin + u A + v B + c C
  vec4 texelA;           //   w of these four: extinction without the peaks over extinction, light
                         //   path per slab (m), slab count, step (m)
  vec4 texelB;
  vec4 texelC;
  vec4 middle;           // of the box, relative to the eye; step of the march through it all (m)
  vec4 extinctionScale;  // per field: extinction (1/m) at value 1
  vec4 meanAlbedo;       // per field
  vec4 albedo[4];        // per field RGB
  vec4 rect;             // pixels x0, y0, x1, y1 of the eye pass
  vec4 gridScale;        // unit box to cells of the light grid: scale (w: 1 in a layer), offset
  vec4 gridOffset;
  vec4 gridEnd;          // last cell's middle; 1 / edge of its image
  vec4 gridNormal;       // of a layer's plane
  vec4 flatStretches;    // of a ray in a flat volume, from face to face along each axis
  vec4 voxels;           // along the axes
  vec4 atlas[4];         // per field: 1 / texels of the atlas of its bricks
  vec4 ambientScale;     // the same of the grid for the light of sky and ground
  vec4 ambientOffset;
  vec4 ambientEnd;
  // 4 pi times the phase function twice, mean of the colours, at scattering angles i / 31 pi.
  vec4 pairShape[8];
  vec4 forwardFraction[32];  // F(n) per depth node; component = field
};

struct SliceConstants {
  uint firstSlab;
  uint slabCount;
  uint flags;  // SLICE_*
  uint lightSize;
};

// What the march's rays belong to: pixels, froxels, every fourth or second pixel along both axes,
// pixels of a list. After every fourth pixel, a spread and a list are of every second one; then, or
// at once, they are of each.
const uint RAYS_OF_PIXELS = 0u;
const uint RAYS_OF_FROXELS = 1u;
const uint RAYS_OF_GRID = 2u;
const uint RAYS_OF_LIST = 3u;
const uint SPREAD_TO_SECONDS = 0u;
const uint SPREAD_TO_PIXELS = 1u;
// The buffer of every second pixel and of the lists. In uints: for the lists of second pixels, of
// pixels, of tiles in which something may be seen and of the others the dispatch's groups along
// three axes and the list's length, then the draw of rows of tiles; then, 8 for each second pixel
// of the view, row by row with two more than half of its pixels in each, radiance and
// transmittance, where the ray ends (m) and what the volumes' distance needs (without depth and
// distance only the first 4); then the list of second pixels or pixels in use, x + 65536 y. Behind
// the longest of those, of each tile: the number of the last march that saw anything in it; the
// list of tiles, x + 65536 y, that of the others from its end on; rows of tiles, x + 2^12 y +
// 2^24 (length - 1).
const uint LIST_SIZE = 4u;
const uint TILE_LIST = 8u;
const uint CLEAR_LIST = 12u;
const uint TILE_DRAW = 16u;
const uint LIST_HEAD = 20u;
const uint SECOND_SIZE = 8u;
const uint LIST_MOST = 3u;     // entries for each second pixel
const uint TILE_SECONDS = 8u;  // second pixels along a tile's edge
const uint TILE_WORDS = 3u;    // for each tile
const uint TILE_PARTS = 8u;    // invocations for each listed tile
const uint ROW_TILES = 8u;     // of a row that is drawn, at most
const uint ROW_Y = 1u << 12u;
const uint ROW_LENGTH = 1u << 24u;
const uint ROW_CORNERS = 6u;   // of its two triangles
const uint LIST_ROW = 16u;  // groups of the list's dispatch along x
const uint SPREAD_COLUMNS = 2u;
const uint SPREAD_CELLS = 4u;  // cells of four pixels, one below the other, of an invocation

const uint SLICE_FIRST_BATCH = 1u;
const uint SLICE_LAST_BATCH = 2u;
const uint SLICE_FIRST_VOLUME = 4u;
const uint SLICE_SECONDS = 8u;  // the grid or the list is of every second pixel
const uint SLICE_MARCH = 256u;  // times the march's number, from 1
