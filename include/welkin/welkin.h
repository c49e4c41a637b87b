/* SPDX-License-Identifier: MIT
 *
 * Welkin: atmosphere middleware for game engines. C API, core part: no Vulkan type appears here.
 *
 * Conventions, stated once:
 *  - SI units (metre, radian, 1/metre) unless a name says otherwise (`dropletDiameter_um`).
 *  - World space is the engine's, right- or left-handed, in metres, double precision.
 *  - Directions are unit vectors; a light's direction points *towards* the light.
 *  - RGB means the three wavelengths 680, 550, 440 nm ([R04] Table 3), linear, scene-referred.
 *  - Radiance has the unit of the light's irradiance per steradian.
 *  - Matrices are column-major and act on column vectors (unless the field says row-major).
 *  - Every structure starts with sType, structSize, next; fill it with wlkInitStruct, which sets
 *    these three and the defaults named below, then change what you need.
 *  - Handles are values; {0} is null; a stale handle gives WLK_ERROR_INVALID_HANDLE, never a crash.
 *  - Functions that fail change nothing, and wlkGetLastError names the structure and the field.
 *
 * Thread classes, named at each function:
 *  [F] free: any thread, any time.
 *  [C] context: one thread at a time per context.
 *
 * Sources: [R04] Riley et al. 2004, [J23] Jendersie & d'Eon 2023.
 */
#ifndef WELKIN_WELKIN_H
#define WELKIN_WELKIN_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#if defined(WELKIN_STATIC)
#define WLK_API
#elif defined(_WIN32)
#ifdef WELKIN_BUILD
#define WLK_API __declspec(dllexport)
#else
#define WLK_API __declspec(dllimport)
#endif
#else
#define WLK_API __attribute__((visibility("default")))
#endif

#define WLK_MAKE_VERSION(major, minor, patch) \
  (((uint32_t)(major) << 22) | ((uint32_t)(minor) << 12) | (uint32_t)(patch))
#define WLK_VERSION_MAJOR 0
#define WLK_VERSION_MINOR 1
#define WLK_VERSION_PATCH 0
/** The version of this header. */
#define WLK_API_VERSION WLK_MAKE_VERSION(WLK_VERSION_MAJOR, WLK_VERSION_MINOR, WLK_VERSION_PATCH)

/** Most density fields in one volume. */
#define WLK_MAX_FIELDS 4u
/** Bytes of WlkErrorInfo::field and of WlkPassStats::name, terminator included. */
#define WLK_NAME_SIZE 64u
/** Bytes of WlkErrorInfo::message, terminator included. */
#define WLK_MESSAGE_SIZE 256u

/* ------------------------------------------------------------------------------------ results */

/** 0 is success, positive values are states, negative values are errors. */
typedef int32_t WlkResult;
enum {
  WLK_SUCCESS = 0,
  /** The result asked for does not exist yet (no frame was rendered). */
  WLK_NOT_READY = 1,
  /** The array passed in was too short; it was filled as far as it goes. */
  WLK_INCOMPLETE = 2,
  /** A null pointer, a value out of range or not finite; WlkErrorInfo::field names it. */
  WLK_ERROR_INVALID_ARGUMENT = -1,
  /** A handle that is null, destroyed, or of another context. */
  WLK_ERROR_INVALID_HANDLE = -2,
  /** sType is not the one the function takes, or an unknown structure stands in a `next` chain. */
  WLK_ERROR_UNKNOWN_STRUCT = -3,
  /** structSize is larger than this library knows and the surplus bytes are not zero. */
  WLK_ERROR_STRUCT_TOO_NEW = -4,
  /** The header's version is not supported by this library. */
  WLK_ERROR_VERSION = -5,
  /** The host allocator returned null. */
  WLK_ERROR_OUT_OF_HOST_MEMORY = -6,
  /** Vulkan reported no device memory, or the resource exceeds a device limit's memory. */
  WLK_ERROR_OUT_OF_DEVICE_MEMORY = -7,
  /** Vulkan reported a lost device; only destroy calls are useful from here on. */
  WLK_ERROR_DEVICE_LOST = -8,
  /** A format that the role does not support. */
  WLK_ERROR_UNSUPPORTED_FORMAT = -9,
  /** The device or instance lacks a function, version or feature that is needed; it is named. */
  WLK_ERROR_MISSING_FEATURE = -10,
  /** completedFrameIndex lags more than maxFramesInFlight behind frameIndex. */
  WLK_ERROR_FRAMES_IN_FLIGHT = -11,
  /** Something was created or changed after the last wlkPrepare; call it again. */
  WLK_ERROR_NOT_PREPARED = -12,
  /** The call does not fit the context's mode or state (for example recording without a frame). */
  WLK_ERROR_WRONG_STATE = -13,
  /** A count or size is over a documented limit of the library or of the device. */
  WLK_ERROR_LIMIT_EXCEEDED = -14,
  /** No Vulkan loader or no device fits (headless mode). */
  WLK_ERROR_NO_DEVICE = -15,
  /** A defect of the library; please report the message. */
  WLK_ERROR_INTERNAL = -16
};

