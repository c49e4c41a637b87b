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
  /** World point. m, |x| <= 1e9. */
  double origin[3];
  /** Unit vector. */
  double direction[3];
  /** Length of the ray. m, > 0, may be infinite; it ends at the ground in any case. */
  double length;
} WlkRay;

/** Rays for wlkEvalSky. */
typedef struct WlkRayBatch {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  /** Number of rays. Default 0. */
  uint32_t count;
  /** sizeof(WlkRay) of the caller. Default that. */
  uint32_t stride;
  /** `count` rays; null only if that is 0. Default null. */
  const WlkRay* rays;
  /** Highest order of scattering of the radiance: 0 for all, 1 for single scattering alone. Default
   *  0. */
  uint32_t maxOrder;
  uint32_t reserved0;
} WlkRayBatch;

/** Air, absorber and fog along rays, by the GPU's model text: in-scattered radiance and
 *  transmittance, 3 values per ray; either output may be null. The radiance is without the sun's
 *  disk and without the ground that the ray may end at; ground's light that air and fog scatter
 *  into the ray belongs to it. Volumes are not seen. In double precision, but the orders after
 *  the first only to 1e-6. Error of the radiance against Monte Carlo with suns 10 degrees high or
 *  more, 90 % of the rays: 1 % in clear air, 2 % in haze, 10 % in thick fog. Cost per ray: 20 us
 *  in clear air, 30 us with fog, 3 to 5 us with maxOrder 1. The first call after a change of
 *  planet, sky, absorber, fog or the light's size takes 0.1 to 0.4 s more unless maxOrder is 1. [C]
 *  Errors: INVALID_ARGUMENT (rays, stride, maxOrder, origin, direction, length), and nothing is
 *  written. */
WLK_API WlkResult wlkEvalSky(WlkContext context, const WlkRayBatch* batch, double* radiance,
                             double* transmittance);

/** Part of the light that air and fog let through between two world points (m, |x| <= 1e9): 3
 *  values in [0, 1], the same both ways. 0 if the planet is between them: the straight line
 *  passes more than 1 m below sea level or, if a point lies below sea level, below the lower
 *  point. Else exactly 1 without air, absorber and fog, and if the points coincide. Volumes are not
 *  seen. Error of the optical depth 0.2 %; cost 1 us. [C]
 *  Errors: INVALID_ARGUMENT (from, to, transmittance), and nothing is written. */
WLK_API WlkResult wlkEvalTransmittance(WlkContext context, const double from[3], const double to[3],
                                       double transmittance[3]);

/** Irradiance of light `lightIndex` on a surface facing it at a world point, after air, absorber
 *  and fog: 3 values, at the wavelengths (wlkGetColorMatrix). [C] Errors: INVALID_ARGUMENT
 * (lightIndex of no light that is set; position, irradiance). */
WLK_API WlkResult wlkEvalLight(WlkContext context, uint32_t lightIndex, const double position[3],
                               double irradiance[3]);

/** Light from everywhere but the light itself at a world point, of all orders of scattering in
 *  air and fog and by the ground, as real spherical harmonics of its radiance: 9 coefficients,
 *  each RGB, in the order 1; y, z, x; xy, yz, 3 z^2 - 1, xz, x^2 - y^2 with the usual constants,
 *  in the world's axes and of directions towards where the light comes from. The integral of the
 *  radiance is sqrt(4 pi) times the first; for the irradiance of a surface see wlkEvalIrradiance.
 *  Light that droplets turn within their forward peak counts as the light's own direction.
 *  Volumes are not seen. Error of the first coefficient for suns above the horizon: 2 % in air,
 *  6 % in haze (vertical optical depth 0.01); in fog (0.2) 10 % with suns of 30 degrees and more,
 *  20 % at 10, 30 % at 2. The point may be as high as 10 scale heights of air and fog, below the
 *  ground counts as on it; the result is 0 without a light. Cost: 1 us, with fog 60 us; the first
 *  call after a change of planet, sky, absorber, fog or the light's size takes 0.1 to 0.4 s more.
 *  [C] Errors: INVALID_ARGUMENT (position, coefficients), and nothing is written. */
WLK_API WlkResult wlkEvalAmbient(WlkContext context, const double position[3],
                                 double coefficients[WLK_AMBIENT_VALUES]);

