// SPDX-License-Identifier: MIT
// The volumes' distance in an image of the engine's.
#include <welkin/welkin_vulkan.h>

#include "api/context.hpp"

namespace welkin {

void importDistance(WlkContext_T& c, const ViewState& view, const WlkVulkanViewTargets& t,
                    ViewTargets& images) {
  if (t.volumeDistance == nullptr) {
    return;
  }
  if (!view.volumeDistance) {
    fail(WLK_ERROR_WRONG_STATE, WLK_STRUCT_VULKAN_VIEW_TARGETS, "volumeDistance",
         "the view does not tell the volumes' distance: call wlkSetVolumeDistance");
  }
  const WlkVulkanImage i = copyStruct(t.volumeDistance, WLK_STRUCT_VULKAN_IMAGE);
  checkNoChain(t.volumeDistance);
  if (i.image == VK_NULL_HANDLE) {
    fail(WLK_ERROR_INVALID_ARGUMENT, i.sType, "volumeDistance",
         "WlkVulkanImage::image of volumeDistance is null");
  }
  if (i.width != view.info.width || i.height != view.info.height) {
    fail(WLK_ERROR_INVALID_ARGUMENT, i.sType, "volumeDistance",
         "volumeDistance has %u x %u pixels, the view %u x %u", i.width, i.height, view.info.width,
         view.info.height);
  }
  if (i.after.layout == VK_IMAGE_LAYOUT_UNDEFINED ||
      i.after.layout == VK_IMAGE_LAYOUT_PREINITIALIZED) {
    fail(WLK_ERROR_INVALID_ARGUMENT, i.sType, "volumeDistance",
         "volumeDistance: after.layout must be a real layout");
  }
  const bool half = i.format == VK_FORMAT_R16_SFLOAT || i.format == VK_FORMAT_R16G16_SFLOAT;
  const bool full = i.format == VK_FORMAT_R32_SFLOAT || i.format == VK_FORMAT_R32G32_SFLOAT;
  if (!(half || full) || !c.device->supports(i.format, VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT)) {
    fail(WLK_ERROR_UNSUPPORTED_FORMAT, i.sType, "volumeDistance",
         "volumeDistance has VkFormat %d, expected R16, R32, R16G16 or R32G32_SFLOAT that the "
         "device can store to",
         static_cast<int>(i.format));
  }
  images.volumeDistance.image = i.image;
  images.volumeDistance.view = importView(c, i, VK_IMAGE_VIEW_TYPE_2D, VK_IMAGE_ASPECT_COLOR_BIT);
  images.volumeDistance.before = i.before;
  images.volumeDistance.after = i.after;
  images.distanceHalf = half;
}

}  // namespace welkin

WlkResult wlkSetVolumeDistance(WlkContext context, WlkView view, uint32_t enabled) {
  using namespace welkin;
  return guarded([&] {
    WlkContext_T& c = checkContext(context);
    if (c.mode != WLK_MODE_ENGINE_DEVICE) {
      fail(WLK_ERROR_WRONG_STATE, 0, "context",
           "wlkSetVolumeDistance needs an engine-device context");
    }
    ViewState& state = c.view(view);
    if (enabled > 1) {
      fail(WLK_ERROR_INVALID_ARGUMENT, 0, "enabled", "enabled is %u, expected 0 or 1", enabled);
    }
    if (enabled == 1 && !state.volumeDistance) {
      state.prepared = false;
    }
    state.volumeDistance = enabled == 1;
    return WLK_SUCCESS;
  });
}
