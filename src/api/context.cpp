// SPDX-License-Identifier: MIT
#include "api/context.hpp"

#include <welkin/welkin_vulkan.h>

#include <atomic>
#include <cstring>
#include <utility>

namespace {

using namespace welkin;

// The chain of WlkContextInfo: at most one device structure.
struct ContextChain {
  std::optional<WlkVulkanDeviceInfo> device;
  std::optional<WlkHeadlessInfo> headless;
};

ContextChain readChain(const void* next) {
  ContextChain chain;
  for (; next != nullptr;) {
    StructHeader header;
    std::memcpy(&header, next, sizeof header);
    if (header.sType == WLK_STRUCT_VULKAN_DEVICE_INFO && !chain.device) {
      chain.device = copyStruct(static_cast<const WlkVulkanDeviceInfo*>(next), header.sType);
    } else if (header.sType == WLK_STRUCT_HEADLESS_INFO && !chain.headless) {
      chain.headless = copyStruct(static_cast<const WlkHeadlessInfo*>(next), header.sType);
      if ((chain.headless->flags & ~uint64_t{WLK_HEADLESS_VALIDATION}) != 0) {
        fail(WLK_ERROR_INVALID_ARGUMENT, header.sType, "flags",
             "WlkHeadlessInfo::flags has unknown bits");
      }
    } else {
      fail(WLK_ERROR_UNKNOWN_STRUCT, WLK_STRUCT_CONTEXT_INFO, "next",
           "WlkContextInfo's chain holds an unknown or repeated structure (sType %u)",
           header.sType);
    }
    next = header.next;
  }
  if (chain.device && chain.headless) {
    fail(WLK_ERROR_INVALID_ARGUMENT, WLK_STRUCT_CONTEXT_INFO, "next",
         "WlkVulkanDeviceInfo and WlkHeadlessInfo exclude each other");
  }
  return chain;
}

vk::DeviceInfo deviceInfoOf(const WlkVulkanDeviceInfo& info) {
  const auto require = [](const void* pointer, const char* field) {
    if (pointer == nullptr) {
      fail(WLK_ERROR_INVALID_ARGUMENT, WLK_STRUCT_VULKAN_DEVICE_INFO, field,
           "WlkVulkanDeviceInfo::%s is null", field);
    }
  };
  require(reinterpret_cast<const void*>(info.getInstanceProcAddr), "getInstanceProcAddr");
  require(info.instance, "instance");
  require(info.physicalDevice, "physicalDevice");
  require(info.device, "device");
  if (info.apiVersion < VK_API_VERSION_1_3) {
    fail(WLK_ERROR_MISSING_FEATURE, WLK_STRUCT_VULKAN_DEVICE_INFO, "apiVersion",
         "WlkVulkanDeviceInfo::apiVersion is %u.%u, Welkin needs 1.3",
         VK_API_VERSION_MAJOR(info.apiVersion), VK_API_VERSION_MINOR(info.apiVersion));
  }
  vk::DeviceInfo result;
  result.getInstanceProcAddr = info.getInstanceProcAddr;
  result.instance = info.instance;
  result.physicalDevice = info.physicalDevice;
  result.device = info.device;
  result.pipelineCache = info.pipelineCache;
  result.queueFamilyIndex = info.queueFamilyIndex;
  constexpr uint64_t KNOWN = WLK_VULKAN_FEATURE_BLEND;
  if ((info.enabledFeatures & ~KNOWN) != 0) {
    fail(WLK_ERROR_INVALID_ARGUMENT, WLK_STRUCT_VULKAN_DEVICE_INFO, "enabledFeatures",
         "WlkVulkanDeviceInfo::enabledFeatures has unknown bits");
  }
  result.blend = (info.enabledFeatures & WLK_VULKAN_FEATURE_BLEND) != 0;
  return result;
}

void checkQueueFamily(const vk::Device& device, std::pmr::memory_resource* memory) {
  const uint32_t index = device.info().queueFamilyIndex;
  uint32_t count = 0;
  device.vk().GetPhysicalDeviceQueueFamilyProperties(device.info().physicalDevice, &count, nullptr);
  if (index >= count) {
    fail(WLK_ERROR_INVALID_ARGUMENT, WLK_STRUCT_VULKAN_DEVICE_INFO, "queueFamilyIndex",
         "WlkVulkanDeviceInfo::queueFamilyIndex is %u, the device has %u families", index, count);
  }
  std::pmr::vector<VkQueueFamilyProperties> families(count, memory);
  device.vk().GetPhysicalDeviceQueueFamilyProperties(device.info().physicalDevice, &count,
                                                     families.data());
  constexpr VkQueueFlags NEEDED = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
  if ((families[index].queueFlags & NEEDED) != NEEDED) {
    fail(WLK_ERROR_MISSING_FEATURE, WLK_STRUCT_VULKAN_DEVICE_INFO, "queueFamilyIndex",
         "queue family %u lacks graphics or compute", index);
  }
}

// What was enabled on the device cannot be asked, but what it has.
void checkFeatures(const vk::Device& device) {
  VkPhysicalDeviceFeatures has{};
  device.vk().GetPhysicalDeviceFeatures(device.info().physicalDevice, &has);
  if (device.info().blend && !vk::canBlend(has)) {
    fail(WLK_ERROR_MISSING_FEATURE, WLK_STRUCT_VULKAN_DEVICE_INFO, "enabledFeatures",
         "WLK_VULKAN_FEATURE_BLEND: the device lacks %s",
         has.dualSrcBlend == VK_TRUE ? "fragmentStoresAndAtomics" : "dualSrcBlend");
  }
}

// A caller of a newer minor version is welcome: what this library does not know of it is refused
// where it is used. 0 is what a caller passes who does not know the argument.
void checkVersion(uint32_t apiVersion) {
  if (apiVersion == 0 || apiVersion >> 22 != WLK_VERSION_MAJOR) {
    fail(WLK_ERROR_VERSION, 0, "apiVersion", "built against %u.%u, this library is %d.%d",
         apiVersion >> 22, apiVersion >> 12 & 0x3ff, WLK_VERSION_MAJOR, WLK_VERSION_MINOR);
  }
}

// A number for a pool's handles that none of the last 65535 pools of the process had: a handle of
// another kind, or of a destroyed context whose address was handed out again, is never found.
uint16_t nextTag() {
  static std::atomic<uint16_t> last{0x574c};
  return last.fetch_add(1, std::memory_order_relaxed);
}

vk::Image makeDummy(vk::Device& device, VkImageType type, bool layers = false) {
  vk::ImageInfo info;
  info.type = type;
  info.format = VK_FORMAT_R32_SFLOAT;
  info.arrayView = layers;
  info.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  return vk::Image(device, info);
}

}  // namespace

