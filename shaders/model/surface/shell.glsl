// SPDX-License-Identifier: MIT
// Detail under the faces of a surface cloud, the hypertexture of [B08] 8: noise eats into the
// shell between the faces and a homogeneous core. How deep a point lies is told by how much cloud
// is around it, in cells over the mesh's box (pass/surface_cells.comp): unlike the distance to the
// nearest face that is smooth in edges and creases, and costs no search.

// Cells that the detail reaches at least. Means over a cell and its neighbours (1 2 1 in each axis)
// tell depths up to there: under a plane face across an axis within 0.02 cells, in other directions
// within 0.17.
const real SHELL_CELLS = real(1.25f);

// Depth in cells, [-1.5, 1.5], of a point with the part `filled` of cloud around it: what the
// kernel has under a face across an axis, inverted.
real shellDepth(real filled) {
  real f = clamp(filled, real(0.0f), real(1.0f));
  real inner = real(2.0f) * f - real(1.0f);
  real outer = f < real(0.5f) ? real(4.0f) * f - real(1.5f) : real(4.0f) * f - real(2.5f);
  return abs(inner) < real(0.5f) ? inner : outer;
}

// Part of the core's density at `depth` shells under the surface: 0 outside, 1 from depth 1 on;
// `noise` in [0, 1] moves the edge between, which is `softness` in (0, 1] wide.
real shellDensity(real depth, real noise, real softness) {
  return clamp((depth - (real(1.0f) - softness) * noise) / softness, real(0.0f), real(1.0f));
}
