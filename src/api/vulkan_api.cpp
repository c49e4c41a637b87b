// SPDX-License-Identifier: MIT
// The engine's device: requirements, its images, recording into its command buffers.
#include <welkin/welkin_vulkan.h>

#include <algorithm>

#include "api/context.hpp"
#include "api/engine_image.hpp"
#include "api/light_shadow_input.hpp"
#include "api/surface_data.hpp"

namespace {

using namespace welkin;

VkImageAspectFlags depthAspects(VkFormat format) {
  switch (format) {
    case VK_FORMAT_D16_UNORM:
    case VK_FORMAT_D32_SFLOAT:
    case VK_FORMAT_X8_D24_UNORM_PACK32:
      return VK_IMAGE_ASPECT_DEPTH_BIT;
    case VK_FORMAT_D24_UNORM_S8_UINT:
    case VK_FORMAT_D32_SFLOAT_S8_UINT:
      return VK_IMAGE_ASPECT_DEPTH_BIT | VK_IMAGE_ASPECT_STENCIL_BIT;
    case VK_FORMAT_R32_SFLOAT:
      return VK_IMAGE_ASPECT_COLOR_BIT;
    default:
      return 0;
  }
}

TargetImage colorTarget(WlkContext_T& c, const WlkVulkanImage* image, const char* role,
                        const ViewState& view, bool formatMatters) {
  if (image == nullptr) {
    fail(WLK_ERROR_INVALID_ARGUMENT, WLK_STRUCT_VULKAN_VIEW_TARGETS, role,
         "WlkVulkanViewTargets::%s is null", role);
  }
  const WlkVulkanImage value = checkedEngineImage(image, role);
  checkImageSize(value, role, "view", view.info.width, view.info.height);
  if (formatMatters && value.format != targetFormat(view.info.targetFormat)) {
    fail(WLK_ERROR_UNSUPPORTED_FORMAT, WLK_STRUCT_VULKAN_IMAGE, role,
         "%s has VkFormat %d, WlkViewInfo::targetFormat asks for %d", role,
         static_cast<int>(value.format), static_cast<int>(targetFormat(view.info.targetFormat)));
  }
  return importTarget(c, value, VK_IMAGE_VIEW_TYPE_2D);
}

// Throws if the format is none that Welkin reads as depth.
VkImageAspectFlags checkedDepth(const WlkVulkanImage& image, const char* role) {
  const VkImageAspectFlags aspects = depthAspects(image.format);
  if (aspects == 0) {
    fail(WLK_ERROR_UNSUPPORTED_FORMAT, WLK_STRUCT_VULKAN_IMAGE, role,
         "%s has VkFormat %d, which is no depth format Welkin reads", role,
         static_cast<int>(image.format));
  }
  return aspects;
}

void importShadowMap(WlkContext_T& c, const ViewState& view, const WlkVulkanViewTargets& t,
                     ViewTargets& targets) {
  if (t.lightShadow == nullptr || t.shadowMap == nullptr) {
    const char* missing = t.shadowMap == nullptr ? "shadowMap" : "lightShadow";
    fail(WLK_ERROR_INVALID_ARGUMENT, WLK_STRUCT_VULKAN_VIEW_TARGETS, missing,
         "WlkVulkanViewTargets::%s is null: a shadow map needs both", missing);
  }
  targets.lightShadow = lightShadowOf(c, view, t.lightShadow);
  const WlkVulkanImage image = checkedEngineImage(t.shadowMap, "shadowMap", 2048);
  if (image.depth != 1 || image.layerCount < t.lightShadow->cascadeCount) {
    fail(WLK_ERROR_INVALID_ARGUMENT, image.sType, "shadowMap",
         "shadowMap has the depth %u and %u layers, expected 1 and WlkLightShadow::cascadeCount %u",
         image.depth, image.layerCount, t.lightShadow->cascadeCount);
  }
  const VkImageAspectFlags aspects = checkedDepth(image, "shadowMap");
  targets.shadowMap =
      importTarget(c, image, VK_IMAGE_VIEW_TYPE_2D_ARRAY,
                   aspects & ~VkImageAspectFlags{VK_IMAGE_ASPECT_STENCIL_BIT}, aspects);
}

bool sameImage(const WlkVulkanImage& a, const WlkVulkanImage& b) {
  return a.image == b.image && a.mipLevel == b.mipLevel && a.baseArrayLayer == b.baseArrayLayer;
}

ViewTargets importTargets(WlkContext_T& c, const ViewState& view, const WlkVulkanViewTargets& t) {
  ViewTargets targets;
  if (t.lightShadow != nullptr || t.shadowMap != nullptr) {
    importShadowMap(c, view, t, targets);
  }
  if (t.depth != nullptr) {
    const WlkVulkanImage depth = checkedEngineImage(t.depth, "depth");
    checkImageSize(depth, "depth", "view", view.info.width, view.info.height);
    const VkImageAspectFlags aspects = checkedDepth(depth, "depth");
    targets.depth =
        importTarget(c, depth, VK_IMAGE_VIEW_TYPE_2D,
                     aspects & ~VkImageAspectFlags{VK_IMAGE_ASPECT_STENCIL_BIT}, aspects);
  }
  if (view.info.composite == WLK_COMPOSITE_SEPARATE) {
    targets.target0 = colorTarget(c, t.radiance, "radiance", view, true);
    targets.target1 = colorTarget(c, t.transmittance, "transmittance", view, true);
    if (sameImage(*t.radiance, *t.transmittance)) {
      fail(WLK_ERROR_INVALID_ARGUMENT, t.sType, "transmittance",
           "WlkVulkanViewTargets::transmittance is the image of radiance");
    }
    return targets;
  }
  targets.target0 = colorTarget(c, t.color, "color", view, true);
  if (view.info.composite == WLK_COMPOSITE_COMPUTE && t.colorInput != nullptr) {
    if (sameImage(checkedEngineImage(t.colorInput, "colorInput"), *t.color)) {
      targets.inputIsTarget = true;
    } else {
      targets.colorInput = colorTarget(c, t.colorInput, "colorInput", view, false);
    }
  }
  return targets;
}

}  // namespace

