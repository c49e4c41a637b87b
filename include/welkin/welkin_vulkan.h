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

/** What the engine's instance, device and images must have. */
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
  /** VkPhysicalDeviceFeatures, needed for WLK_COMPOSITE_BLEND only. */
  uint32_t dualSrcBlend;
  /** Usage of the engine's images by role. */
  VkImageUsageFlags depthUsage;
  VkImageUsageFlags colorInputUsage;
  VkImageUsageFlags storageTargetUsage;
  VkImageUsageFlags blendTargetUsage;
  VkImageUsageFlags volumeUsage;
  /** VkPhysicalDeviceFeatures, needed for WLK_COMPOSITE_BLEND only. */
  uint32_t fragmentStoresAndAtomics;
} WlkVulkanRequirements;

/** Fills the requirements. Besides them, the device must filter R32, R32G32 and R32G32B32A32 float
 *  images linearly. [F] */
WLK_API WlkResult wlkVulkanGetRequirements(WlkVulkanRequirements* requirements);

/** Chained to WlkContextInfo: the engine's device. All fields but pipelineCache are needed. */
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
  /** 1 if the device was created with dualSrcBlend. Default 0. */
  uint32_t dualSrcBlendEnabled;
  uint32_t reserved0;
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

/** An image of the engine. Welkin moves it from `before` to what it needs and on to `after`;
 *  `before.layout` must be true (UNDEFINED discards the contents). */
typedef struct WlkVulkanImage {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  VkImage image;
  VkFormat format;
  /** Pixels or voxels; depth 1 for 2-D images, the number of layers for a shadow map. */
  uint32_t width;
  uint32_t height;
  uint32_t depth;
  WlkVulkanImageState before;
  WlkVulkanImageState after;
} WlkVulkanImage;

/** What a view reads and writes. Extents must be the view's, except the shadow map's. */
typedef struct WlkVulkanViewTargets {
  uint32_t sType;
  uint32_t structSize;
  const void* next;
  /** The engine's depth buffer, 2-D, single-sampled; null: nothing opaque. Formats D16, D24S8,
   *  D32F, D32FS8, X8D24 (aspect DEPTH is read) or R32F. Default null. */
  const WlkVulkanImage* depth;
  /** COMPUTE: the engine's colour, sampled. Null or the same VkImage as `color`: read from
   *  `color` itself when it is given here, black when null. Default null. */
  const WlkVulkanImage* colorInput;
  /** COMPUTE: written. BLEND: blended onto. Default null. */
  const WlkVulkanImage* color;
  /** SEPARATE: written. Default null. */
  const WlkVulkanImage* radiance;
  const WlkVulkanImage* transmittance;
  /** The engine's shadow map and where it lies; both or none. Needs WLK_QUALITY_FLAG_LIGHT_SHADOWS.
   *  Default null. */
  const WlkLightShadow* lightShadow;
  /** 2-D of any size, single-sampled, with at least lightShadow->cascadeCount layers (`depth`);
   *  usage and formats as for `depth`. The image's first mip level is read. */
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
 *  R8_UNORM; the engine writes it in wlkVulkanCmdUpdate's command buffer order and keeps it alive
 *  until wlkVulkanForgetImage. Values that are negative or not finite count as 0. [C] */
WLK_API WlkResult wlkVulkanSetVolumeImage(WlkContext context, WlkVolume volume, uint32_t field,
                                          const WlkVulkanImage* image);

/** Drops the image views that Welkin made of an image; call it before destroying or recreating
 *  the image. Frames that use it must be complete. [C] */
WLK_API WlkResult wlkVulkanForgetImage(WlkContext context, VkImage image);

/** Records pending uploads. Outside a render pass, once per frame, before the views. After a change
 *  of planet, sky or fog without wlkPrepare it also solves for some of the new light, see there.
 * [C] Errors: WRONG_STATE without wlkBeginFrame; OUT_OF_* after such a change. */
WLK_API WlkResult wlkVulkanCmdUpdate(WlkContext context, VkCommandBuffer commandBuffer);

/** Records a view. Outside a render pass. Afterwards the command buffer's pipelines, descriptor
 *  sets, push constants and dynamic state are undefined. At most once per view and frame. [C]
 *  Errors: WRONG_STATE (also for a shadow map without the quality's flag), NOT_PREPARED,
 *  INVALID_ARGUMENT, UNSUPPORTED_FORMAT. */
WLK_API WlkResult wlkVulkanCmdRenderView(WlkContext context, VkCommandBuffer commandBuffer,
                                         WlkView view, const WlkVulkanViewTargets* targets);

/* ------------------------------------------------------------------------------- cloud shadows */

/** Writes the map to an image of its size (usage STORAGE), after wlkVulkanCmdUpdate and outside a
 *  render pass; at most once per map and frame. Where light, volumes, area and image are as they
 *  were, it records nothing but the change from before.layout to after.layout, if they differ: keep
 *  the image's contents, or give UNDEFINED to have them written anew. A field in an engine's image
 *  counts as changed each frame. Without light or volumes the map says so once. [C]
 *  Errors: WRONG_STATE, NOT_PREPARED, INVALID_ARGUMENT, UNSUPPORTED_FORMAT. */
WLK_API WlkResult wlkVulkanCmdRenderCloudShadow(WlkContext context, VkCommandBuffer commandBuffer,
                                                WlkCloudShadow map, const WlkVulkanImage* image);

#ifdef __cplusplus
}
#endif

#endif