/** Values of sType; never renumbered. */
typedef enum WlkStructType {
  WLK_STRUCT_ERROR_INFO = 1,
  WLK_STRUCT_CONTEXT_INFO = 2,
  WLK_STRUCT_HEADLESS_INFO = 3,
  WLK_STRUCT_CAPABILITIES = 4,
  WLK_STRUCT_PLANET = 10,
  WLK_STRUCT_SKY = 11,
  WLK_STRUCT_LIGHT = 12,
  WLK_STRUCT_FOG = 13,
  WLK_STRUCT_MEDIUM_INFO = 20,
  WLK_STRUCT_VOLUME_INFO = 21,
  WLK_STRUCT_VOLUME_UPLOAD = 22,
  WLK_STRUCT_VIEW_INFO = 30,
  WLK_STRUCT_CAMERA = 31,
  WLK_STRUCT_QUALITY = 32,
  WLK_STRUCT_FRAME_INFO = 40,
  WLK_STRUCT_HEADLESS_TARGETS = 41,
  WLK_STRUCT_IMAGE_DATA = 42,
  WLK_STRUCT_FRAME_STATS = 43,
  WLK_STRUCT_RAY_BATCH = 50,
  WLK_STRUCT_VULKAN_DEVICE_INFO = 1000,
  WLK_STRUCT_VULKAN_REQUIREMENTS = 1001,
  WLK_STRUCT_VULKAN_IMAGE = 1002,
  WLK_STRUCT_VULKAN_VIEW_TARGETS = 1003
} WlkStructType;

/** Version of the library that is running, as WLK_MAKE_VERSION. [F] */
WLK_API uint32_t wlkGetVersion(void);

/** "WLK_ERROR_INVALID_ARGUMENT" and so on; "WLK_UNKNOWN_RESULT" for other values. [F] */
WLK_API const char* wlkResultName(WlkResult result);

/** Sets sType, structSize and next = null, and every other field to its documented default.
 *  `structSize` is the caller's sizeof; at most that many bytes are written. [F]
 *  Errors: INVALID_ARGUMENT (null, structSize too short), UNKNOWN_STRUCT. */
WLK_API WlkResult wlkInitStruct(uint32_t sType, uint32_t structSize, void* structure);

/** What went wrong in the last failed call of this thread. */
typedef struct WlkErrorInfo {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  /** The code that the call returned; WLK_SUCCESS if no call of this thread failed yet. */
  WlkResult result;
  /** sType of the structure at fault, 0 if none. */
  uint32_t structType;
  /** The VkResult behind it, 0 if none. */
  int32_t vkResult;
  uint32_t reserved0;
  /** Name of the field or argument at fault, "" if none. */
  char field[WLK_NAME_SIZE];
  /** One English sentence. */
  char message[WLK_MESSAGE_SIZE];
} WlkErrorInfo;

