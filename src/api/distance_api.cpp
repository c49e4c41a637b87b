// SPDX-License-Identifier: MIT
// The volumes' distance in an image of the engine's.
#include <welkin/welkin_vulkan.h>

#include "api/engine_image.hpp"

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
  const WlkVulkanImage i = checkedEngineImage(t.volumeDistance, "volumeDistance");
  checkImageSize(i, "volumeDistance", "view", view.info.width, view.info.height);
  const bool half = i.format == VK_FORMAT_R16_SFLOAT || i.format == VK_FORMAT_R16G16_SFLOAT;
  const bool full = i.format == VK_FORMAT_R32_SFLOAT || i.format == VK_FORMAT_R32G32_SFLOAT;
  if (!(half || full) || !c.device->supports(i.format, VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT)) {
    fail(WLK_ERROR_UNSUPPORTED_FORMAT, i.sType, "volumeDistance",
         "volumeDistance has VkFormat %d, expected R16, R32, R16G16 or R32G32_SFLOAT that the "
         "device can store to",
         static_cast<int>(i.format));
  }
  images.volumeDistance = importTarget(c, i, VK_IMAGE_VIEW_TYPE_2D);
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