/** Irradiance on one side of a surface at a world point, RGB, in the unit of the light's
 *  irradiance; `normal` is the unit vector out of that side, either output may be null. `direct`:
 *  the light through air and fog, by the cosine of its disk's centre (0 behind the surface), with
 *  the planet's shadow and its penumbra. `diffuse`: sky and ground, all orders of scattering,
 *  from the harmonics of wlkEvalAmbient (Ramamoorthi and Hanrahan 2001), with a fourth term for
 *  the bright band of the horizon: by it horizontal ground at sea level in air gets what the
 *  sky's own table says, within 0.1 %. Error against wlkEvalSkyMap with suns above the horizon,
 *  any normal: in air 2 % at sea level, 10 % up to 3 km, 25 % higher (surfaces that face up,
 *  where little light is left); in haze 10 % at sea level and 16 % up to 3 km; in and above fog
 *  15 % with suns of 30 degrees and more, 20 % at 10, 30 % at 2. Both are 0 without a light.
 *  Points and cost are those of wlkEvalAmbient; without `diffuse` the point may be anywhere, and
 *  the cost is 1 us. [C]
 *  Errors: INVALID_ARGUMENT (position: NaN, over 1e9 m or, for `diffuse`, too high; normal: not
 *  of length 1 within 1e-3), and nothing is written. */
WLK_API WlkResult wlkEvalIrradiance(WlkContext context, const double position[3],
                                    const double normal[3], double direct[3], double diffuse[3]);

/** A map of all directions for wlkEvalSkyMap. */
typedef struct WlkSkyMapQuery {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  /** World point that the map is around. m, |x| <= 1e9, default the origin; below sea level counts
   *  as on it. */
  double position[3];
  /** Texels per side. [4, 1024], default 32. */
  uint32_t size;
  /** As WlkRayBatch::maxOrder. 0 or 1, default 0. */
  uint32_t maxOrder;
} WlkSkyMapQuery;

/** Radiance from all directions at a world point for image-based lighting, in the unit of the
 *  light's irradiance per sr: the sky, and below the horizon the ground, which reflects light and
 *  sky and is seen through air and fog; not the sun's disk. `rgb` gets size * size texels of 3
 *  floats (`rgbSize` are the bytes there, at least 12 * size * size), row by row, in an octahedral
 * map (Cigolle et al. 2014) with the world's +y in its middle and -y in its corners. Texel (i, j),
 * i along the row, has u = (2 i + 1) / size - 1, v = (2 j + 1) / size - 1 and the direction p / |p|
 * towards where the light comes from:
 *
 *     p = (u, 1 - |u| - |v|, v), and if p.y < 0: p = ((1 - |v|) sign(u), p.y, (1 - |u|) sign(v))
 *
 *  Its solid angle is 4 / (size^2 |p|^3) sr; they sum to 4 pi within 0.1 % from size 8 on. A
 *  texel has the radiance at its centre, or the mean of four points where the horizon crosses it,
 *  with the fog's phase function averaged over it within 15 degrees of the light: made for
 *  lighting, not for looking at. Irradiances by a map of 32 are within 3 % of those by a fine
 *  one in air, 4 % in haze and 7 % in fog. Cost: a ray of wlkEvalSky per texel (32: 15 ms in
 *  clear air, 25 ms with fog), and its first call. 0 without a light. Volumes are not seen. [C]
 *  Errors: INVALID_ARGUMENT (position, size, maxOrder, rgb, rgbSize), and nothing is written. */
WLK_API WlkResult wlkEvalSkyMap(WlkContext context, const WlkSkyMapQuery* query, float* rgb,
                                uint64_t rgbSize);

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

/** Which directions of which medium, and after how many scatterings. */
typedef struct WlkPhaseQuery {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  /** Default {0}, which is refused. */
  WlkMedium medium;
  /** WLK_ORDER_*. Default SINGLE. */
  uint32_t orderKind;
  /** For INTEGER. [1, 1000], default 1. */
  uint32_t order;
  /** For POISSON: optical depth without the part that goes straight on. [0, 1e4], default 1. */
  double opticalDepth;
  /** Number of angles. Default 0. */
  uint32_t count;
  uint32_t reserved0;
  /** `count` scattering angles. rad, 0 is forward, [0, pi]. Default null. */
  const double* scatteringAngle;
} WlkPhaseQuery;

/** Phase function of a medium, 1/sr: 3 values (RGB) per angle, each channel with integral 1 over
 *  the sphere. [C] Errors: INVALID_HANDLE, INVALID_ARGUMENT (orderKind, order, opticalDepth,
 *  scatteringAngle, phase). */
WLK_API WlkResult wlkEvalPhase(WlkContext context, const WlkPhaseQuery* query, double* phase);

/** Scattering angles (rad) of one channel (0..2) of a medium for `count` random numbers in [0, 1),
 *  by inversion, and the density per sr at each: the value of wlkEvalPhase. `density` may be null.
 *  [C] Errors: INVALID_HANDLE, INVALID_ARGUMENT (channel, random, scatteringAngle). */
WLK_API WlkResult wlkSamplePhase(WlkContext context, WlkMedium medium, uint32_t channel,
                                 uint32_t count, const double* random, double* scatteringAngle,
                                 double* density);

#ifdef __cplusplus
}
#endif

#endif