WlkContext_T::WlkContext_T(const WlkContextInfo& contextInfo)
    : maxFramesInFlight(contextInfo.maxFramesInFlight),
      log(contextInfo.log),
      logUser(contextInfo.logUser),
      memory(contextInfo.allocator),
      media(&memory, nextTag()),
      volumes(&memory, nextTag()),
      views(&memory, nextTag()),
      surfaces(&memory, nextTag()),
      shadowMaps(&memory, nextTag()),
      pending(&memory),
      retired(&memory),
      imported(&memory),
      recordVolumes(&memory),
      recordSurfaces(&memory),
      errorVolumes(&memory),
      shadowCasters(&memory) {
  wlkInitStruct(WLK_STRUCT_PLANET, sizeof air.planet, &air.planet);
  wlkInitStruct(WLK_STRUCT_AMBIENT, sizeof air.ambient, &air.ambient);
  const ContextChain chain = readChain(contextInfo.next);
  if (chain.headless) {
    vk::HeadlessOptions options;
    options.deviceName = chain.headless->deviceName;
    options.validation = (chain.headless->flags & WLK_HEADLESS_VALIDATION) != 0;
    options.log = log;
    options.logUser = logUser;
    headless.emplace(options);
    vk::DeviceInfo own = headless->deviceInfo();
    own.memoryLimit = contextInfo.deviceMemoryLimit;
    device.emplace(own, &memory);
    headless->attach(*device);
    mode = WLK_MODE_HEADLESS;
  } else if (chain.device) {
    vk::DeviceInfo engines = deviceInfoOf(*chain.device);
    engines.memoryLimit = contextInfo.deviceMemoryLimit;
    device.emplace(engines, &memory);
    checkQueueFamily(*device, &memory);
    checkFeatures(*device);
    mode = WLK_MODE_ENGINE_DEVICE;
  }
  if (device) {
    pipelines.emplace(*device, &memory);
    dummy2d = makeDummy(*device, VK_IMAGE_TYPE_2D);
    dummy3d = makeDummy(*device, VK_IMAGE_TYPE_3D);
    dummyArray = makeDummy(*device, VK_IMAGE_TYPE_2D, true);
  }
}