/** Copies the last error of the calling thread; it stays until the next failing call. [F] */
WLK_API WlkResult wlkGetLastError(WlkErrorInfo* info);

/* ------------------------------------------------------------------------------------ context */

typedef struct WlkContext_T* WlkContext;
/** A kind of particle: phase function and single-scattering albedo. */
typedef struct WlkMedium {
  uint64_t id;
} WlkMedium;
/** A box of density fields in the world. */
typedef struct WlkVolume {
  uint64_t id;
} WlkVolume;
/** A camera with its targets' size and composite mode. */
typedef struct WlkView {
  uint64_t id;
} WlkView;

/** Host allocator; all three null means malloc and free. */
typedef struct WlkAllocator {
  void* user;
  /** Returns `size` bytes aligned to `alignment` (a power of two), or null. */
  void* (*allocate)(void* user, uint64_t size, uint64_t alignment);
  /** Frees what allocate returned, with the same size and alignment. */
  void (*release)(void* user, void* memory, uint64_t size, uint64_t alignment);
} WlkAllocator;

enum { WLK_LOG_ERROR = 1, WLK_LOG_WARNING = 2, WLK_LOG_INFO = 3 };

/** Receives messages; `text` is UTF-8 and lives for the call. Must not call Welkin. */
typedef void (*WlkLogCallback)(void* user, uint32_t severity, const char* text);

/** What a context is made from. Chain WlkVulkanDeviceInfo (welkin_vulkan.h) for the engine's
 *  device, WlkHeadlessInfo for a device of Welkin's own, nothing for a CPU-only context. */
typedef struct WlkContextInfo {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  /** Version of the header that the caller was built with. Default WLK_API_VERSION. */
  uint32_t apiVersion;
  /** Frames that may be recorded before the first of them is complete. [1, 8], default 3. */
  uint32_t maxFramesInFlight;
  /** Host allocator. Default all null. */
  WlkAllocator allocator;
  /** Log receiver. Default null: silent. */
  WlkLogCallback log;
  void* logUser;
} WlkContextInfo;

enum {
  /** Load VK_LAYER_KHRONOS_validation with synchronisation validation; messages go to the log. */
  WLK_HEADLESS_VALIDATION = 1u << 0
};

/** Chained to WlkContextInfo: Welkin loads Vulkan itself and owns device and targets. */
typedef struct WlkHeadlessInfo {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  /** Bits WLK_HEADLESS_*. Default 0. */
  uint64_t flags;
  /** Take the first device whose name contains this text; null takes the best. Default null. */
  const char* deviceName;
} WlkHeadlessInfo;

/** Creates a context. Vulkan pointers of the chain must outlive it. [F]
 *  Errors: INVALID_ARGUMENT, VERSION, UNKNOWN_STRUCT, NO_DEVICE, MISSING_FEATURE, OUT_OF_*. */
WLK_API WlkResult wlkCreateContext(const WlkContextInfo* info, WlkContext* context);

/** Destroys a context and all that was made from it; null is allowed. The GPU must be done with
 *  every frame that was recorded. [C] */
WLK_API void wlkDestroyContext(WlkContext context);

enum { WLK_MODE_CPU = 0, WLK_MODE_HEADLESS = 1, WLK_MODE_ENGINE_DEVICE = 2 };

typedef struct WlkCapabilities {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  /** WLK_MODE_*. */
  uint32_t mode;
  /** Vulkan version of the device, 0 in CPU mode. */
  uint32_t vulkanVersion;
  /** Most lights that wlkSetLights takes. */
  uint32_t maxLights;
  /** Largest edge of a volume in voxels. */
  uint32_t maxVolumeSize;
  /** 1 if WLK_COMPOSITE_BLEND works on this device (dualSrcBlend), else 0. */
  uint32_t blendSupported;
  uint32_t reserved0;
  /** Name of the device, "" in CPU mode. */
  char deviceName[WLK_MESSAGE_SIZE];
} WlkCapabilities;

