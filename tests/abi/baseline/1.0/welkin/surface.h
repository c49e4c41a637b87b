/* SPDX-License-Identifier: MIT
 *
 * Cloud surfaces: homogeneous clouds bounded by a mesh. Part of welkin.h, which states the
 * conventions.
 */
#ifndef WELKIN_SURFACE_H
#define WELKIN_SURFACE_H

#include "core.h"

#ifdef __cplusplus
extern "C" {
#endif

/** A closed mesh and what fills it ([B08]). Nothing is computed from its shape beforehand: a
 * changed mesh, light or place shows in the next frame. Light scattered once is exact along each
 * ray; light scattered more often is that of slabs of the canonical cloud ([B08] 5) which light
 * maps of the mesh choose, exact for slabs of droplets, elsewhere as docs/models.md says (bodies of
 * optical radius 2 to 30: pictures' totals within 24 %, spheres' within 12 %). Of media other than
 * cloud droplets (rain, ice, snow, haze) light is scattered once by their own phase function, more
 * often as by cloud of equal (1 - asymmetry) optical depth. */
typedef struct WlkSurfaceInfo {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  /** Particles inside. Copied: the medium may be destroyed afterwards. */
  WlkMedium medium;
  /** Extinction coefficient inside, for all colours. 1/m, [0, 1e6]. Default 0: nothing is drawn. */
  float extinction;
  /** [4, 12582912]. Default 0. */
  uint32_t vertexCount;
  /** Bytes from one position to the next. [12, 4096], a multiple of 4. Default 12. */
  uint32_t vertexStride;
  /** [4, 4194304]. Default 0. */
  uint32_t triangleCount;
  /** Position of each vertex in the mesh's own frame. x, y, z in m, |x| <= 1e7. Read during the
   * call only. Default null. */
  const float* positions;
  /** Three for each triangle. Closed: each edge is walked as often one way as the other, vertices
   * at equal places counting as one, and encloses a volume. A mesh wound inwards is turned; where
   * it meets itself, densities add. Read during the call only. Default null. */
  const uint32_t* indices;
  /** Row-major 3x4: world = M * (x, y, z, 1). Invertible, its columns 1 mm long or more. Default
   *  identity. */
  double worldFromSurface[12];
} WlkSurfaceInfo;

/** Lumps and fissures under the faces of a surface, which its triangles need not have (a
 * hypertexture, [B08] 8). Noise moves the edge of the cloud inwards, up to `depth` under a face;
 * deeper, and without detail everywhere, the cloud is homogeneous. How deep points lie is found
 * anew in each frame that shows a changed mesh, in cells of 0.8 depths or, in large meshes, wider
 * ones; bumps much smaller than the depth are smoothed away. The pattern goes with the mesh's own
 * axes, not with vertices that move in them. */
typedef struct WlkSurfaceDetail {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  /** How deep the detail reaches at most under a face; a smaller part of a cloud that is not much
   *  thicker. m in the world, [0, 1e6]. Default 0: none. */
  float depth;
  /** Size of the largest lumps; there are smaller ones of a half and a quarter. The pattern repeats
   *  after 8 of them. m in the world, [0, 1e6]. Default 0: twice the depth. */
  float size;
  /** Width of the cloud's edge, of the depth. Small values make hard lumps, 1 wisps. [0.05, 1].
   *  Default 0.3. */
  float softness;
  /** Moves the pattern along the mesh's axes. m in the world, |x| <= 1e7. Default 0. */
  float offset[3];
} WlkSurfaceDetail;

/** Creates a cloud surface; it needs wlkPrepare. Views show it with WLK_LAYER_SURFACES, sorted
 * among the volumes by the nearest points of their boxes. It takes light from the first of the
 * lights that volumes take it from, casts no shadow on others, and is not in aerial perspective for
 *  transparents. [C]
 *  Errors: INVALID_ARGUMENT (extinction, vertexCount, vertexStride, triangleCount, positions,
 *  indices, worldFromSurface), INVALID_HANDLE (medium), OUT_OF_*, WRONG_STATE in CPU mode. */
WLK_API WlkResult wlkCreateSurface(WlkContext context, const WlkSurfaceInfo* info,
                                   WlkSurface* surface);
/** The memory is freed when no frame in flight uses it. [C] Errors: INVALID_HANDLE. */
WLK_API WlkResult wlkDestroySurface(WlkContext context, WlkSurface surface);
/** Moves a surface; as WlkSurfaceInfo::worldFromSurface. [C] Errors: INVALID_HANDLE,
 * INVALID_ARGUMENT. */
WLK_API WlkResult wlkSetSurfaceTransform(WlkContext context, WlkSurface surface,
                                         const double worldFromSurface[12]);
/** Gives a surface detail, or other detail; null takes it away. The first detail of a context takes
 * 17 MB of device memory and some 0.1 s, each up to 8.4 MB: cells as fine as the depth needs in the
 * mesh as it is now. Set it again when positions or transform have made the mesh twice as large.
 * [C] Errors: INVALID_ARGUMENT (depth, size, softness, offset), OUT_OF_*. */
WLK_API WlkResult wlkSetSurfaceDetail(WlkContext context, WlkSurface surface,
                                      const WlkSurfaceDetail* detail);
/** New places of all vertices between the same triangles, for animation; as WlkSurfaceInfo has
 * them. Vertices that were at one place when the surface was created stay together: the place of
 * the last of them counts; those that no triangle uses do not. [C] Errors: INVALID_ARGUMENT
 * (positions; vertexCount other than at creation; vertexStride), OUT_OF_*. */
WLK_API WlkResult wlkSetSurfacePositions(WlkContext context, WlkSurface surface,
                                         const float* positions, uint32_t vertexCount,
                                         uint32_t vertexStride);

#ifdef __cplusplus
}
#endif

#endif
