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

/** Values of wlkEvalAmbient: 9 coefficients of 3 colours. */
#define WLK_AMBIENT_VALUES 27

/** Light from everywhere but the light itself at a world point, of all orders of scattering in air
 *  and fog and by the ground, as real spherical harmonics of its radiance: 9 coefficients, each
 *  RGB, in the order 1; y, z, x; xy, yz, 3 z^2 - 1, xz, x^2 - y^2 with the usual constants, in the
 *  world's axes and of directions towards where the light comes from. The integral of the radiance
 *  is sqrt(4 pi) times the first; a Lambertian surface's irradiance follows by Ramamoorthi and
 *  Hanrahan 2001. Light that droplets turn within their forward peak counts as the light's own
 *  direction. Volumes are not seen, and wlkEvalSky's radiance has the first order only. Error for
 *  suns above the horizon, of the first coefficient: 2 % in air, 10 % in fog. The point may be as
 *  high as 10 scale heights of air and fog, below the ground counts as on it; the result is 0
 *  without a light. The first call after a change of planet, sky, fog or the light's size takes up
 *  to a second. [C] */
WLK_API WlkResult wlkEvalAmbient(WlkContext context, const double position[3],
                                 double coefficients[WLK_AMBIENT_VALUES]);

/** How often the light has been scattered. Particles do not absorb here, and light that goes
 * straight on (WlkMediumOptics::deltaFraction) was not scattered. */
enum {
  /** Single scattering. */
  WLK_ORDER_SINGLE = 0,
  /** Exactly `order` scatterings, [R04] Eq. 20. */
  WLK_ORDER_INTEGER = 1,
  /** Light scattered at least once over `opticalDepth`: Poisson counts. */
  WLK_ORDER_POISSON = 2
};

typedef struct WlkPhaseQuery {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  WlkMedium medium;
  /** WLK_ORDER_*. Default SINGLE. */
  uint32_t orderKind;
  /** For INTEGER. [1, 1000], default 1. */
  uint32_t order;
  /** For POISSON: optical depth without the part that goes straight on. [0, 1e4], default 1. */
  double opticalDepth;
  uint32_t count;
  uint32_t reserved0;
  /** `count` scattering angles. rad, 0 is forward, [0, pi]. */
  const double* scatteringAngle;
} WlkPhaseQuery;

/** Phase function of a medium, 1/sr: 3 values (RGB) per angle, each channel with integral 1 over
 * the sphere. [C] */
WLK_API WlkResult wlkEvalPhase(WlkContext context, const WlkPhaseQuery* query, double* phase);

/** Scattering angles (rad) of one channel (0..2) of a medium for `count` random numbers in [0, 1),
 *  by inversion, and the density per sr at each: the value of wlkEvalPhase. `density` may be null.
 *  [C] */
WLK_API WlkResult wlkSamplePhase(WlkContext context, WlkMedium medium, uint32_t channel,
                                 uint32_t count, const double* random, double* scatteringAngle,
                                 double* density);

#ifdef __cplusplus
}
#endif

#endif