WlkContext_T::~WlkContext_T() {
  magic = 0;
  if (!device) {
    return;
  }
  if (headless) {
    // Of a lost device, too: what was said to be lost may still run, and the wait returns at once
    // if nothing does.
    headless->settle();
  }
  for (uint32_t i = 0; i < views.slotCount(); ++i) {
    if (ViewState* view = views.at(i)) {
      destroyView(*device, *view);
    }
  }
  for (uint32_t i = 0; i < shadowMaps.slotCount(); ++i) {
    if (ShadowMapState* map = shadowMaps.at(i)) {
      destroyShadowMap(*device, map->resources);
    }
  }
  completedFrame = ~uint64_t{0};
  collect();
  for (const ImportedView& view : imported) {
    device->vk().DestroyImageView(device->handle(), view.view, nullptr);
  }
}

vk::Device& WlkContext_T::requireDevice(const char* what) {
  if (!device) {
    fail(WLK_ERROR_WRONG_STATE, 0, "context", "%s needs a device; this context is CPU-only", what);
  }
  if (deviceLost) {
    fail(WLK_ERROR_DEVICE_LOST, 0, "context", "the device was lost");
  }
  return *device;
}

MediumState& WlkContext_T::medium(WlkMedium handle) {
  MediumState* found = media.find(handle.id);
  if (found == nullptr) {
    fail(WLK_ERROR_INVALID_HANDLE, 0, "medium", "no such medium");
  }
  return *found;
}

VolumeState& WlkContext_T::volume(WlkVolume handle) {
  VolumeState* found = volumes.find(handle.id);
  if (found == nullptr) {
    fail(WLK_ERROR_INVALID_HANDLE, 0, "volume", "no such volume");
  }
  return *found;
}

ViewState& WlkContext_T::view(WlkView handle) {
  ViewState* found = views.find(handle.id);
  if (found == nullptr) {
    fail(WLK_ERROR_INVALID_HANDLE, 0, "view", "no such view");
  }
  return *found;
}

SurfaceState& WlkContext_T::surface(WlkSurface handle) {
  SurfaceState* found = surfaces.find(handle.id);
  if (found == nullptr) {
    fail(WLK_ERROR_INVALID_HANDLE, 0, "surface", "no such surface");
  }
  return *found;
}

void WlkContext_T::invalidate() {
  for (uint32_t i = 0; i < views.slotCount(); ++i) {
    if (ViewState* view = views.at(i)) {
      view->prepared = false;
    }
  }
  for (uint32_t i = 0; i < shadowMaps.slotCount(); ++i) {
    if (ShadowMapState* map = shadowMaps.at(i)) {
      map->prepared = false;
    }
  }
}

void WlkContext_T::forgetBindings() {
  for (uint32_t i = 0; i < views.slotCount(); ++i) {
    if (ViewState* view = views.at(i)) {
      for (ViewSlot& slot : view->resources.slots) {
        slot.composite.bound = {};
        slot.aerial.bound = {};
        slot.distance.bound = {};
        for (BoundSet& set : slot.froxels) {
          set.bound = {};
        }
        for (BoundSet& set : slot.volumes) {
          set.bound = {};
        }
        for (BoundSet& set : slot.transport) {
          set.bound = {};
        }
        for (BoundSet& set : slot.ambient) {
          set.bound = {};
        }
        for (BoundSet& set : slot.surfaces) {
          set.bound = {};
        }
      }
      for (BoundSet& set : view->resources.shadow.resources.sets) {
        set.bound = {};
      }
    }
  }
  for (uint32_t i = 0; i < shadowMaps.slotCount(); ++i) {
    if (ShadowMapState* map = shadowMaps.at(i)) {
      for (BoundSet& set : map->resources.sets) {
        set.bound = {};
      }
    }
  }
}