WLK_API WlkResult wlkGetCapabilities(WlkContext context, WlkCapabilities* capabilities); /* [C] */

/* -------------------------------------------------------------------------------------- scene */

/** Where altitude is measured. Altitude 0 is the sphere through seaLevelPoint. */
typedef struct WlkPlanet {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  /** A world point at sea level. m, |x| <= 1e9. Default (0, 0, 0). */
  double seaLevelPoint[3];
  /** Unit vector away from the planet's centre at that point. Default (0, 1, 0). */
  float up[3];
  /** Radius of the sea-level sphere. m, [1e4, 1e9], default 6.371e6. */
  float radius;
  /** Lambertian reflectance of the bare planet, seen where the engine drew nothing. RGB, [0, 1],
   *  default 0.1. */
  float groundAlbedo[3];
  uint32_t reserved0;
} WlkPlanet;

/** Sets the planet; null restores the defaults. [C] */
WLK_API WlkResult wlkSetPlanet(WlkContext context, const WlkPlanet* planet);

/** Air molecules: sky light, aerial perspective, reddening of the sun. [R04] 4.1. */
typedef struct WlkSky {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  /** Scattering coefficient at sea level. RGB, 1/m, [0, 1], default 5.8e-6, 1.35e-5, 3.31e-5
   *  ([R04] Table 3). */
  float rayleighScattering[3];
  /** Altitude over which the density falls by e. m, [100, 1e5], default 8000 ([R04] 4.1.1). */
  float scaleHeight;
} WlkSky;

/** Sets the air; null means none (the default of a new context). [C] */
WLK_API WlkResult wlkSetSky(WlkContext context, const WlkSky* sky);

/** A directional light with a disk: the sun. */
typedef struct WlkLight {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  /** Unit vector towards the light. Default (0, 1, 0). */
  float direction[3];
  /** Full angle of the disk. rad, [0, 0.2], default 0.00930 (the sun, 0.533 degrees). 0: no disk. */
  float angularDiameter;
  /** Irradiance on a surface facing the light, outside the atmosphere. RGB, [0, 1e6], default 1. */
  float irradiance[3];
  uint32_t reserved0;
} WlkLight;

/** Replaces all lights. `stride` is the distance between elements in bytes. count 0: no light.
 *  [C] Errors: LIMIT_EXCEEDED over WlkCapabilities::maxLights. */
WLK_API WlkResult wlkSetLights(WlkContext context, uint32_t count, uint32_t stride,
                               const WlkLight* lights);

/** A fog layer of water droplets: extinction falls exponentially with altitude, phase function
 *  HG + Draine of the droplet size ([J23] Eq. 2-7). */
typedef struct WlkFog {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  /** Median droplet diameter. um, [5, 50], default 10. */
  float dropletDiameter_um;
  /** Extinction coefficient at baseAltitude. 1/m, [0, 10], default 0.002. */
  float extinction;
  /** Altitude of that value. m, [-1e4, 1e5], default 0. */
  float baseAltitude;
  /** Altitude over which the extinction falls by e. m, [1, 1e5], default 100. */
  float scaleHeight;
  /** Single-scattering albedo. RGB, [0, 1], default 1. */
  float singleScatteringAlbedo[3];
  uint32_t reserved0;
} WlkFog;

/** Sets the fog layer; null means none (the default). [C] */
WLK_API WlkResult wlkSetFog(WlkContext context, const WlkFog* fog);

enum {
  /** HG + Draine blend of water droplets, from dropletDiameter_um. [J23] Eq. 3-7. */
  WLK_PHASE_HG_DRAINE = 0,
  /** Henyey-Greenstein, from asymmetry. */
  WLK_PHASE_HENYEY_GREENSTEIN = 1,
  /** Rayleigh. [R04] Eq. 1. */
  WLK_PHASE_RAYLEIGH = 2
};

