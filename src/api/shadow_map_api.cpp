// SPDX-License-Identifier: MIT
// Maps of the volumes' shadow in the engine's images.
#include <welkin/welkin_vulkan.h>

#include <cstring>

#include "api/context.hpp"
#include "api/engine_image.hpp"

namespace {

using namespace welkin;

WlkCloudShadowInfo checkedInfo(const WlkCloudShadowInfo* info) {
  const WlkCloudShadowInfo i = copyStruct(info, WLK_STRUCT_CLOUD_SHADOW_INFO);
  checkNoChain(info);
  checkRange(i.sType, "width", i.width, 1, 8192);
  checkRange(i.sType, "height", i.height, 1, 8192);
  checkRange(i.sType, "content", i.content, WLK_CLOUD_SHADOW_OPTICAL_DEPTH, WLK_CLOUD_SHADOW_LAYER);
  checkRange(i.sType, "light", i.light, 0, MAX_LIGHTS - 1);
  for (const double x : i.center) {
    checkRange(i.sType, "center", x, -1e9, 1e9);
  }
  for (const double x : i.extent) {
    checkRange(i.sType, "extent", x, 1, 1e7);
  }
  checkRange(i.sType, "maxSamples", i.maxSamples, 8, 4096);
  return i;
}

ShadowMapState& mapOf(const WlkContext_T& c, WlkCloudShadow handle) {
  ShadowMapState* found = c.shadowMaps.find(handle.id);
  if (found == nullptr) {
    fail(WLK_ERROR_INVALID_HANDLE, 0, "map", "no such cloud shadow");
  }
  return *found;
}

bool isHalf(VkFormat format) {
  return format == VK_FORMAT_R16_SFLOAT || format == VK_FORMAT_R16G16B16A16_SFLOAT;
}

WlkVulkanImage checkedImage(const WlkContext_T& c, const WlkVulkanImage* image,
                            const WlkCloudShadowInfo& info) {
  const WlkVulkanImage i = checkedEngineImage(image, "image");
  checkImageSize(i, "image", "cloud shadow", info.width, info.height);
  const bool depth = info.content == WLK_CLOUD_SHADOW_OPTICAL_DEPTH;
  const bool fits = depth ? i.format == VK_FORMAT_R16_SFLOAT || i.format == VK_FORMAT_R32_SFLOAT
                          : i.format == VK_FORMAT_R16G16B16A16_SFLOAT ||
                                i.format == VK_FORMAT_R32G32B32A32_SFLOAT;
  if (!fits) {
    fail(WLK_ERROR_UNSUPPORTED_FORMAT, i.sType, "format",
         "cloud shadows of content %u have %s or %s_SFLOAT, not VkFormat %d", info.content,
         depth ? "R16" : "R16G16B16A16", depth ? "R32" : "R32G32B32A32",
         static_cast<int>(i.format));
  }
  if (!c.device->supports(i.format, VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT)) {
    fail(WLK_ERROR_UNSUPPORTED_FORMAT, i.sType, "format", "the device cannot store to VkFormat %d",
         static_cast<int>(i.format));
  }
  return i;
}

// The light, if it shines.
const WlkLight* lightOf(const WlkContext_T& c, uint32_t index) {
  if (index >= c.air.lightCount) {
    return nullptr;
  }
  const WlkLight& light = c.air.lights[index];
  const bool shines = light.irradiance[0] > 0 || light.irradiance[1] > 0 || light.irradiance[2] > 0;
  return shines ? &light : nullptr;
}

void gatherCasters(WlkContext_T& c) {
  c.shadowCasters.clear();
  for (uint32_t i = 0; i < c.volumes.slotCount(); ++i) {
    const VolumeState* volume = c.volumes.at(i);
    if (volume == nullptr) {
      continue;
    }
    ShadowCaster caster;
    caster.id = c.volumes.idOf(i);
    caster.state = volume;
    for (uint32_t f = 0; f < volume->fieldCount; ++f) {
      if (volume->fields[f].external) {
        caster.externalViews[f] = importView(c, *volume->fields[f].external, VK_IMAGE_VIEW_TYPE_3D);
      }
    }
    c.shadowCasters.push_back(caster);  // reserved
  }
}

WlkContext_T& engineContext(WlkContext context, const char* what) {
  WlkContext_T& c = checkContext(context);
  if (c.mode != WLK_MODE_ENGINE_DEVICE) {
    fail(WLK_ERROR_WRONG_STATE, 0, "context", "%s needs an engine-device context", what);
  }
  return c;
}

}  // namespace

