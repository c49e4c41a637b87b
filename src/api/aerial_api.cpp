// SPDX-License-Identifier: MIT
// Aerial perspective in the engine's images.
#include <welkin/welkin_vulkan.h>

#include "api/engine_image.hpp"

namespace {

using namespace welkin;

WlkAerialPerspective checkedAerial(const WlkAerialPerspective* aerial) {
  const WlkAerialPerspective a = copyStruct(aerial, WLK_STRUCT_AERIAL_PERSPECTIVE);
  checkNoChain(aerial);
  checkRange(a.sType, "width", a.width, 1, 2048);
  checkRange(a.sType, "height", a.height, 1, 2048);
  checkRange(a.sType, "depth", a.depth, 2, 1024);
  checkRange(a.sType, "exponent", static_cast<double>(a.exponent), 1, 8);
  checkRange(a.sType, "distance", static_cast<double>(a.distance), 1, 1e7);
  return a;
}

TargetImage froxelImage(WlkContext_T& c, const WlkVulkanImage* image, const char* role,
                        const WlkAerialPerspective& aerial) {
  const WlkVulkanImage i = checkedEngineImage(image, role);
  checkImageSize(i, role, "aerial perspective", aerial.width, aerial.height, aerial.depth);
  if (i.format != VK_FORMAT_R16G16B16A16_SFLOAT && i.format != VK_FORMAT_R32G32B32A32_SFLOAT) {
    fail(WLK_ERROR_UNSUPPORTED_FORMAT, i.sType, role,
         "%s has VkFormat %d, expected R16G16B16A16_SFLOAT or R32G32B32A32_SFLOAT", role,
         static_cast<int>(i.format));
  }
  if (!c.device->supports(i.format, VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT)) {
    fail(WLK_ERROR_UNSUPPORTED_FORMAT, i.sType, role, "the device cannot store to VkFormat %d",
         static_cast<int>(i.format));
  }
  return importTarget(c, i, VK_IMAGE_VIEW_TYPE_3D);
}

}  // namespace

namespace welkin {

void importAerial(WlkContext_T& c, const ViewState& view, const WlkVulkanViewTargets& t,
                  ViewTargets& images) {
  if (t.aerialRadiance == nullptr && t.aerialTransmittance == nullptr) {
    return;
  }
  if (!view.aerial) {
    fail(WLK_ERROR_WRONG_STATE, WLK_STRUCT_VULKAN_VIEW_TARGETS, "aerialRadiance",
         "the view has no aerial perspective: call wlkSetAerialPerspective");
  }
  if (t.aerialRadiance == nullptr || t.aerialTransmittance == nullptr) {
    const char* missing = t.aerialRadiance == nullptr ? "aerialRadiance" : "aerialTransmittance";
    fail(WLK_ERROR_INVALID_ARGUMENT, WLK_STRUCT_VULKAN_VIEW_TARGETS, missing,
         "WlkVulkanViewTargets::%s is null, the other image of aerial perspective is not", missing);
  }
  images.aerialRadiance = froxelImage(c, t.aerialRadiance, "aerialRadiance", *view.aerial);
  images.aerialTransmittance =
      froxelImage(c, t.aerialTransmittance, "aerialTransmittance", *view.aerial);
  if (t.aerialRadiance->image == t.aerialTransmittance->image ||
      t.aerialRadiance->format != t.aerialTransmittance->format) {
    fail(WLK_ERROR_INVALID_ARGUMENT, WLK_STRUCT_VULKAN_VIEW_TARGETS, "aerialTransmittance",
         "radiance and transmittance need two images of one format");
  }
  images.aerialHalf = t.aerialRadiance->format == VK_FORMAT_R16G16B16A16_SFLOAT;
}

}  // namespace welkin

WlkResult wlkSetAerialPerspective(WlkContext context, WlkView view,
                                  const WlkAerialPerspective* aerial) {
  return guarded([&] {
    WlkContext_T& c = checkContext(context);
    if (c.mode != WLK_MODE_ENGINE_DEVICE) {
      fail(WLK_ERROR_WRONG_STATE, 0, "context",
           "wlkSetAerialPerspective needs an engine-device context");
    }
    ViewState& state = c.view(view);
    if (aerial == nullptr) {
      state.aerial.reset();
      return WLK_SUCCESS;
    }
    const WlkAerialPerspective value = checkedAerial(aerial);
    const bool same = state.aerial && state.aerial->width == value.width &&
                      state.aerial->height == value.height && state.aerial->depth == value.depth;
    state.prepared = state.prepared && same;
    state.aerial = value;
    return WLK_SUCCESS;
  });
}
