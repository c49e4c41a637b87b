// SPDX-License-Identifier: MIT
// One surface in one picture, of a view or along a light, as 16-byte rows. Positions in views are
// relative to the eye.
struct SurfaceUniforms {
  // Rows: (mesh position, 1) to the homogeneous vertex of triangle.glsl.
  vec4 pixelX;
  vec4 pixelY;
  vec4 pixelW;
  vec4 depth;      // to its depth, m: along the view's axis, or along the light
  vec4 steps;      // x: depth of step 0; y: steps per m; z: most; w: depths from here count
  ivec4 rect;      // pixels x0, y0, x1, y1 that the surface may cover
  ivec4 shade;     // those that the view's pass runs over
  uvec4 triangle;  // x: how many; y: 1 if the picture is mirrored
  vec4 axis;       // of the view
  // Light map: texel u, v and depth in m of a position, as dot((position, 1), row).
  vec4 lightX;
  vec4 lightY;
  vec4 lightZ;
  vec4 map;        // x: texel, m; y: last level; z: texels along an edge
  // Per metre: extinction, that without the forward peak, depth of the canonical cloud.
  vec4 optics;
  // The map along the local vertical, likewise.
  vec4 upX;
  vec4 upY;
  vec4 upZ;
  vec4 upMap;
  vec4 sky;        // radiance from above, RGB; and from below
  vec4 ground;
  vec4 albedo;     // RGB, of light scattered once
  vec4 orders[8];  // of each set of orders: part of its light that is not absorbed, RGB
  // Detail under the faces: depth (m; 0: none), 1 / depth, softness; w: of a pixel its width as an
  // angle, of a texel in m.
  vec4 detail;
  // Place in the box of cells, [0, 1], of (position, 1) in a view, of (u, v, depth in m, 1) in a
  // light map.
  vec4 cellX;
  vec4 cellY;
  vec4 cellZ;
  vec4 detailScale;  // from that to periods of the noise; w: texels of the noise per m
  vec4 detailShift;  // w: depths of the detail in a cell
  uvec4 cells;       // along the axes
};

// What the surface does in a pixel; depths in steps, so that the order of triangles is all one.
struct SurfaceCover {
  uint front;  // ~ the nearest depth at which a ray enters; 0 where it never does
  uint leave;  // ~ the nearest at which one leaves; 0 likewise
  uint back;   // farthest at which one leaves; 0 where it never does
  int chord;   // depths of leaving less those of entering
};
// As it is counted, zero before: front, leave, of those of leaving but the nearest the farthest,
// and the chord without the nearest of either. Behind the words of all pixels of the picture's
// rectangle each has one more: ~ the depth at which rays end; 0 where they never do.
//
// What the shading leaves in their place for light scattered more than once: what the light of a
// point on the pixel's ray counts in the picture (surface_point.glsl), what detail takes of the
// metres between it and the light, and how far it is from the eye, m. Then second pixels keep that
// light there for those around, RGB, and the distance; 0 where the surface does not cover them.
const uint SURFACE_COVER_WORDS = 4u;
const uint SURFACE_FRONT = 0u;
const uint SURFACE_LEAVE = 1u;
const uint SURFACE_FARTHEST = 2u;
const uint SURFACE_REST = 3u;

// Triangles that a texel of the light map shows, and 1 more: on the lit side and on the other.
struct SurfaceFaces {
  uint lit;
  uint shaded;
};

// Texels of the mesh's images along a row: any device has so many.
const uint SURFACE_MESH_ROW = 4096u;
const uint SURFACE_LANES = 64u;   // triangles of a workgroup
const uint SURFACE_ROW = 32768u;  // workgroups along x
const uint SURFACE_LARGE = 16384u;  // pixels from which on a triangle has its own workgroups
const uint SURFACE_LARGE_HEAD = 4u;  // words before the list of large triangles
const uint SURFACE_LARGE_MOST = 32768u;  // in that list
// One of its workgroups has up to 2^15 pixels; more if there were more than 2^4 of them, but not
// over 2^21, half of what lavapipe would end.
const int SURFACE_STRIP = 15;
const int SURFACE_STRIPS = 4;
const int SURFACE_STRIP_MOST = 21;
const uint SURFACE_CELL = 4u;     // pixels along an edge that one lane lists
// The buffer of a view's lists, in uints: for each list the groups of its dispatch along three
// axes, the first of which serves any length, and how many pixels it has. Then as many pixels, x +
// 65536 y, as the view has: every fourth one along both axes from the front, in their place later
// second pixels that need their own light; from the back those between second pixels. And as many
// again: second pixels between fourth ones from the front, from the back others that need their own
// light.
const uint SURFACE_LIST_FOURTHS = 0u;
const uint SURFACE_LIST_SECONDS = 1u;
const uint SURFACE_LIST_OWN_SECONDS = 2u;
const uint SURFACE_LIST_OTHERS = 3u;
const uint SURFACE_LIST_OWN = 4u;
const uint SURFACE_LISTS = 5u;
const uint SURFACE_LIST_HEAD = 4u * SURFACE_LISTS;
const uint SURFACE_SMALL = 32u;   // pixels that one lane walks alone
const uint SURFACE_TEAM = 8u;     // lanes that
const uint SURFACE_MIDDLE = 1024u;  // walk so many together
const uint SHELL_PIXELS = 4u;     // of the picture that fills the cells, along a cell's edge
const float SHELL_OUTSIDE = 1.5f;  // depth in cells beyond the box, below the surface's 0
const uint SHELL_NOISE = 128u;     // texels of the noise along an edge
const uint SHELL_LEVELS = 8u;      // of it
const uint SHELL_FULL = 1024u;    // what one of them counts in a cell that is all cloud
