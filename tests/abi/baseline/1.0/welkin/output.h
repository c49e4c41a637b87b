/* SPDX-License-Identifier: MIT
 *
 * What the engine gets besides the picture: aerial perspective for its transparents, the volumes'
 * distance, cloud shadows for its surfaces. Part of welkin.h, which states the conventions.
 */
#ifndef WELKIN_OUTPUT_H
#define WELKIN_OUTPUT_H

#include "core.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ------------------------------------------------------------------------- aerial perspective */

/** Froxels of a view, for the engine's transparents: what air, fog and volumes put between the eye
 *  and each of them, as the composite has it for an opaque pixel there. Columns go through the
 *  middles of width x height equal parts of the picture; slice k = 0 .. depth - 1 lies at
 *  distance * (k / (depth - 1))^exponent from the eye, along the ray. */
typedef struct WlkAerialPerspective {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  /** Columns across the picture. [1, 2048], default 64 x 36. */
  uint32_t width;
  uint32_t height;
  /** Slices; the first is at the eye and says 0 and 1. [2, 1024], default 32. */
  uint32_t depth;
  /** 1: slices are equally far apart; larger: denser towards the eye. [1, 8], default 2. */
  float exponent;
  /** Of the last slice from the eye. m, [1, 1e7], default 32000. */
  float distance;
  uint32_t reserved0;
} WlkAerialPerspective;

/** Gives a view froxels, which wlkVulkanCmdRenderView writes to images that it gets; null takes
 *  them away. The first ones, those after null and another size need wlkPrepare, exponent and
 *  distance do not. [C] Errors:
 *  INVALID_ARGUMENT, WRONG_STATE outside engine-device mode; LIMIT_EXCEEDED by wlkPrepare. */
WLK_API WlkResult wlkSetAerialPerspective(WlkContext context, WlkView view,
                                          const WlkAerialPerspective* aerial);

/* --------------------------------------------------------------------- distance of the volumes */

/** 1: wlkVulkanCmdRenderView may get an image for the volumes' distance, for reprojection and depth
 *  of field; 0, as views begin: it may not. It is the integral of distance x transmittance x
 *  extinction along the ray, up to the opaque surface, over that without the distance: air and fog
 *  do not count, nor does with WLK_SCATTERING_ALL_ORDERS what forward peaks only turn aside. 1
 *  needs wlkPrepare. [C] Errors: INVALID_ARGUMENT, WRONG_STATE outside engine-device mode. */
WLK_API WlkResult wlkSetVolumeDistance(WlkContext context, WlkView view, uint32_t enabled);

/* ------------------------------------------------------------------------------- cloud shadows */

/** A map of what volumes take from a light, for the engine's own surfaces. It holds no depth; the
 *  engine's map of opaque surfaces (WlkLightShadow) is another thing. Volumes are in it, cloud
 *  surfaces are not. */
typedef struct WlkCloudShadow {
  uint64_t id;
} WlkCloudShadow;

/** What a texel says of the volumes that visible (wlkSetLights) parallel light crosses. */
enum {
  /** Optical depth of all of them. R16_SFLOAT or R32_SFLOAT. */
  WLK_CLOUD_SHADOW_OPTICAL_DEPTH = 0,
  /** e to the minus that, RGB; alpha 1. R16G16B16A16_SFLOAT or R32G32B32A32_SFLOAT. */
  WLK_CLOUD_SHADOW_TRANSMITTANCE = 1,
  /** For what stands between or inside them, too. R: optical depth of all of them; G, B: distances
   * d (m, see WlkCloudShadowState) between which it rises evenly: to R * clamp((d - G) / (B - G),
   * 0, 1). Exact for one homogeneous layer, else its mean and spread are those of the extinction;
   *  ends go a texel further, so that linear filters may be used. A sample counts at most 1e6.
   *  A: 0. R16G16B16A16_SFLOAT or R32G32B32A32_SFLOAT. */
  WLK_CLOUD_SHADOW_LAYER = 2
};

/** An orthographic map along the direction of a light. Texels keep their places in the world while
 *  the light stands still: the middle moves in steps of a texel. Volumes of any height count. */
typedef struct WlkCloudShadowInfo {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  /** Texels. [1, 8192], default 512 x 512. */
  uint32_t width;
  uint32_t height;
  /** WLK_CLOUD_SHADOW_*. Default OPTICAL_DEPTH. */
  uint32_t content;
  /** Index in wlkSetLights. [0, WlkCapabilities::maxLights - 1], default 0. */
  uint32_t light;
  /** What the middle shows, for example the eye. World, m, |x| <= 1e9. Default 0. */
  double center[3];
  /** Edges of the area, across the light. m, [1, 1e7], default 20000. */
  double extent[2];
  /** Most samples of a volume along the light; one per voxel are taken if that suffices. [8, 4096],
   *  default 512. */
  uint32_t maxSamples;
  uint32_t reserved0;
} WlkCloudShadowInfo;

/** Makes a map; the image is the engine's. [C] Errors: INVALID_ARGUMENT, WRONG_STATE outside
 *  engine-device mode. Needs wlkPrepare. */
WLK_API WlkResult wlkCreateCloudShadow(WlkContext context, const WlkCloudShadowInfo* info,
                                       WlkCloudShadow* map);
/** Changes it, for example where it lies. Only another size or content needs wlkPrepare. [C]
 * Errors: INVALID_HANDLE, INVALID_ARGUMENT. */
WLK_API WlkResult wlkSetCloudShadow(WlkContext context, WlkCloudShadow map,
                                    const WlkCloudShadowInfo* info);
/** Destroys the map, not the images it was written to. [C] Errors: INVALID_HANDLE. */
WLK_API WlkResult wlkDestroyCloudShadow(WlkContext context, WlkCloudShadow map);

/** How to read the map that was recorded last, and what that cost. */
typedef struct WlkCloudShadowState {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  uint64_t frameIndex;
  /** Row-major 3x4: (u, v, d) = M * (x, y, z, 1). u, v: [0, 1] over the map, (0, 0) at the outer
   *  corner of texel (0, 0). d: m along the light, larger is further from it, 0 near `center`. */
  double mapFromWorld[12];
  /** Volumes in it. */
  uint32_t volumes;
  uint32_t barriers;
  uint32_t descriptorWrites;
  /** 1 if commands were recorded, 0 if skipped. */
  uint32_t recorded;
  /** Of the whole map: WLK_REASON_NEEDED, UNCHANGED, and for a map without shadow NO_LIGHT,
   *  NOTHING_TO_DRAW (no volume), ZERO_DENSITY, OUTSIDE_VIEW. */
  uint32_t reason;
  /** Dispatches recorded. */
  uint32_t commands;
  /** Shader invocations (threads) recorded. */
  uint64_t invocations;
  /** GPU time of the newest finished frame, ns; 0 before one finished, and always on a queue
   *  without timestamps. */
  uint64_t gpuTime_ns;
} WlkCloudShadowState;

/** State of the map in the frame that was recorded last. [C] NOT_READY before the first. */
WLK_API WlkResult wlkGetCloudShadowState(WlkContext context, WlkCloudShadow map,
                                         WlkCloudShadowState* state);

#ifdef __cplusplus
}
#endif

#endif