void WlkContext_T::retireView(ViewState& view) {
  if (view.resources.slots.empty()) {
    return;
  }
  Retired& entry = retired.emplace_back(&memory);
  entry.frame = frameIndex;
  std::swap(entry.view, view.resources);
}

void WlkContext_T::harvest(ViewState& view) {
  if (!deviceLost) {
    welkin::harvest(*device, view, completedFrame);
  }
}

void WlkContext_T::collect() {
  for (size_t i = 0; i < retired.size();) {
    if (retired[i].frame > completedFrame) {
      ++i;
      continue;
    }
    ViewState carrier(&memory);
    std::swap(carrier.resources, retired[i].view);
    destroyView(*device, carrier);
    destroyShadowMap(*device, retired[i].shadowMap);
    if (i + 1 != retired.size()) {
      std::swap(retired[i], retired.back());
    }
    retired.pop_back();
  }
}

namespace welkin {

WlkContext_T& checkContext(WlkContext context) {
  if (context == nullptr || context->magic != CONTEXT_MAGIC) {
    fail(WLK_ERROR_INVALID_HANDLE, 0, "context", "the context is null or destroyed");
  }
  enterContext(&context->deviceLost);
  return *context;
}

}  // namespace welkin

WlkResult wlkCreateContext(uint32_t apiVersion, const WlkContextInfo* info, WlkContext* context) {
  return guarded([&] {
    checkPointer(context, "context");
    *context = nullptr;
    checkVersion(apiVersion);
    const WlkContextInfo copy = copyStruct(info, WLK_STRUCT_CONTEXT_INFO);
    checkRange(WLK_STRUCT_CONTEXT_INFO, "maxFramesInFlight", copy.maxFramesInFlight, 1, 8);
    if ((copy.allocator.allocate == nullptr) != (copy.allocator.release == nullptr)) {
      fail(WLK_ERROR_INVALID_ARGUMENT, WLK_STRUCT_CONTEXT_INFO, "allocator",
           "WlkContextInfo::allocator needs both functions or none");
    }
    HostMemory memory(copy.allocator);
    std::pmr::memory_resource& resource = memory;
    void* place = resource.allocate(sizeof(WlkContext_T), alignof(WlkContext_T));
    try {
      *context = new (place) WlkContext_T(copy);
    } catch (...) {
      resource.deallocate(place, sizeof(WlkContext_T), alignof(WlkContext_T));
      throw;
    }
    return WLK_SUCCESS;
  });
}

void wlkDestroyContext(WlkContext context) {
  if (context == nullptr || context->magic != CONTEXT_MAGIC) {
    return;
  }
  HostMemory memory(context->memory.allocator());
  std::pmr::memory_resource& resource = memory;
  context->~WlkContext_T();
  resource.deallocate(context, sizeof(WlkContext_T), alignof(WlkContext_T));
}

WlkResult wlkGetCapabilities(WlkContext context, WlkCapabilities* capabilities) {
  return guarded([&] {
    const WlkContext_T& c = checkContext(context);
    WlkCapabilities value = startOutput(capabilities, WLK_STRUCT_CAPABILITIES);
    value.mode = c.mode;
    value.maxLights = MAX_LIGHTS;
    if (c.device) {
      const VkPhysicalDeviceProperties& properties = c.device->properties();
      value.vulkanVersion = properties.apiVersion;
      value.maxVolumeSize = properties.limits.maxImageDimension3D;
      value.blendSupported = c.device->info().blend && !c.headless ? 1 : 0;
      std::snprintf(value.deviceName, sizeof value.deviceName, "%s", properties.deviceName);
    }
    finishOutput(value, capabilities);
    return WLK_SUCCESS;
  });
}