typedef struct WlkMediumInfo {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  /** WLK_PHASE_*. Default WLK_PHASE_HG_DRAINE. */
  uint32_t phase;
  /** Median droplet diameter, for WLK_PHASE_HG_DRAINE. um, [5, 50], default 20. */
  float dropletDiameter_um;
  /** Mean cosine, for WLK_PHASE_HENYEY_GREENSTEIN. [-0.999, 0.999], default 0.85. */
  float asymmetry;
  /** Single-scattering albedo. RGB, [0, 1], default 1. */
  float singleScatteringAlbedo[3];
} WlkMediumInfo;

WLK_API WlkResult wlkCreateMedium(WlkContext context, const WlkMediumInfo* info,
                                  WlkMedium* medium); /* [C] */
/** Errors: WRONG_STATE while a volume uses it. [C] */
WLK_API WlkResult wlkDestroyMedium(WlkContext context, WlkMedium medium);

/** Formats of volume data. */
enum {
  WLK_FORMAT_R32_FLOAT = 1,
  WLK_FORMAT_R16_FLOAT = 2,
  /** Unsigned bytes, 255 meaning 1. */
  WLK_FORMAT_R8_UNORM = 3
};

/** One particle field of a volume. */
typedef struct WlkVolumeField {
  WlkMedium medium;
  /** Extinction coefficient at value 1: extinction = value * extinctionScale. 1/m, [0, 1e6]. */
  float extinctionScale;
  uint32_t reserved0;
} WlkVolumeField;

typedef struct WlkVolumeInfo {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  /** Voxels along x, y, z. [1, WlkCapabilities::maxVolumeSize] each. Default 1. */
  uint32_t size[3];
  /** [1, WLK_MAX_FIELDS], default 0. */
  uint32_t fieldCount;
  /** sizeof(WlkVolumeField) of the caller. Default that. */
  uint32_t fieldStride;
  uint32_t reserved0;
  /** fieldCount elements. Default null. */
  const WlkVolumeField* fields;
  /** Row-major 3x4: world = M * (x, y, z, 1), where the volume is the unit box [0, 1]^3 and voxel
   *  (i, j, k) has its centre at ((i+0.5)/size[0], (j+0.5)/size[1], (k+0.5)/size[2]). Invertible.
   *  Default identity. */
  double worldFromVolume[12];
} WlkVolumeInfo;

/** Creates a volume of value 0 everywhere. [C]
 *  Errors: INVALID_ARGUMENT, INVALID_HANDLE (medium), LIMIT_EXCEEDED, OUT_OF_*. */
WLK_API WlkResult wlkCreateVolume(WlkContext context, const WlkVolumeInfo* info,
                                  WlkVolume* volume);
/** The memory is freed when no frame in flight uses it. [C] */
WLK_API WlkResult wlkDestroyVolume(WlkContext context, WlkVolume volume);
/** Moves a volume; as WlkVolumeInfo::worldFromVolume. [C] */
WLK_API WlkResult wlkSetVolumeTransform(WlkContext context, WlkVolume volume,
                                        const double worldFromVolume[12]);

/** Values for a box of voxels of one field. Negative values, NaN and infinities become 0; values
 *  over 65504 become 65504. */
typedef struct WlkVolumeUpload {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  /** Index of the field. Default 0. */
  uint32_t field;
  /** WLK_FORMAT_R32_FLOAT, R16_FLOAT or R8_UNORM. Default R32_FLOAT. */
  uint32_t format;
  /** First voxel. Default 0. */
  uint32_t offset[3];
  /** Voxels along x, y, z; offset + extent <= size. Default 0. */
  uint32_t extent[3];
  /** Bytes from one row (y) to the next; 0 means tight. Default 0. */
  uint64_t rowPitch;
  /** Bytes from one slice (z) to the next; 0 means tight rows. Default 0. */
  uint64_t slicePitch;
  /** x fastest. Read during the call only. Default null. */
  const void* data;
  /** Bytes at data; what the pitches reach must lie inside. Default 0. */
  uint64_t dataSize;
} WlkVolumeUpload;

