// SPDX-License-Identifier: MIT
// What passes over a surface's triangles do: those of the mesh, then in a dispatch of their own the
// large ones that were found. Before: surface_mesh.glsl, `surfaceCross`.
layout(constant_id = 6) const bool LARGE = false;
// The buffer of a view's lists before it holds those: groups of the dispatch along three axes, how
// many triangles asked for one, and which they are.
layout(set = 0, binding = 26, std430) buffer Large { uint large[]; };

bool surfaceLater(uint triangle, uint pixels, uint strips) {
  if (pixels <= SURFACE_LARGE) {
    return false;
  }
  uint number = atomicAdd(large[3], 1u);
  bool room = number < SURFACE_LARGE_MOST;
  if (room) {
    large[SURFACE_LARGE_HEAD + number] = triangle;
    atomicMax(large[0], number + 1u);
    atomicMax(large[2], strips);
  }
  return room;
}

#include "surface_cover.glsl"

void coverSurface() {
  if (LARGE) {
    coverLarge(surface, large[SURFACE_LARGE_HEAD + gl_WorkGroupID.x], gl_WorkGroupID.z,
               gl_LocalInvocationIndex);
  } else {
    coverTriangles(surface, gl_WorkGroupID.xy, gl_LocalInvocationIndex);
  }
}