namespace welkin {

WlkContext_T& requireFrame(WlkContext context, VkCommandBuffer commands, const char* what) {
  WlkContext_T& c = checkContext(context);
  c.requireDevice(what);
  checkPointer(commands, "commandBuffer");
  if (c.mode != WLK_MODE_ENGINE_DEVICE || c.frameIndex == 0) {
    fail(WLK_ERROR_WRONG_STATE, 0, "context", "%s needs an engine-device context and wlkBeginFrame",
         what);
  }
  return c;
}

// Whether every image that descriptors will name has been written once.
bool everythingUploaded(const WlkContext_T& c) {
  const auto blank = [](const vk::Image& image) {
    return image && image.layout == VK_IMAGE_LAYOUT_UNDEFINED;
  };
  if (blank(c.dummy2d) || blank(c.skyLight.moments) || blank(c.skyLight.fog)) {
    return false;
  }
  for (uint32_t i = 0; i < c.volumes.slotCount(); ++i) {
    const VolumeState* volume = c.volumes.at(i);
    if (volume == nullptr) {
      continue;
    }
    if (blank(volume->pages) || blank(volume->leaps) ||
        std::any_of(volume->tables.begin(), volume->tables.end(),
                    [&](const ScatteringTable& table) { return blank(table.image); }) ||
        std::any_of(volume->fields.begin(), volume->fields.end(),
                    [&](const FieldState& field) { return blank(field.image); })) {
      return false;
    }
  }
  return surfacesUploaded(c);
}

}  // namespace welkin

WlkResult wlkVulkanGetRequirements(WlkVulkanRequirements* requirements) {
  return guarded([&] {
    WlkVulkanRequirements value = startOutput(requirements, WLK_STRUCT_VULKAN_REQUIREMENTS);
    value.apiVersion = VK_API_VERSION_1_3;
    value.queueFlags = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    value.synchronization2 = 1;
    value.dynamicRendering = 1;
    value.shaderStorageImageWriteWithoutFormat = 1;
    value.dualSrcBlend = 1;
    value.fragmentStoresAndAtomics = 1;
    value.depthUsage = VK_IMAGE_USAGE_SAMPLED_BIT;
    value.colorInputUsage = VK_IMAGE_USAGE_SAMPLED_BIT;
    value.storageTargetUsage = VK_IMAGE_USAGE_STORAGE_BIT;
    value.blendTargetUsage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    value.volumeUsage = VK_IMAGE_USAGE_SAMPLED_BIT;
    finishOutput(value, requirements);
    return WLK_SUCCESS;
  });
}

// Passes read an image and bricks differently.
static void keepImage(WlkContext_T& c, VolumeState& volume, FieldState& field,
                      const std::optional<WlkVulkanImage>& image) {
  const uint32_t kind = volume.fieldKind();
  field.external = image;
  if (volume.fieldKind() != kind) {
    c.invalidate();
  }
}