namespace welkin {

void retireShadowMap(WlkContext_T& c, ShadowMapState& map) {
  if (map.resources.slots.empty()) {
    return;
  }
  Retired& entry = c.retired.emplace_back(&c.memory);
  entry.frame = c.frameIndex;
  std::swap(entry.shadowMap, map.resources);
}

void prepareShadowMaps(WlkContext_T& c, std::span<const uint32_t> fieldKinds) {
  for (uint32_t i = 0; i < c.shadowMaps.slotCount(); ++i) {
    ShadowMapState* map = c.shadowMaps.at(i);
    if (map == nullptr || map->prepared) {
      continue;
    }
    c.retired.reserve(c.retired.size() + 1);
    ShadowMapResources made(&c.memory);
    prepareShadowMap(*c.device, *c.pipelines, map->info, c.volumes.count(), c.maxFramesInFlight,
                     fieldKinds, made);
    retireShadowMap(c, *map);
    std::swap(map->resources, made);
    map->prepared = true;
  }
}

}  // namespace welkin

WlkResult wlkCreateCloudShadow(WlkContext context, const WlkCloudShadowInfo* info,
                               WlkCloudShadow* map) {
  return guarded([&] {
    WlkContext_T& c = engineContext(context, "wlkCreateCloudShadow");
    checkPointer(map, "map");
    const WlkCloudShadowInfo value = checkedInfo(info);
    c.requireDevice("wlkCreateCloudShadow");
    const uint64_t id = c.shadowMaps.create(&c.memory);
    c.shadowMaps.find(id)->info = value;
    map->id = id;
    return WLK_SUCCESS;
  });
}

WlkResult wlkSetCloudShadow(WlkContext context, WlkCloudShadow map,
                            const WlkCloudShadowInfo* info) {
  return guarded([&] {
    WlkContext_T& c = checkContext(context);
    ShadowMapState& state = mapOf(c, map);
    const WlkCloudShadowInfo value = checkedInfo(info);
    const WlkCloudShadowInfo& old = state.info;
    if (value.width != old.width || value.height != old.height || value.content != old.content) {
      state.prepared = false;
    }
    state.info = value;
    return WLK_SUCCESS;
  });
}

WlkResult wlkDestroyCloudShadow(WlkContext context, WlkCloudShadow map) {
  return guarded([&] {
    WlkContext_T& c = checkContext(context);
    retireShadowMap(c, mapOf(c, map));
    c.shadowMaps.destroy(map.id);
    c.collect();
    return WLK_SUCCESS;
  });
}

WlkResult wlkVulkanCmdRenderCloudShadow(WlkContext context, VkCommandBuffer commandBuffer,
                                        WlkCloudShadow map, const WlkVulkanImage* image) {
  return guarded([&] {
    WlkContext_T& c = requireFrame(context, commandBuffer, "wlkVulkanCmdRenderCloudShadow");
    ShadowMapState& state = mapOf(c, map);
    const WlkVulkanImage value = checkedImage(c, image, state.info);
    if (!state.prepared) {
      fail(WLK_ERROR_NOT_PREPARED, 0, "map", "call wlkPrepare before recording");
    }
    if (state.lastFrame == c.frameIndex) {
      fail(WLK_ERROR_WRONG_STATE, 0, "map", "the cloud shadow was recorded in this frame already");
    }
    if (!everythingUploaded(c)) {
      fail(WLK_ERROR_WRONG_STATE, 0, "context", "record wlkVulkanCmdUpdate before cloud shadows");
    }
    harvestShadowMap(*c.device, state, c.completedFrame);
    gatherCasters(c);
    const TargetImage target = importTarget(c, value, VK_IMAGE_VIEW_TYPE_2D);
    ShadowMapInput input;
    input.light = lightOf(c, state.info.light);
    input.up =
        glm::normalize(glm::dvec3(c.air.planet.up[0], c.air.planet.up[1], c.air.planet.up[2]));
    input.volumes = c.shadowCasters;
    input.dummy3d = c.dummy3d.view();
    input.frameIndex = c.frameIndex;
    input.slot = static_cast<uint32_t>(c.frameIndex % c.maxFramesInFlight);
    recordShadowMap(*c.device, *c.pipelines, commandBuffer, state, input, target,
                    isHalf(value.format));
    return WLK_SUCCESS;
  });
}

WlkResult wlkGetCloudShadowState(WlkContext context, WlkCloudShadow map,
                                 WlkCloudShadowState* state) {
  return guarded([&]() -> WlkResult {
    WlkContext_T& c = checkContext(context);
    ShadowMapState& from = mapOf(c, map);
    const WlkCloudShadowState head = startOutput(state, WLK_STRUCT_CLOUD_SHADOW_STATE);
    if (from.lastFrame == 0) {
      return WLK_NOT_READY;
    }
    if (!c.deviceLost) {
      harvestShadowMap(*c.device, from, c.completedFrame);
    }
    WlkCloudShadowState value = from.last;
    value.sType = head.sType;
    value.structSize = head.structSize;
    value.next = nullptr;
    value.gpuTime_ns = from.gpuTime_ns;
    finishOutput(value, state);
    return WLK_SUCCESS;
  });
}
