// SPDX-License-Identifier: MIT
// One surface in one picture, of a view or along a light, as 16-byte rows.
struct SurfaceUniforms {
  // Rows: (mesh position, 1) to the homogeneous vertex of triangle.glsl.
  vec4 pixelX;
  vec4 pixelY;
  vec4 pixelW;
  vec4 depth;      // to its depth: pixelW, or the distance along a light, m
  vec4 steps;      // x: depth of step 0; y: steps per m; z: most; w: depths from here on count
  ivec4 rect;      // pixels x0, y0, x1, y1 that the surface may cover
  uvec4 triangle;  // x: how many
};

// What the surface does in a pixel, zero before; depths in steps, so that the order of triangles is
// all one.
struct SurfaceCover {
  uint front;  // ~ the nearest depth at which a ray enters; 0 where it never does
  uint back;   // farthest at which one leaves; 0 where it never does
  int chord;   // depths of leaving less those of entering
  int net;     // how often it leaves less how often it enters: of rays from outside 0
};
