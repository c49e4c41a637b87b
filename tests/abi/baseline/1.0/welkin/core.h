/* SPDX-License-Identifier: MIT
 *
 * Versions, results, errors, and contexts. Part of welkin.h, which states the conventions.
 */
#ifndef WELKIN_CORE_H
#define WELKIN_CORE_H

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
#define WLK_VERSION_MAJOR 1
#define WLK_VERSION_MINOR 0
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
  /** The result asked for does not exist yet: no frame was rendered or recorded. */
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
  /** The caller was built with headers of another major version. */
  WLK_ERROR_VERSION = -5,
  /** The host allocator returned null. */
  WLK_ERROR_OUT_OF_HOST_MEMORY = -6,
  /** Vulkan reported no device memory, or the resource exceeds a device limit's memory. */
  WLK_ERROR_OUT_OF_DEVICE_MEMORY = -7,
  /** Vulkan reported a lost device. From here on all that needs the device fails so without a call
   *  of Vulkan: what creates or changes volumes' and surfaces' data and images, creates or updates
   *  views, creates maps, begins frames, prepares, records or reads back. Other setters and queries
   *  go on; destroy calls and wlkVulkanForgetImage free what they can. */
  WLK_ERROR_DEVICE_LOST = -8,
  /** A format that the role does not support. */
  WLK_ERROR_UNSUPPORTED_FORMAT = -9,
  /** The device or instance lacks a function, version or feature that is needed; it is named. */
  WLK_ERROR_MISSING_FEATURE = -10,
  /** completedFrameIndex lags more than maxFramesInFlight behind frameIndex. */
  WLK_ERROR_FRAMES_IN_FLIGHT = -11,
  /** Something was created or changed after the last wlkPrepare; call it again, and in a frame
   *  that has begun record wlkVulkanCmdUpdate again before the views. */
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
  WLK_STRUCT_LOG_MESSAGE = 5,
  WLK_STRUCT_PLANET = 10,
  WLK_STRUCT_SKY = 11,
  WLK_STRUCT_LIGHT = 12,
  WLK_STRUCT_FOG = 13,
  WLK_STRUCT_ABSORBER = 14,
  WLK_STRUCT_AMBIENT = 16,
  WLK_STRUCT_MEDIUM_INFO = 20,
  WLK_STRUCT_VOLUME_INFO = 21,
  WLK_STRUCT_VOLUME_UPLOAD = 22,
  WLK_STRUCT_MEDIUM_OPTICS = 23,
  WLK_STRUCT_VOLUME_BRICKS = 24,
  WLK_STRUCT_VOLUME_STATE = 25,
  WLK_STRUCT_SURFACE_INFO = 26,
  WLK_STRUCT_SURFACE_DETAIL = 27,
  WLK_STRUCT_VIEW_INFO = 30,
  WLK_STRUCT_CAMERA = 31,
  WLK_STRUCT_QUALITY = 32,
  WLK_STRUCT_QUALITY_STATE = 33,
  WLK_STRUCT_AERIAL_PERSPECTIVE = 34,
  WLK_STRUCT_CLOUD_SHADOW_INFO = 35,
  WLK_STRUCT_CLOUD_SHADOW_STATE = 36,
  WLK_STRUCT_FRAME_INFO = 40,
  WLK_STRUCT_HEADLESS_INPUTS = 41,
  WLK_STRUCT_IMAGE_DATA = 42,
  WLK_STRUCT_FRAME_STATS = 43,
  WLK_STRUCT_ERROR_ESTIMATE = 44,
  WLK_STRUCT_LIGHT_SHADOW = 47,
  WLK_STRUCT_RAY_BATCH = 50,
  WLK_STRUCT_PHASE_QUERY = 51,
  WLK_STRUCT_SKY_MAP_QUERY = 52,
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

/** Copies the last error of the calling thread; it stays until the next failing call, which a
 *  wlkGetLastError with a wrong structure is, too. [F] */
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
/** A closed mesh filled with a cloud. */
typedef struct WlkSurface {
  uint64_t id;
} WlkSurface;
/** A camera with its targets' size and composite mode. */
typedef struct WlkView {
  uint64_t id;
} WlkView;

/** Host allocator; all three null means malloc and free. It is called on the threads that call
 *  Welkin, and must neither throw nor call Welkin. Phase functions of media and fog (0.2 MB
 *  each), the table of skylight (0.2 MB, with fog 2.3 MB) and the work space of their computation
 * come from the C++ runtime instead, and are not in WlkFrameStats::hostMemory. */
