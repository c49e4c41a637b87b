/* SPDX-License-Identifier: MIT
 *
 * What was recorded for a view, what it cost, and how far it may be off. Part of welkin.h, which
 * states the conventions.
 */
#ifndef WELKIN_STATISTICS_H
#define WELKIN_STATISTICS_H

#include "core.h"

#ifdef __cplusplus
extern "C" {
#endif

enum {
  /** Light that reaches each slab of a volume. */
  WLK_PASS_LIGHT_SLICES = 1,
  /** What the eye sees of a volume. */
  WLK_PASS_EYE_SLICES = 2,
  /** Sky, fog and all others over the engine's picture. */
  WLK_PASS_COMPOSITE = 3,
  /** Light of the sky scattered more than once, by direction. */
  WLK_PASS_SKY_TABLE = 4,
  /** Light inside a volume that was scattered before (WLK_SCATTERING_ALL_ORDERS). */
  WLK_PASS_VOLUME_LIGHT = 5,
  /** A map of what volumes take from a light: a WlkCloudShadow, or the view's own. */
  WLK_PASS_CLOUD_SHADOW = 6,
  /** Light of sky and ground inside a volume (wlkSetAmbient). */
  WLK_PASS_VOLUME_AMBIENT = 7,
  /** Aerial perspective for the engine's transparents, its march through volumes included. */
  WLK_PASS_AERIAL_PERSPECTIVE = 8,
  /** The volumes' mean distance per pixel (welkin_vulkan.h). */
  WLK_PASS_VOLUME_DISTANCE = 9,
  /** Of a cloud surface: its light maps, and what pixels see of it. */
  WLK_PASS_SURFACE_LIGHT = 10,
  WLK_PASS_SURFACE = 11
};

/** Why a pass was recorded or not. */
enum {
  /** Recorded: the picture depends on it. */
  WLK_REASON_NEEDED = 0,
  /** WlkViewInfo::layers is without it. */
  WLK_REASON_LAYER_OFF = 1,
  /** There is nothing of its kind. */
  WLK_REASON_NOTHING_TO_DRAW = 2,
  /** No value above 0, or an extinction of 0. */
  WLK_REASON_ZERO_DENSITY = 3,
  /** The camera does not see it. */
  WLK_REASON_OUTSIDE_VIEW = 4,
  /** No light reaches it. */
  WLK_REASON_NO_LIGHT = 5,
  /** Recorded for WLK_QUALITY_FLAG_NO_SKIP alone. */
  WLK_REASON_NO_SKIP_FLAG = 6,
  /** What the pass depends on is as in an earlier frame, whose result is used. */
  WLK_REASON_UNCHANGED = 7,
  /** A part is computed, or complete light fades in (WlkQuality::lightFrames). */
  WLK_REASON_SPREAD = 8
};

/** One line of the plan: a pass over one volume (or over the picture), all its batches together. */
typedef struct WlkPassStats {
  /** "light slices" and so on. */
  char name[WLK_NAME_SIZE];
  /** WLK_PASS_*. */
  uint32_t pass;
  /** 1 if commands were recorded, 0 if skipped. */
  uint32_t recorded;
  /** WLK_REASON_*. */
  uint32_t reason;
  /** Dispatches or draws recorded. */
  uint32_t commands;
  /** The volume or the cloud surface that it is about; {0} where it is about none. */
  WlkVolume volume;
  WlkSurface surface;
  /** Shader invocations (threads) recorded; not those of pixels and tiles that shaders put on a
   *  list, whose number the host does not know. */
  uint64_t invocations;
  /** GPU time of the newest finished frame, ns; 0 before one finished, and always on a queue
   *  without timestamps. */
  uint64_t gpuTime_ns;
} WlkPassStats;

/** What was recorded for a view's frame, and what the context holds. */
typedef struct WlkFrameStats {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  uint64_t frameIndex;
  uint32_t dispatches;
  uint32_t draws;
  uint32_t barriers;
  uint32_t descriptorWrites;
  uint64_t bytesUploaded;
  /** Bytes of device memory and of host memory that the context holds. */
  uint64_t deviceMemory;
  uint64_t hostMemory;
  /** Pixels and froxels of the newest finished frame not finite before the final guard. */
  uint64_t nonFinitePixels;
} WlkFrameStats;

/** Statistics of the view's last recorded frame. `passCount` holds the room in `passes` and
 *  receives the number of passes; `stride` is the caller's sizeof(WlkPassStats); `passes` may be
 *  null. [C] NOT_READY before the first frame, INCOMPLETE if the array was too short. Errors:
 *  INVALID_ARGUMENT (stride too short). */
WLK_API WlkResult wlkGetFrameStats(WlkContext context, WlkView view, WlkFrameStats* stats,
                                   uint32_t* passCount, uint32_t stride, WlkPassStats* passes);

/** "WLK_REASON_ZERO_DENSITY" and so on. [F] */
WLK_API const char* wlkReasonName(uint32_t reason);

/* --------------------------------------------------------------------------- estimate of error */

/** What keeps a picture from the truth. */
enum {
  /** Sky light: with WLK_SCATTERING_SINGLE what was scattered more than once or by the ground. */
  WLK_APPROXIMATION_SKY = 0,
  /** Light scattered more than once in the fog layer. */
  WLK_APPROXIMATION_FOG = 1,
  /** Light inside volumes; their shadows on air and ground, ambient light: where left out. */
  WLK_APPROXIMATION_VOLUME_SCATTERING = 2,
  /** Slabs and light-buffer texels. */
  WLK_APPROXIMATION_VOLUME_SLICES = 3
};
#define WLK_MAX_APPROXIMATIONS 8

/** Relative errors of the radiance against all orders of scattering: root mean square over the
 *  picture's pixels and colours of (radiance - truth) / truth, without opaque surfaces. Cloud
 * surfaces are not in it, nor does WLK_CONTROL_ERROR look at them. */
typedef struct WlkErrorEstimate {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  /** All approximations together, [0, 1]. */
  float relativeError;
  /** WLK_APPROXIMATION_* of the largest part. */
  uint32_t dominant;
  /** By WLK_APPROXIMATION_*; relativeError is the root of the sum of their squares, at most 1. */
  float part[WLK_MAX_APPROXIMATIONS];
} WlkErrorEstimate;

/** Estimates the error of the view's next frame from the scene, the camera and the quality: rules
 *  fitted to measurements (docs/accuracy-and-performance.md), right within a factor of 2 for most
 *  scenes, the part of the slabs within 4. A volume in an engine's image counts as filled with 1,
 *  uploads by parts as if the rest kept its mean. Renders nothing. [C] Errors: INVALID_HANDLE,
 *  UNKNOWN_STRUCT. */
WLK_API WlkResult wlkGetErrorEstimate(WlkContext context, WlkView view, WlkErrorEstimate* estimate);

/** "WLK_APPROXIMATION_SKY" and so on. [F] */
WLK_API const char* wlkApproximationName(uint32_t approximation);

#ifdef __cplusplus
}
#endif

#endif