/** Copies the data; the GPU copy is made by the next frame. [C] */
WLK_API WlkResult wlkUploadVolume(WlkContext context, WlkVolume volume,
                                  const WlkVolumeUpload* upload);

/* -------------------------------------------------------------------------------------- views */

enum {
  /** Write colour * transmittance + radiance to a storage image (or over the input image). */
  WLK_COMPOSITE_COMPUTE = 0,
  /** Blend onto the engine's colour attachment with dual-source blending. */
  WLK_COMPOSITE_BLEND = 1,
  /** Write premultiplied radiance and RGB transmittance to two images; the engine composites. */
  WLK_COMPOSITE_SEPARATE = 2
};

/** Layers of a view. SUN_DISK and GROUND belong to the sky: they need WLK_LAYER_SKY and wlkSetSky. */
enum {
  WLK_LAYER_SKY = 1u << 0,
  WLK_LAYER_FOG = 1u << 1,
  WLK_LAYER_VOLUMES = 1u << 2,
  WLK_LAYER_SUN_DISK = 1u << 3,
  WLK_LAYER_GROUND = 1u << 4,
  WLK_LAYER_ALL = 0x1f
};

enum {
  WLK_TARGET_RGBA16_FLOAT = 1,
  WLK_TARGET_RGBA32_FLOAT = 2,
  WLK_TARGET_B10G11R11_FLOAT = 3
};

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
  /** Bits WLK_LAYER_*. Default all. */
  uint64_t layers;
} WlkViewInfo;

WLK_API WlkResult wlkCreateView(WlkContext context, const WlkViewInfo* info,
                                WlkView* view); /* [C] */
/** Changes size, composite mode, format or layers. Needs wlkPrepare. [C] */
WLK_API WlkResult wlkUpdateView(WlkContext context, WlkView view, const WlkViewInfo* info);
WLK_API WlkResult wlkDestroyView(WlkContext context, WlkView view); /* [C] */

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

enum {
  WLK_QUALITY_LOW = 0,
  WLK_QUALITY_MEDIUM = 1,
  WLK_QUALITY_HIGH = 2,
  WLK_QUALITY_ULTRA = 3
};

enum {
  /** The level's choice. */
  WLK_SLICING_DEFAULT = 0,
  /** Planes between eye and light, [R04] 4.2: acute angles front to back, obtuse back to front. */
  WLK_SLICING_HALF_ANGLE = 1,
  /** Planes across the light's direction: no flip at 90 degrees, independent of the view. */
  WLK_SLICING_LIGHT_ALIGNED = 2
};

enum {
  WLK_SCATTERING_DEFAULT = 0,
  /** Once-scattered light only. */
  WLK_SCATTERING_SINGLE = 1,
  /** Forward multiple scattering, [R04] Eq. 20-26 as corrected in docs/equations.md. */
  WLK_SCATTERING_FORWARD = 2
};

enum {
  /** Record every pass whether needed or not; for tests that compare with skipping. */
  WLK_QUALITY_NO_SKIP = 1u << 0
};

/** Zero in a field means the level's choice. */
typedef struct WlkQuality {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  /** WLK_QUALITY_*. Default HIGH. */
  uint32_t level;
  /** Slabs through each volume. 0 or [8, 2048]. Default 0. */
  uint32_t sliceCount;
  /** Slabs per batch: 1 is the paper's algorithm. 0 or [1, sliceCount]. Default 0. */
  uint32_t batchSize;
  /** Texels along the light buffer's edge. 0 or [16, 2048]. Default 0. */
  uint32_t lightBufferSize;
  /** WLK_SLICING_*. Default DEFAULT. */
  uint32_t slicing;
  /** WLK_SCATTERING_*. Default DEFAULT. */
  uint32_t scattering;
  /** Bits WLK_QUALITY_NO_SKIP. Default 0. */
  uint64_t flags;
} WlkQuality;

/** Sets a view's quality. Needs wlkPrepare. [C] */
WLK_API WlkResult wlkSetQuality(WlkContext context, WlkView view, const WlkQuality* quality);

