// SPDX-License-Identifier: MIT
#include "api/light_shadow_input.hpp"

#include <cmath>
#include <cstring>
#include <utility>

namespace welkin {

LightShadow lightShadowOf(const WlkContext_T& c, const ViewState& view,
                          const WlkLightShadow* shadow) {
  const WlkLightShadow s = copyStruct(shadow, WLK_STRUCT_LIGHT_SHADOW);
  checkNoChain(shadow);
  if ((view.quality.flags & WLK_QUALITY_FLAG_LIGHT_SHADOWS) == 0) {
    fail(WLK_ERROR_WRONG_STATE, s.sType, "lightShadow",
         "a shadow map needs WLK_QUALITY_FLAG_LIGHT_SHADOWS in WlkQuality::flags of the view");
  }
  checkRange(s.sType, "cascadeCount", s.cascadeCount, 1, WLK_MAX_SHADOW_CASCADES);
  checkRange(s.sType, "light", s.light, 0, MAX_LIGHTS - 1);
  for (const double x : s.origin) {
    checkRange(s.sType, "origin", x, -1e9, 1e9);
  }
  checkRange(s.sType, "bias", static_cast<double>(s.bias), 0, 1e6);
  if (s.light >= c.air.lightCount) {
    LightShadow none;
    none.light = s.light;
    return none;
  }
  const float* direction = c.air.lights[s.light].direction;
  return checkedLightShadow(s,
                            glm::normalize(glm::dvec3(direction[0], direction[1], direction[2])));
}

void stageShadowDepth(WlkContext_T& c, ViewState& view, const WlkHeadlessInputs& targets,
                      uint32_t cascades) {
  const uint32_t type = WLK_STRUCT_HEADLESS_INPUTS;
  checkPointer(targets.shadowDepth, "shadowDepth");
  checkRange(type, "shadowWidth", targets.shadowWidth, 1, 8192);
  checkRange(type, "shadowHeight", targets.shadowHeight, 1, 8192);
  const size_t values = size_t{targets.shadowWidth} * targets.shadowHeight * cascades;
  checkRoom(type, "shadowDepthSize", targets.shadowDepthSize, values * sizeof(float));
  for (size_t i = 0; i < values; ++i) {
    if (!std::isfinite(targets.shadowDepth[i])) {
      fail(WLK_ERROR_INVALID_ARGUMENT, type, "shadowDepth", "shadowDepth[%zu] is not finite", i);
    }
  }
  ViewResources& r = view.resources;
  const vk::ImageInfo& old = r.shadowDepth.info();
  if (!r.shadowDepth || old.extent.width != targets.shadowWidth ||
      old.extent.height != targets.shadowHeight || old.layers != cascades) {
    vk::ImageInfo info;
    info.format = VK_FORMAT_R32_SFLOAT;
    info.extent = {targets.shadowWidth, targets.shadowHeight, 1};
    info.layers = cascades;
    info.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    info.arrayView = true;
    vk::Image image(*c.device, info);
    vk::Buffer upload(*c.device, values * sizeof(float), VK_BUFFER_USAGE_TRANSFER_SRC_BIT, true);
    // No frame runs: headless contexts wait for each.
    r.shadowDepth = std::move(image);
    r.shadowUpload = std::move(upload);
    c.forgetBindings();
  }
  std::memcpy(r.shadowUpload.data(), targets.shadowDepth, values * sizeof(float));
}

}  // namespace welkin