WlkResult wlkVulkanSetVolumeImage(WlkContext context, WlkVolume volume, uint32_t field,
                                  const WlkVulkanImage* image) {
  return guarded([&] {
    WlkContext_T& c = checkContext(context);
    VolumeState& state = c.volume(volume);
    if (c.mode != WLK_MODE_ENGINE_DEVICE) {
      fail(WLK_ERROR_WRONG_STATE, 0, "context",
           "wlkVulkanSetVolumeImage needs an engine-device context");
    }
    c.requireDevice("wlkVulkanSetVolumeImage");
    checkRange(WLK_STRUCT_VULKAN_IMAGE, "field", field, 0, state.fieldCount - 1);
    if (image == nullptr) {
      keepImage(c, state, state.fields[field], std::nullopt);
      return WLK_SUCCESS;
    }
    const WlkVulkanImage i = checkedEngineImage(image, "volume image");
    checkImageSize(i, "volume image", "volume", state.size[0], state.size[1], state.size[2]);
    if (i.format != VK_FORMAT_R16_SFLOAT && i.format != VK_FORMAT_R32_SFLOAT &&
        i.format != VK_FORMAT_R16_UNORM && i.format != VK_FORMAT_R8_UNORM) {
      fail(WLK_ERROR_UNSUPPORTED_FORMAT, i.sType, "format",
           "volume images have R16_SFLOAT, R32_SFLOAT, R16_UNORM or R8_UNORM, not VkFormat %d",
           static_cast<int>(i.format));
    }
    if (i.before.layout != VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL ||
        i.after.layout != VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL) {
      fail(WLK_ERROR_INVALID_ARGUMENT, i.sType, "before",
           "a volume image stays in VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL");
    }
    importView(c, i, VK_IMAGE_VIEW_TYPE_3D);
    keepImage(c, state, state.fields[field], i);
    return WLK_SUCCESS;
  });
}

WlkResult wlkVulkanForgetImage(WlkContext context, VkImage image) {
  return guarded([&] {
    WlkContext_T& c = checkContext(context);
    // Like all that destroys, of a lost device as well.
    if (!c.device) {
      fail(WLK_ERROR_WRONG_STATE, 0, "context", "wlkVulkanForgetImage needs a device");
    }
    vk::Device& device = *c.device;
    for (uint32_t i = 0; i < c.volumes.slotCount(); ++i) {
      if (VolumeState* volume = c.volumes.at(i)) {
        for (FieldState& field : volume->fields) {
          if (field.external && field.external->image == image) {
            keepImage(c, *volume, field, std::nullopt);
          }
        }
      }
    }
    for (size_t i = 0; i < c.imported.size();) {
      if (c.imported[i].image == image) {
        device.vk().DestroyImageView(device.handle(), c.imported[i].view, nullptr);
        c.imported[i] = c.imported.back();
        c.imported.pop_back();
      } else {
        ++i;
      }
    }
    for (uint32_t i = 0; i < c.shadowMaps.slotCount(); ++i) {
      ShadowMapState* map = c.shadowMaps.at(i);
      if (map != nullptr && map->image == image) {
        map->image = VK_NULL_HANDLE;
      }
    }
    c.forgetBindings();
    return WLK_SUCCESS;
  });
}

WlkResult wlkVulkanCmdUpdate(WlkContext context, VkCommandBuffer commandBuffer) {
  return guarded([&] {
    WlkContext_T& c = requireFrame(context, commandBuffer, "wlkVulkanCmdUpdate");
    recordUpdate(c, commandBuffer);
    return WLK_SUCCESS;
  });
}

WlkResult wlkVulkanCmdRenderView(WlkContext context, VkCommandBuffer commandBuffer, WlkView view,
                                 const WlkVulkanViewTargets* targets) {
  return guarded([&] {
    WlkContext_T& c = requireFrame(context, commandBuffer, "wlkVulkanCmdRenderView");
    ViewState& state = c.view(view);
    const WlkVulkanViewTargets t = copyStruct(targets, WLK_STRUCT_VULKAN_VIEW_TARGETS);
    checkNoChain(targets);
    if (!state.prepared) {
      fail(WLK_ERROR_NOT_PREPARED, 0, "view", "call wlkPrepare before recording");
    }
    if (state.lastFrame == c.frameIndex) {
      fail(WLK_ERROR_WRONG_STATE, 0, "view", "the view was recorded in this frame already");
    }
    if (!everythingUploaded(c)) {
      fail(WLK_ERROR_WRONG_STATE, 0, "context", "record wlkVulkanCmdUpdate before the views");
    }
    ViewTargets images = importTargets(c, state, t);
    importAerial(c, state, t, images);
    importDistance(c, state, t, images);
    recordFrame(c, commandBuffer, state, images);
    return WLK_SUCCESS;
  });
}