typedef struct WlkAllocator {
  void* user;
  /** Returns `size` bytes aligned to `alignment` (a power of two), or null. */
  void* (*allocate)(void* user, uint64_t size, uint64_t alignment);
  /** Frees what allocate returned, with the same size and alignment. */
  void (*release)(void* user, void* memory, uint64_t size, uint64_t alignment);
} WlkAllocator;

enum {
  /** A call fails or draws wrongly. */
  WLK_LOG_ERROR = 1,
  /** Something does not do what the caller may expect. */
  WLK_LOG_WARNING = 2,
  /** What was done and what it took. */
  WLK_LOG_INFO = 3
};

/** What a message is about. What a call returns as an error is no message. */
enum {
  /** ERROR or WARNING of the validation layer (WLK_HEADLESS_VALIDATION). */
  WLK_LOG_ID_VALIDATION = 1,
  /** WARNING: voxels of an upload were negative, not finite or too large and were replaced. */
  WLK_LOG_ID_VALUES_REPLACED = 2,
  /** WARNING: a view's frame got an engine's shadow map that it makes no use of (WlkLightShadow
   * says of which light it does). Once, until a frame uses one. */
  WLK_LOG_ID_SHADOW_MAP_UNUSED = 3,
  /** INFO: what wlkPrepare took. */
  WLK_LOG_ID_PREPARED = 4
};

/** A message to WlkContextInfo::log; it grows as all structures do. */
typedef struct WlkLogMessage {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  /** WLK_LOG_*. */
  uint32_t severity;
  /** WLK_LOG_ID_*. */
  uint32_t id;
  /** UTF-8, not translated, may change with any version. */
  const char* text;
} WlkLogMessage;

/** Receives messages, which live for the call: on the thread that calls Welkin, and on any that the
 *  driver chooses of WLK_LOG_ID_VALIDATION. Must not throw and not call Welkin. */
typedef void (*WlkLogCallback)(void* user, const WlkLogMessage* message);

/** What a context is made from. Chain WlkVulkanDeviceInfo (welkin_vulkan.h) for the engine's
 *  device, WlkHeadlessInfo for a device of Welkin's own, nothing for a CPU-only context. */
typedef struct WlkContextInfo {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  /** Frames that may be recorded before the first of them is complete. [1, 8], default 3. */
  uint32_t maxFramesInFlight;
  uint32_t reserved0;
  /** Host allocator. Default all null. */
  WlkAllocator allocator;
  /** Log receiver, and what it gets as `user`. Default null: silent. */
  WlkLogCallback log;
  void* logUser;
  /** Most device memory that the context allocates; what would exceed it fails with
   *  OUT_OF_DEVICE_MEMORY before the driver is asked, and names this field. Memory is taken in
   *  blocks of 16 MiB, and more for what is larger. bytes, 0: no limit. Default 0. */
  uint64_t deviceMemoryLimit;
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

/** Creates a context, or writes null. `apiVersion` is WLK_API_VERSION, which is compiled
 *  into the caller. Every library of the same major version takes it: an older one refuses what it
 *  does not know where it meets it (STRUCT_TOO_NEW, UNKNOWN_STRUCT, INVALID_ARGUMENT). Vulkan
 *  handles and functions of the chain must outlive the context. [F] Errors: INVALID_ARGUMENT,
 *  VERSION, UNKNOWN_STRUCT, STRUCT_TOO_NEW, NO_DEVICE, MISSING_FEATURE, OUT_OF_*, DEVICE_LOST. */
WLK_API WlkResult wlkCreateContext(uint32_t apiVersion, const WlkContextInfo* info,
                                   WlkContext* context);

/** Destroys a context and all that was made from it; null is allowed, a destroyed one is not. The
 * GPU must be done with every frame that was recorded. [C] */
WLK_API void wlkDestroyContext(WlkContext context);

enum {
  /** Queries alone. */
  WLK_MODE_CPU = 0,
  /** A device of Welkin's own (WlkHeadlessInfo). */
  WLK_MODE_HEADLESS = 1,
  /** The engine's device (WlkVulkanDeviceInfo). */
  WLK_MODE_ENGINE_DEVICE = 2
};

/** What a context can do, and on which device. */
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
  /** 1 if views may have WLK_COMPOSITE_BLEND (WLK_VULKAN_FEATURE_BLEND), else 0. */
  uint32_t blendSupported;
  uint32_t reserved0;
  /** Name of the device, "" in CPU mode. */
  char deviceName[WLK_MESSAGE_SIZE];
} WlkCapabilities;

/** Fills what the context can do. Errors: INVALID_HANDLE, INVALID_ARGUMENT. [C] */
WLK_API WlkResult wlkGetCapabilities(WlkContext context, WlkCapabilities* capabilities);

#ifdef __cplusplus
}
#endif

#endif