/* ------------------------------------------------------------------------------------- frames */

/** Makes every pipeline, buffer and table that the present scene and views need. After it, and
 *  until something is created or resized, recording allocates nothing. [C]
 *  Errors: WRONG_STATE in CPU mode, OUT_OF_*, DEVICE_LOST. */
WLK_API WlkResult wlkPrepare(WlkContext context);

typedef struct WlkFrameInfo {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  /** Number of this frame; greater than the last one. Default 0. */
  uint64_t frameIndex;
  /** All frames up to this number are complete on the GPU; 0 if none. Default 0. */
  uint64_t completedFrameIndex;
} WlkFrameInfo;

/** Starts a frame on the engine's device; headless contexts do this themselves. frameIndex starts
 *  at 1. [C] Errors: FRAMES_IN_FLIGHT, INVALID_ARGUMENT, WRONG_STATE. */
WLK_API WlkResult wlkBeginFrame(WlkContext context, const WlkFrameInfo* frame);

/** The engine's picture for wlkRenderHeadless. */
typedef struct WlkHeadlessTargets {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  /** width * height RGBA floats, top row first; null means black. Default null. */
  const float* color;
  /** width * height depth values in the camera's convention; null means nothing is there. */
  const float* depth;
} WlkHeadlessTargets;

/** Renders one frame of the view and waits for it. `targets` may be null. [C]
 *  Errors: WRONG_STATE outside headless mode, NOT_PREPARED, DEVICE_LOST. */
WLK_API WlkResult wlkRenderHeadless(WlkContext context, WlkView view,
                                    const WlkHeadlessTargets* targets);

enum {
  /** The composited picture (COMPUTE). */
  WLK_IMAGE_COLOR = 0,
  /** Premultiplied radiance (SEPARATE). */
  WLK_IMAGE_RADIANCE = 1,
  /** RGB transmittance (SEPARATE). */
  WLK_IMAGE_TRANSMITTANCE = 2
};

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

/** Copies an image of the view's last headless frame. [C] NOT_READY before the first frame. */
WLK_API WlkResult wlkReadback(WlkContext context, WlkView view, const WlkImageData* image);

/* --------------------------------------------------------------------------------- statistics */

enum {
  WLK_PASS_LIGHT_SLICES = 1,
  WLK_PASS_EYE_SLICES = 2,
  WLK_PASS_COMPOSITE = 3
};

/** Why a pass was recorded or not. */
enum {
  WLK_REASON_NEEDED = 0,
  WLK_REASON_LAYER_OFF = 1,
  WLK_REASON_NOTHING_TO_DRAW = 2,
  WLK_REASON_ZERO_DENSITY = 3,
  WLK_REASON_OUTSIDE_VIEW = 4,
  WLK_REASON_NO_LIGHT = 5,
  WLK_REASON_NO_SKIP_FLAG = 6
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
  /** The volume, {0} for passes over the picture. */
  WlkVolume volume;
  /** Shader invocations (threads) recorded. */
  uint64_t invocations;
  /** GPU time of the newest finished frame, ns; 0 before one finished. */
  uint64_t gpuTime_ns;
} WlkPassStats;

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
  /** Pixels of the newest finished frame whose value was not finite before the final guard. */
  uint64_t nonFinitePixels;
} WlkFrameStats;

/** Statistics of the view's last recorded frame. `passCount` holds the room in `passes` and
 *  receives the number of passes; `passes` may be null. [C] NOT_READY before the first frame,
 *  INCOMPLETE if the array was too short. */
WLK_API WlkResult wlkGetFrameStats(WlkContext context, WlkView view, WlkFrameStats* stats,
                                   uint32_t* passCount, WlkPassStats* passes);

/** "WLK_REASON_ZERO_DENSITY" and so on. [F] */
WLK_API const char* wlkReasonName(uint32_t reason);

/* -------------------------------------------------------------------------------- CPU queries */

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
