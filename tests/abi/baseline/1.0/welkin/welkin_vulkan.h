/* SPDX-License-Identifier: MIT
 *
 * Welkin on the engine's own Vulkan device. Welkin records into the engine's command buffers and
 * never submits, waits, or compiles while recording. It links no Vulkan: every entry point comes
 * through the engine's vkGetInstanceProcAddr.
 *
 * Define WELKIN_VULKAN_ALREADY_INCLUDED to supply the Vulkan types yourself.
 */
#ifndef WELKIN_WELKIN_VULKAN_H
#define WELKIN_WELKIN_VULKAN_H

#include "welkin.h"
#ifndef WELKIN_VULKAN_ALREADY_INCLUDED
#include <vulkan/vulkan_core.h>
#endif

#ifdef __cplusplus
extern "C" {
#endif

/** What the engine's instance, device and images must have. Every library of this major version
 * needs this and no more; later ones may become faster by features that are told in other ways. */
typedef struct WlkVulkanRequirements {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  /** Least version of instance and device: VK_API_VERSION_1_3. */
  uint32_t apiVersion;
  /** The queue family's flags: GRAPHICS and COMPUTE. */
  VkQueueFlags queueFlags;
  /** Features to enable (1 = needed): VkPhysicalDeviceVulkan13Features. */
  uint32_t synchronization2;
  uint32_t dynamicRendering;
  /** VkPhysicalDeviceFeatures, needed. */
  uint32_t shaderStorageImageWriteWithoutFormat;
  /** VkPhysicalDeviceFeatures, both needed for WLK_COMPOSITE_BLEND only
   *  (WLK_VULKAN_FEATURE_BLEND). */
  uint32_t dualSrcBlend;
  uint32_t fragmentStoresAndAtomics;
  /** Usage of the engine's images by role. */
  VkImageUsageFlags depthUsage;
  VkImageUsageFlags colorInputUsage;
  VkImageUsageFlags storageTargetUsage;
  VkImageUsageFlags blendTargetUsage;
  VkImageUsageFlags volumeUsage;
  uint32_t reserved0;
} WlkVulkanRequirements;

/** Fills the requirements. Besides them, the device must filter R32, R32G32 and R32G32B32A32 float
 *  images linearly. [F] */
WLK_API WlkResult wlkVulkanGetRequirements(WlkVulkanRequirements* requirements);

/** Features of the device that not every context needs. */
enum {
  /** dualSrcBlend and fragmentStoresAndAtomics of VkPhysicalDeviceFeatures: WLK_COMPOSITE_BLEND. */
  WLK_VULKAN_FEATURE_BLEND = 1u << 0
};

/** Chained to WlkContextInfo: the engine's device. Defaults are 0 and null; all fields but
 *  enabledFeatures and pipelineCache are needed. */
typedef struct WlkVulkanDeviceInfo {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  PFN_vkGetInstanceProcAddr getInstanceProcAddr;
  VkInstance instance;
  VkPhysicalDevice physicalDevice;
  VkDevice device;
  /** Version the instance and device were created for. At least VK_API_VERSION_1_3. */
  uint32_t apiVersion;
  /** Family of the queue that will run the command buffers. */
  uint32_t queueFamilyIndex;
  /** Bits WLK_VULKAN_FEATURE_* that the device was created with; others are refused. Default 0. */
  uint64_t enabledFeatures;
  /** May be VK_NULL_HANDLE. */
  VkPipelineCache pipelineCache;
} WlkVulkanDeviceInfo;

/** State of an image before or after Welkin's commands. */
typedef struct WlkVulkanImageState {
  VkImageLayout layout;
  uint32_t reserved0;
  VkPipelineStageFlags2 stages;
  VkAccessFlags2 access;
} WlkVulkanImageState;

/** A part of an engine's image: one mip level, and of 2-D arrays one or more layers. Welkin views
 *  and moves that part alone, from `before` to what it needs and on to `after`; no other mip level
 *  or layer is touched. `before` must be true: its layout is the part's (UNDEFINED discards what it
 *  holds), and what stages and access name is waited for. */
typedef struct WlkVulkanImage {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  /** Default null, which is refused. */
  VkImage image;
  /** Of the view; the image's, or one that it is compatible with. Default UNDEFINED. */
  VkFormat format;
  /** Texels of the mip level. Default 0. */
  uint32_t width;
  uint32_t height;
  /** Of 3-D images, else 1. Default 1. */
  uint32_t depth;
  /** [0, 31], default 0. */
  uint32_t mipLevel;
  /** First layer of a 2-D array, else 0. [0, 65535], default 0. */
  uint32_t baseArrayLayer;
  /** Layers from it on: 1, of an engine's shadow map up to 2048. Default 1. */
  uint32_t layerCount;
  uint32_t reserved0;
  /** Default UNDEFINED, no stages, no access. */
  WlkVulkanImageState before;
  /** A real layout. Default UNDEFINED, which is refused. */
  WlkVulkanImageState after;
} WlkVulkanImage;

/** What a view reads and writes. Extents must be the view's, but for the shadow map's and those of
 *  aerial perspective, which are WlkAerialPerspective's width x height x depth. */
typedef struct WlkVulkanViewTargets {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  /** The engine's depth buffer, 2-D, single-sampled; null: nothing opaque. Formats D16, D24S8,
   *  D32F, D32FS8, X8D24 (aspect DEPTH is read) or R32F. Default null. */
  const WlkVulkanImage* depth;
  /** COMPUTE: the engine's colour, sampled. Null or the same part (image, mip level, layer) as
   *  `color`: read from `color` itself when it is given here, black when null. Default null. */
  const WlkVulkanImage* colorInput;
  /** COMPUTE: written. BLEND: blended onto. Default null. */
  const WlkVulkanImage* color;
  /** SEPARATE: written; two images. Default null. */
  const WlkVulkanImage* radiance;
  const WlkVulkanImage* transmittance;
  /** The engine's shadow map and where it lies; both or none. Needs WLK_QUALITY_FLAG_LIGHT_SHADOWS.
   *  Default null. */
  const WlkLightShadow* lightShadow;
  /** 2-D of any size, single-sampled, with at least lightShadow->cascadeCount layers; usage and
   *  formats as for `depth`. */
  const WlkVulkanImage* shadowMap;
  /** Aerial perspective (wlkSetAerialPerspective), 3-D, written in any mode: premultiplied
   *  radiance, times preExposure and in the view's colours, and RGB transmittance; alpha 1. Of one
   *  format, R16G16B16A16_SFLOAT or R32G32B32A32_SFLOAT. Both or neither; null: nothing is recorded
   *  for it. Default null. */
  const WlkVulkanImage* aerialRadiance;
  const WlkVulkanImage* aerialTransmittance;
  /** Distance of the volumes (wlkSetVolumeDistance), written in any mode. R: mean distance
   *  from the eye at which they hide what lies behind them, along the ray, m; 0 where there are
   *  none. G, of formats that have it: the part of the background that they hide, [0, 1].
   *  R16_SFLOAT, R32_SFLOAT, R16G16_SFLOAT or R32G32_SFLOAT. Default null. */
  const WlkVulkanImage* volumeDistance;
} WlkVulkanViewTargets;

/** Makes a field of a volume read the engine's own 3-D image instead of Welkin's copy; null goes
 *  back. The image has the volume's size and a format R16_SFLOAT, R32_SFLOAT, R16_UNORM or
 *  R8_UNORM. Unlike other images Welkin never moves it: both layouts are SHADER_READ_ONLY_OPTIMAL,
 *  stages and access are not looked at, and the engine makes the barriers between its writes and
 *  the compute and fragment shaders of Welkin's commands, which come later in submission order. It
 *  lives until wlkVulkanForgetImage. Values that are negative or not finite count as 0. Needs
 *  wlkPrepare where it takes the place of bricks, or bricks its, and where rays leap
 *  (WlkVolumeState::leaps): nobody knows where the image is empty. [C] Errors:
 *  WRONG_STATE outside engine-device mode, INVALID_HANDLE, INVALID_ARGUMENT (field, size, layouts),
 *  UNSUPPORTED_FORMAT, OUT_OF_*. */
WLK_API WlkResult wlkVulkanSetVolumeImage(WlkContext context, WlkVolume volume, uint32_t field,
                                          const WlkVulkanImage* image);

/** Drops the image views that Welkin made of an image; call it before destroying or recreating
 *  the image. Fields that read it have Welkin's copy again, as by wlkVulkanSetVolumeImage with
 *  null, and may need wlkPrepare as there. Frames that use it must be complete. [C] Errors:
 *  WRONG_STATE in CPU mode. */
WLK_API WlkResult wlkVulkanForgetImage(WlkContext context, VkImage image);

/* ---------------------------------------------------------------------------------- recording */

/* What a successful wlkVulkanCmd... call recorded must be executed, once, in the order of recording
 * and on a queue of the device info's family: while recording, Welkin takes uploads for done,
 * images for written and light for computed, and later frames build on that. If the frame is given
 * up after a call succeeded (a later one fails, the swapchain is out of date), submit the commands
 * all the same. So give wlkVulkanCmdUpdate a command buffer that will be submitted whatever becomes
 * of the views, for example one of its own. A call that fails with INVALID_*, UNKNOWN_STRUCT,
 * STRUCT_TOO_NEW, UNSUPPORTED_FORMAT, NOT_PREPARED or WRONG_STATE has recorded nothing and changed
 * nothing. After OUT_OF_* and DEVICE_LOST the command buffer holds what is incomplete: throw that
 * away, but what earlier calls recorded must run. */

/** Records pending uploads. Outside a render pass, in each frame that wlkBeginFrame begins, before
 *  the views; once more where something was created, uploaded for the first time or prepared since,
 *  or the views that follow are refused (WRONG_STATE). After a change
 *  of planet, sky or fog, or of the shares of a volume's fields or its optical depth, without
 *  wlkPrepare it also solves for some of the new light, see there. Record it even in frames that
 *  draw no view, or uploads wait. [C] Errors: WRONG_STATE before the first wlkBeginFrame; OUT_OF_*
 *  after such a change. */
WLK_API WlkResult wlkVulkanCmdUpdate(WlkContext context, VkCommandBuffer commandBuffer);

/** Records a view. Outside a render pass. Afterwards the command buffer's pipelines, descriptor
 *  sets, push constants and dynamic state are undefined. At most once per view and frame. [C]
 *  Errors: WRONG_STATE (also for a shadow map without the quality's flag, and while what was
 *  created or first uploaded waits for wlkVulkanCmdUpdate), NOT_PREPARED,
 *  INVALID_ARGUMENT, UNSUPPORTED_FORMAT, OUT_OF_*, DEVICE_LOST. */
WLK_API WlkResult wlkVulkanCmdRenderView(WlkContext context, VkCommandBuffer commandBuffer,
                                         WlkView view, const WlkVulkanViewTargets* targets);

/* ------------------------------------------------------------------------------- cloud shadows */

/** Writes the map to an image of its size (usage STORAGE), after wlkVulkanCmdUpdate and outside a
 *  render pass; at most once per map and frame. Where light, volumes, area and image are as they
 *  were, it records nothing but the change from before.layout to after.layout, if they differ: keep
 *  the image's contents, or give UNDEFINED to have them written anew. A field in an engine's image
 *  counts as changed each frame. Without light or volumes the map says so once. [C]
 *  Errors: WRONG_STATE, NOT_PREPARED, INVALID_ARGUMENT, UNSUPPORTED_FORMAT, OUT_OF_*, DEVICE_LOST.
 */
WLK_API WlkResult wlkVulkanCmdRenderCloudShadow(WlkContext context, VkCommandBuffer commandBuffer,
                                                WlkCloudShadow map, const WlkVulkanImage* image);

#ifdef __cplusplus
}
#endif

#endif
