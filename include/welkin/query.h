/* SPDX-License-Identifier: MIT
 *
 * Queries answered on the CPU. Part of welkin.h, which states the conventions.
 */
#ifndef WELKIN_QUERY_H
#define WELKIN_QUERY_H

#include "scene.h"

#ifdef __cplusplus
extern "C" {
#endif

/** Rays for wlkEvalSky. */
typedef struct WlkRay {
  /** World point. m. */
  double origin[3];
  /** Unit vector. */
  double direction[3];
  /** Length of the ray. m, > 0, may be infinite; it ends at the ground in any case. */
  double length;
} WlkRay;

typedef struct WlkRayBatch {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  uint32_t count;
  /** sizeof(WlkRay) of the caller. Default that. */
  uint32_t stride;
  const WlkRay* rays;
} WlkRayBatch;

/** Air and fog along rays, by the same model text as the GPU, in double precision: in-scattered
 *  radiance (without the sun's disk and the ground) and transmittance, 3 values per ray; either
 *  output may be null. Volumes are not seen. [C] */
WLK_API WlkResult wlkEvalSky(WlkContext context, const WlkRayBatch* batch, double* radiance,
                             double* transmittance);

/** Irradiance of light `lightIndex` on a surface facing it at a world point, after air and fog:
 *  3 values. [C] */
WLK_API WlkResult wlkEvalLight(WlkContext context, uint32_t lightIndex, const double position[3],
                               double irradiance[3]);

/** Phase function of a medium, 1/sr, for `count` scattering angles (rad, 0 is forward, [0, pi]);
 *  integrates to 1 over the sphere. Needs no context. [F] */
WLK_API WlkResult wlkEvalPhase(const WlkMediumInfo* medium, uint32_t count,
                               const double* scatteringAngle, double* phase);

#ifdef __cplusplus
}
#endif

#endif
