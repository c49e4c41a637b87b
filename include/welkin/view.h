/* SPDX-License-Identifier: MIT
 *
 * Views, frames and their statistics. Part of welkin.h, which states the conventions.
 */
#ifndef WELKIN_VIEW_H
#define WELKIN_VIEW_H

#include "core.h"

#ifdef __cplusplus
extern "C" {
#endif

enum {
  /** Write colour * transmittance + radiance to a storage image (or over the input image). */
  WLK_COMPOSITE_COMPUTE = 0,
  /** Blend onto the engine's colour attachment with dual-source blending. */
  WLK_COMPOSITE_BLEND = 1,
  /** Write premultiplied radiance and RGB transmittance to two images; the engine composites. */
  WLK_COMPOSITE_SEPARATE = 2
};

/** Layers of a view: what it shows. What is not shown still takes part in the light of the rest. */
enum {
  /** Light that air and absorber scatter and take away (wlkSetSky). */
  WLK_LAYER_SKY = 1u << 0,
  /** The same of fog (wlkSetFog). */
  WLK_LAYER_FOG = 1u << 1,
  WLK_LAYER_VOLUMES = 1u << 2,
  /** Disks of the lights, where the engine drew nothing; with WLK_LAYER_SKY and wlkSetSky only. */
  WLK_LAYER_SUN_DISK = 1u << 3,
  /** The bare planet, where the engine drew nothing; with WLK_LAYER_SKY and wlkSetSky only. */
  WLK_LAYER_GROUND = 1u << 4,
  /** Cloud surfaces (surface.h). */
  WLK_LAYER_SURFACES = 1u << 5,
  /** All that the library has, those of newer ones included. With layers taken away by & ~ it is
   *  all others. */
  WLK_LAYER_ALL = 0x7fffffff
};

/** Formats of the images that views write. */
enum {
  /** VK_FORMAT_R16G16B16A16_SFLOAT. */
  WLK_TARGET_RGBA16_FLOAT = 1,
  /** VK_FORMAT_R32G32B32A32_SFLOAT. */
  WLK_TARGET_RGBA32_FLOAT = 2,
  /** VK_FORMAT_B10G11R11_UFLOAT_PACK32. */
  WLK_TARGET_B10G11R11_FLOAT = 3
};

/** What the three channels of the radiance are. Transmittance is per channel in any case. */
enum {
  /** Radiance at 680, 550 and 440 nm. */
  WLK_COLOR_WAVELENGTHS = 0,
  /** Linear sRGB (Rec. 709, D65) of the whole spectrum that these three stand for. Irradiance 1, 1,
   *  1 is then sunlight outside the atmosphere: luminance 1, colour (1.098, 0.977, 0.940). Colours
   *  outside the gamut are cut off at 0. */
  WLK_COLOR_LINEAR_SRGB = 1
};

/** The column-major 3x3 matrix from radiance at 680, 550 and 440 nm to WLK_COLOR_*: for what
 * queries return (wlkEvalLight, wlkEvalIrradiance, wlkEvalAmbient, wlkEvalSkyMap and wlkEvalSky are
 * always at the wavelengths), so that engines' objects are lit in the colours of the picture.
 * Results below 0 are cut off there. [F] Errors: INVALID_ARGUMENT (colorSpace, matrix). */
WLK_API WlkResult wlkGetColorMatrix(uint32_t colorSpace, double matrix[9]);

/** A picture that is drawn again and again: its size, and how it reaches the engine's. */
typedef struct WlkViewInfo {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  /** Pixels. [1, 16384], default 1280 x 720. */
  uint32_t width;
  uint32_t height;
  /** WLK_COMPOSITE_*. Default COMPUTE. Headless contexts take COMPUTE and SEPARATE. */
  uint32_t composite;
  /** Format of the images written, WLK_TARGET_*. Default RGBA16_FLOAT; headless RGBA32_FLOAT. */
  uint32_t targetFormat;
  /** Bits WLK_LAYER_*. Others are refused, unless they come with WLK_LAYER_ALL, from which layers
   *  may be taken away by & ~. Default ALL. */
  uint64_t layers;
  /** WLK_COLOR_*. Default WAVELENGTHS. */
  uint32_t colorSpace;
  uint32_t reserved0;
} WlkViewInfo;

/** Creates a view with the default camera and quality; wlkPrepare before it is drawn. [C] Errors:
 *  INVALID_ARGUMENT, UNSUPPORTED_FORMAT, MISSING_FEATURE (BLEND), WRONG_STATE in CPU mode and for
 *  BLEND in headless mode, OUT_OF_HOST_MEMORY. */
WLK_API WlkResult wlkCreateView(WlkContext context, const WlkViewInfo* info, WlkView* view);
/** Changes size, composite mode, format, layers or colours. Needs wlkPrepare. [C] Errors: as
 *  wlkCreateView, DEVICE_LOST. */
WLK_API WlkResult wlkUpdateView(WlkContext context, WlkView view, const WlkViewInfo* info);
/** The memory is freed when no frame in flight uses it. [C] Errors: INVALID_HANDLE. */
WLK_API WlkResult wlkDestroyView(WlkContext context, WlkView view);

/** Near, far, field of view, handedness, reversed and infinite depth follow from the matrix. */
typedef struct WlkCamera {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  /** Eye in the world. m, |x| <= 1e9. Default (0, 2, 0). */
  double position[3];
  /** Rotation, column-major 3x3, orthonormal (mirrored allowed). Default identity. */
  float viewFromWorld[9];
  /** Factor on everything written, > 0, so that the target's range is used. [1e-9, 1e9], def. 1. */
  float preExposure;
  /** Vulkan clip space, without jitter, perspective. Default 60 degrees vertical field of view,
   *  16:9, y up in view space, looking along -z, infinite reversed depth with near plane 0.1 m. */
  float clipFromView[16];
} WlkCamera;

/** Sets the camera for the frames to come. [C] Errors: INVALID_ARGUMENT also for a singular or
 *  orthographic clipFromView and for a viewFromWorld that is no rotation. */
WLK_API WlkResult wlkSetCamera(WlkContext context, WlkView view, const WlkCamera* camera);

/** Levels of quality: each costs more than the one before and is nearer to the truth. */
enum { WLK_QUALITY_LOW = 0, WLK_QUALITY_MEDIUM = 1, WLK_QUALITY_HIGH = 2, WLK_QUALITY_ULTRA = 3 };

enum {
  /** The level's choice. */
  WLK_SLICING_DEFAULT = 0,
  /** Planes between eye and light, [R04] 4.2: acute angles front to back, obtuse back to front. */
  WLK_SLICING_HALF_ANGLE = 1,
  /** Planes across the light's direction: no flip at 90 degrees, independent of the view. */
  WLK_SLICING_LIGHT_ALIGNED = 2
};

enum {
  WLK_SCATTERING_DEFAULT = 0, /* ALL_ORDERS on every level */
  /** Once-scattered light only, in air and fog as well. */
  WLK_SCATTERING_SINGLE = 1,
  /** Forward scattering in volumes, [R04] Eq. 20-26 as corrected; all orders in air and fog. */
  WLK_SCATTERING_FORWARD = 2,
  /** The same with the paper's whole number of scatterings, ceil(n), for comparison. */
  WLK_SCATTERING_FORWARD_INTEGER = 3,
  /** All orders: the first exactly, the others on a grid of cells inside each volume. */
  WLK_SCATTERING_ALL_ORDERS = 4
};

enum {
  /** Record every pass whether needed or not; for tests that compare with skipping. */
  WLK_QUALITY_FLAG_NO_SKIP = 1u << 0,
  /** Volumes shade air, fog, bare planet from the first light; what layers let through arrives. */
  WLK_QUALITY_FLAG_VOLUME_SHADOWS = 1u << 1,
  /** So does the engine's shadow map (WlkLightShadow) given with a view's targets: shafts. */
  WLK_QUALITY_FLAG_LIGHT_SHADOWS = 1u << 2
};

/** In how many pixels the rays of volumes are marched, and surfaces lit in full. */
enum {
  /** The level's choice: FULL on ULTRA, else HALF, as with all controls but LEVEL. */
  WLK_VOLUME_RESOLUTION_DEFAULT = 0,
  /** In each. */
  WLK_VOLUME_RESOLUTION_FULL = 1,
  /** In every second one along both axes, in every fourth first where voxels are 2 wide.
   *  Those between take on what their neighbours see where that is smooth (to 0.64 / sliceCount)
   *  and ends at the same surface; others have their own.
   *  Where all slabs' light is kept (see batchSize); never of air, fog, froxels. Of surfaces light
   *  scattered more than once alone, in every fourth, then second pixel along both axes; those
   *  between take on the mean of what is around where that is alike or changes evenly, within
   *  3.5, then 7 % (with detail 5, then 10 %), and as far away. */
  WLK_VOLUME_RESOLUTION_HALF = 2
};

/** Who chooses. Others than LEVEL leave sliceCount, batchSize and lightBufferSize 0. */
enum {
  /** Nobody: the numbers of `level` and of the fields that are not 0. */
  WLK_CONTROL_LEVEL = 0,
  /** The best that keeps timeBudget_ms by the view's own timestamps. */
  WLK_CONTROL_TIME = 1,
  /** The same by times that the engine reports: wlkReportFrameTime. */
  WLK_CONTROL_REPORTED_TIME = 2,
  /** The cheapest whose estimated error is at most errorTarget. */
  WLK_CONTROL_ERROR = 3
};

/** Zero in a field means the level's choice. sliceCount, batchSize, lightBufferSize, slicing,
 *  volumeCells, lightFrames and volumeResolution are hints: their ranges stay for all 1.x, but a
 *  later one may reach the same picture otherwise, choose other numbers, or need none of them. */
typedef struct WlkQuality {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  /** WLK_QUALITY_*. Default HIGH. */
  uint32_t level;
  /** Slabs through each volume. Hint; 0 or [8, 2048]. Default 0. */
  uint32_t sliceCount;
  /** Slabs per batch, whose light is computed in every frame. 0: light is kept between frames and
   *  shared by the views, as far as memory allows. Hint; 0 or [1, sliceCount]. Default 0. */
  uint32_t batchSize;
  /** Texels along the light buffer's edge. Hint; 0 or [16, 2048]. Default 0. */
  uint32_t lightBufferSize;
  /** WLK_SLICING_*. Hint. Default DEFAULT. */
  uint32_t slicing;
  /** WLK_SCATTERING_*. Default DEFAULT. */
  uint32_t scattering;
  /** Bits WLK_QUALITY_FLAG_*; others are refused. Default 0. */
  uint64_t flags;
  /** With ALL_ORDERS: edge of a cube with as many cells as the grid of a volume has at most. Many
   *  may exceed storage buffers (wlkPrepare, LIMIT_EXCEEDED). Hint; 0 or [8, 128]. Default 0. */
  uint32_t volumeCells;
  /** WLK_CONTROL_*. Default LEVEL. */
  uint32_t control;
  /** Of WLK_CONTROL_TIME and WLK_CONTROL_REPORTED_TIME: GPU time of this view's frame, ms.
   *  [0.01, 1000] there, else 0. Default 0. */
  float timeBudget_ms;
  /** Of WLK_CONTROL_ERROR: relative error as wlkGetErrorEstimate has it. [1e-4, 1] there, else 0.
   *  Default 0. */
  float errorTarget;
  /** WLK_QUALITY_* below which no control goes, at most `level`. Default LOW. */
  uint32_t lowestLevel;
  /** WLK_VOLUME_RESOLUTION_*. Hint. Default DEFAULT. */
  uint32_t volumeResolution;
  /** With WLK_SCATTERING_ALL_ORDERS: frames over which a volume's light is renewed, in even parts,
   *  as the first light's direction moves by up to 5 degrees per frame; other changes show at once.
   *  Scattered light lags by up to 2 lightFrames - 2 frames. Hint; 0 (as 1) or [1, 64]. Default 0.
   */
  uint32_t lightFrames;
  uint32_t reserved0;
} WlkQuality;

/** Sets a view's quality. Needs wlkPrepare, unless only timeBudget_ms or errorTarget of a
 *  controlled quality change. [C] Errors: INVALID_ARGUMENT, MISSING_FEATURE (WLK_CONTROL_TIME on a
 *  queue without timestamps). */
WLK_API WlkResult wlkSetQuality(WlkContext context, WlkView view, const WlkQuality* quality);

/** Why a controlled view stands where it does. */
enum {
  /** WLK_CONTROL_LEVEL. */
  WLK_CONTROL_REASON_NONE = 0,
  /** Too few frames of this rung are known. */
  WLK_CONTROL_REASON_MEASURING = 1,
  /** It keeps the budget, the next rung up would not; or it is the cheapest that keeps the error
   *  target. */
  WLK_CONTROL_REASON_FITS = 2,
  /** It keeps the budget on the highest rung. */
  WLK_CONTROL_REASON_BEST = 3,
  /** The next rung up would keep the budget, too; it is taken if that stays so. */
  WLK_CONTROL_REASON_RISING = 4,
  /** The budget is exceeded; a lower rung is taken if that stays so. */
  WLK_CONTROL_REASON_OVER = 5,
  /** No rung keeps the budget or the error target: this is the lowest or the highest. */
  WLK_CONTROL_REASON_UNREACHABLE = 6,
  /** No volume is drawn: rungs would look and cost the same. */
  WLK_CONTROL_REASON_IDLE = 7
};

/** Where a view's quality stands on the ladder of settings from the lowest level to its own. */
typedef struct WlkQualityState {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  /** WLK_CONTROL_*. */
  uint32_t control;
  /** WLK_CONTROL_REASON_*. */
  uint32_t reason;
  /** Of the next frame. How many rungs there are, and what each stands for, may change with any
   *  version. */
  uint32_t rung;
  uint32_t lowestRung;
  uint32_t highestRung;
  /** What the rung stands for, as in WlkQuality; 0 where the library uses no such number: no
   *  batches where light is kept, no cells without light of several orders. */
  uint32_t sliceCount;
  uint32_t batchSize;
  uint32_t lightBufferSize;
  uint32_t volumeCells;
  uint32_t reserved0;
  /** Smoothed time of a frame on this rung, and what the next rung up would take; 0 if unknown. */
  float time_ms;
  float predictedTime_ms;
  /** Estimated error of this rung (WLK_CONTROL_ERROR); 0 if unknown. */
  float relativeError;
  uint32_t reserved1;
  /** First frame on this rung, and how often the rung has changed since wlkSetQuality. */
  uint64_t sinceFrame;
  uint64_t switches;
} WlkQualityState;

/** Tells what a view's quality is and why. [C] Errors: INVALID_HANDLE, UNKNOWN_STRUCT. */
WLK_API WlkResult wlkGetQualityState(WlkContext context, WlkView view, WlkQualityState* state);

/** Reports the GPU time of the view's part of a finished frame, ms, for WLK_CONTROL_REPORTED_TIME;
 *  one not later than the last reported changes nothing. [C] Errors: INVALID_ARGUMENT for times
 *  outside (0, 1e6] and frames that were not recorded yet, WRONG_STATE with another control. */
WLK_API WlkResult wlkReportFrameTime(WlkContext context, WlkView view, uint64_t frameIndex,
                                     double milliseconds);

/** "WLK_CONTROL_REASON_FITS" and so on. [F] */
WLK_API const char* wlkControlReasonName(uint32_t reason);

/* ------------------------------------------------------------------------------------- frames */

/** Makes every pipeline, buffer and table that the present scene and views need. After it, and
 *  until something is created or resized, recording allocates nothing. If it fails, what it had
 *  made stays, and views that were prepared may need it again (NOT_PREPARED).
 *
 *  Solves for the light that air and fog scatter more than once (0.1 to 0.4 s) if the air has
 *  changed; without it the next frames show the old light while wlkVulkanCmdUpdate solves for the
 *  new, 4 ms of CPU time each, 24 in clear air, 42 to 126 in fog, and allocates when it begins and
 *  ends. Light that is scattered more than once sees the fields of a volume as one mixture. It
 *  follows what was uploaded: exactly when this is called, else by wlkVulkanCmdUpdate once a
 *  field's share of the volume's extinction has changed by more than 0.05, for 14 ms and one
 *  buffer. Views whose eye has risen above 1.5 scale heights (12 km on Earth) are drawn more
 *  sharply at the edge of night far below if this is called again. [C] Errors: WRONG_STATE in CPU
 *  mode, LIMIT_EXCEEDED (cells, froxels, or pixels of views and maps beyond the device's storage
 *  buffers), OUT_OF_*, DEVICE_LOST. */
WLK_API WlkResult wlkPrepare(WlkContext context);

/** Which frame begins, and which are over. */
typedef struct WlkFrameInfo {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  /** Number of this frame; greater than the last one, from 1 on. Default 0, which is refused. */
  uint64_t frameIndex;
  /** All frames up to this number are complete on the GPU; 0 if none. Less than frameIndex, and
   * never less than before. Default 0. */
  uint64_t completedFrameIndex;
} WlkFrameInfo;

/** Starts a frame on the engine's device; headless contexts do this themselves. [C] Errors:
 * FRAMES_IN_FLIGHT, INVALID_ARGUMENT, WRONG_STATE. */
WLK_API WlkResult wlkBeginFrame(WlkContext context, const WlkFrameInfo* frame);

#define WLK_MAX_SHADOW_CASCADES 4

/** How the engine's shadow map of a light lies in the world: one map, or cascades, the finest
 *  first. Every cascade is an orthographic view along the light; points belong to the first one
 *  that contains them and are shadowed where the map holds something nearer to the light. Points
 *  in none are lit. Shadows are those of opaque surfaces on air, fog and bare planet, as far as
 *  light is scattered once; they take nothing from volumes. */
typedef struct WlkLightShadow {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  /** Layers of the map that are read, from the first on. [1, WLK_MAX_SHADOW_CASCADES], default 1.
   */
  uint32_t cascadeCount;
  /** Index in wlkSetLights. [0, WlkCapabilities::maxLights - 1], default 0. A map is read if this
   *  light is the brightest one on the volumes or, without any, the first one that reaches the air;
   *  else WLK_LOG_ID_SHADOW_MAP_UNUSED says that it is not. */
  uint32_t light;
  /** Where positions in clipFromWorld are counted from, for example the camera's position. World,
   *  m, |x| <= 1e9. Default 0. */
  double origin[3];
  /** Per cascade, column-major: (world position - origin, 1) to Vulkan clip space: x and y in
   *  [-1, 1], (-1, -1) at the outer corner of texel (0, 0), depth in [0, 1]. Affine and
   *  invertible, |x| <= 1e9, edges and depth of 2 mm to 1e7 m, lines of equal x and y within 30
   *  degrees of the light's direction. It tells whether depth is reversed. Default identity. */
  float clipFromWorld[WLK_MAX_SHADOW_CASCADES][16];
  /** Points up to this far behind the map's surface count as lit: half a texel's width on slopes
   *  of 45 degrees. m along the light, [0, 1e6], default 0.1. */
  float bias;
  uint32_t reserved0;
} WlkLightShadow;

/** The engine's picture for wlkRenderHeadless. */
typedef struct WlkHeadlessInputs {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  /** width * height RGBA floats, top row first; null: black. Read during the call only, as all
   *  here. Default null. */
  const float* color;
  /** Bytes at color, at least width * height * 16. Default 0. */
  uint64_t colorSize;
  /** width * height depth values in the camera's convention; null: nothing is there. Default null.
   */
  const float* depth;
  /** Bytes at depth, at least width * height * 4. Default 0. */
  uint64_t depthSize;
  /** Where the engine's shadow map lies; null: there is none. Needs WLK_QUALITY_FLAG_LIGHT_SHADOWS.
   *  Default null. */
  const WlkLightShadow* lightShadow;
  /** shadowWidth * shadowHeight * cascadeCount depth values, the cascades one after the other; null
   *  only without lightShadow. Default null. */
  const float* shadowDepth;
  /** Bytes at shadowDepth, at least four times that. Default 0. */
  uint64_t shadowDepthSize;
  /** Texels of a cascade. [1, 8192] with lightShadow. Default 0. */
  uint32_t shadowWidth;
  uint32_t shadowHeight;
} WlkHeadlessInputs;

/** Renders one frame of the view and waits for it. `inputs` may be null. [C]
 *  Errors: WRONG_STATE on an engine's device and for a shadow map without the quality's flag,
 *  INVALID_ARGUMENT, NOT_PREPARED, OUT_OF_*, DEVICE_LOST. */
WLK_API WlkResult wlkRenderHeadless(WlkContext context, WlkView view,
                                    const WlkHeadlessInputs* inputs);

enum {
  /** The composited picture (COMPUTE). */
  WLK_IMAGE_COLOR = 0,
  /** Premultiplied radiance (SEPARATE). */
  WLK_IMAGE_RADIANCE = 1,
  /** RGB transmittance (SEPARATE). */
  WLK_IMAGE_TRANSMITTANCE = 2
};

/** Where a picture is copied to. */
typedef struct WlkImageData {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  /** WLK_IMAGE_*. Default COLOR. */
  uint32_t image;
  uint32_t reserved0;
  /** Receives width * height RGBA floats, top row first. Default null. */
  float* data;
  /** Bytes at data, at least width * height * 16. Default 0. */
  uint64_t dataSize;
} WlkImageData;

/** Copies an image of the view's last headless frame. [C] NOT_READY before the first, after
 *  one that failed while it was drawn, and from when the view needs wlkPrepare until a frame is
 *  rendered again; a call that was refused leaves the frame before it. Errors: WRONG_STATE on an
 *  engine's device, INVALID_ARGUMENT, DEVICE_LOST (nobody knows what it holds). */
WLK_API WlkResult wlkReadback(WlkContext context, WlkView view, const WlkImageData* image);

#ifdef __cplusplus
}
#endif

#endif
