// SPDX-License-Identifier: MIT
// Detail under the faces of a surface cloud, the hypertexture of [B08] 6.4: noise eats into the shell
// between the faces and a homogeneous core. How deep a point lies is told by how much cloud is
// around it, in cells over the mesh's box (pass/surface_cells.comp): unlike the distance to the
// nearest face that is smooth in edges and creases, and costs no search.

// Half width, in cells, of the triangle that is taken for the cells' kernel (a box and 1 2 1 in each
// axis) along any direction: their variances, 1/12 + 1/2 and w^2 / 6, are the same.
const real SHELL_KERNEL = real(1.87);

// Depth in kernels under a plane face of a point with the part `filled` of cloud around it; -1 is
// outside. A triangle's integral, inverted.
real shellDepth(real filled) {
  real f = clamp(filled, real(0.0f), real(1.0f));
  return f < real(0.5f) ? sqrt(real(2.0f) * f) - real(1.0f)
                        : real(1.0f) - sqrt(real(2.0f) - real(2.0f) * f);
}

// Part of the core's density at `depth` shells under the surface: 0 outside, 1 from depth 1 on;
// `noise` in [0, 1] moves the edge between, which is `softness` in (0, 1] wide.
real shellDensity(real depth, real noise, real softness) {
  return clamp((depth - (real(1.0f) - softness) * noise) / softness, real(0.0f), real(1.0f));
}
