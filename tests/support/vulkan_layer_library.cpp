// SPDX-License-Identifier: MIT
// The layer's own library: the interface between loader and layers (version 2), and the three calls
// before a device that can fail. All else is the program's, by its hooks.
#include <vulkan/vk_layer.h>
#include <vulkan/vulkan.h>

#include <cstring>

#include "support/vulkan_layer.hpp"

namespace {

using welkin::test::LayerHooks;

LayerHooks hooks{};
PFN_vkGetInstanceProcAddr nextInstanceProc = nullptr;
PFN_vkGetDeviceProcAddr nextDeviceProc = nullptr;
// Asked for while the instance is made: later the loader answers with the first of the chain.
PFN_vkDestroyInstance nextDestroyInstance = nullptr;
PFN_vkEnumeratePhysicalDevices nextEnumerate = nullptr;
PFN_vkCreateDevice nextCreateDevice = nullptr;

VkResult enter(const char* name) {
  return hooks.enter == nullptr ? VK_SUCCESS : hooks.enter(name);
}

void count(const char* kind, int64_t change) {
  if (hooks.count != nullptr) {
    hooks.count(kind, change);
  }
}

template <typename Function>
Function nextOf(VkInstance instance, const char* name) {
  return reinterpret_cast<Function>(nextInstanceProc(instance, name));
}

// The loader's link in a chain of creation, which only layers see.
template <typename Link>
Link* linkOf(const void* chain, VkStructureType type) {
  for (auto* link = static_cast<const Link*>(chain); link != nullptr;
       link = static_cast<const Link*>(link->pNext)) {
    if (link->sType == type && link->function == VK_LAYER_LINK_INFO) {
      return const_cast<Link*>(link);
    }
  }
  return nullptr;
}

VKAPI_ATTR VkResult VKAPI_CALL createInstance(const VkInstanceCreateInfo* info,
                                              const VkAllocationCallbacks* memory,
                                              VkInstance* instance) {
  if (const VkResult failed = enter("vkCreateInstance"); failed < 0) {
    return failed;
  }
  auto* link =
      linkOf<VkLayerInstanceCreateInfo>(info->pNext, VK_STRUCTURE_TYPE_LOADER_INSTANCE_CREATE_INFO);
  nextInstanceProc = link->u.pLayerInfo->pfnNextGetInstanceProcAddr;
  link->u.pLayerInfo = link->u.pLayerInfo->pNext;
  const VkResult result =
      nextOf<PFN_vkCreateInstance>(VK_NULL_HANDLE, "vkCreateInstance")(info, memory, instance);
  if (result >= 0) {
    nextDestroyInstance = nextOf<PFN_vkDestroyInstance>(*instance, "vkDestroyInstance");
    nextEnumerate = nextOf<PFN_vkEnumeratePhysicalDevices>(*instance, "vkEnumeratePhysicalDevices");
    nextCreateDevice = nextOf<PFN_vkCreateDevice>(*instance, "vkCreateDevice");
    count("vkCreateInstance", 1);
  }
  return result;
}

VKAPI_ATTR void VKAPI_CALL destroyInstance(VkInstance instance,
                                           const VkAllocationCallbacks* memory) {
  count("vkCreateInstance", -1);
  nextDestroyInstance(instance, memory);
}

VKAPI_ATTR VkResult VKAPI_CALL enumerate(VkInstance instance, uint32_t* devices,
                                         VkPhysicalDevice* list) {
  const VkResult failed = enter("vkEnumeratePhysicalDevices");
  return failed < 0 ? failed : nextEnumerate(instance, devices, list);
}

VKAPI_ATTR VkResult VKAPI_CALL createDevice(VkPhysicalDevice physical,
                                            const VkDeviceCreateInfo* info,
                                            const VkAllocationCallbacks* memory, VkDevice* device) {
  if (const VkResult failed = enter("vkCreateDevice"); failed < 0) {
    return failed;
  }
  auto* link =
      linkOf<VkLayerDeviceCreateInfo>(info->pNext, VK_STRUCTURE_TYPE_LOADER_DEVICE_CREATE_INFO);
  nextDeviceProc = link->u.pLayerInfo->pfnNextGetDeviceProcAddr;
  link->u.pLayerInfo = link->u.pLayerInfo->pNext;
  const VkResult result = nextCreateDevice(physical, info, memory, device);
  count("vkCreateDevice", result >= 0 ? 1 : 0);
  return result;
}

VKAPI_ATTR void VKAPI_CALL destroyDevice(VkDevice device, const VkAllocationCallbacks* memory) {
  count("vkCreateDevice", -1);
  reinterpret_cast<PFN_vkDestroyDevice>(nextDeviceProc(device, "vkDestroyDevice"))(device, memory);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL deviceProc(VkDevice device, const char* name) {
  if (std::strcmp(name, "vkGetDeviceProcAddr") == 0) {
    return reinterpret_cast<PFN_vkVoidFunction>(&deviceProc);
  }
  if (std::strcmp(name, "vkDestroyDevice") == 0) {
    return reinterpret_cast<PFN_vkVoidFunction>(&destroyDevice);
  }
  PFN_vkVoidFunction real = nextDeviceProc(device, name);
  return real == nullptr || hooks.replace == nullptr ? real : hooks.replace(name, real);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL instanceProc(VkInstance instance, const char* name) {
  struct Own {
    const char* name;
    PFN_vkVoidFunction function;
  };
  const Own own[] = {
      {"vkGetInstanceProcAddr", reinterpret_cast<PFN_vkVoidFunction>(&instanceProc)},
      {"vkGetDeviceProcAddr", reinterpret_cast<PFN_vkVoidFunction>(&deviceProc)},
      {"vkCreateInstance", reinterpret_cast<PFN_vkVoidFunction>(&createInstance)},
      {"vkDestroyInstance", reinterpret_cast<PFN_vkVoidFunction>(&destroyInstance)},
      {"vkEnumeratePhysicalDevices", reinterpret_cast<PFN_vkVoidFunction>(&enumerate)},
      {"vkCreateDevice", reinterpret_cast<PFN_vkVoidFunction>(&createDevice)},
  };
  for (const Own& one : own) {
    if (std::strcmp(one.name, name) == 0) {
      return one.function;
    }
  }
  return instance == VK_NULL_HANDLE ? nullptr : nextInstanceProc(instance, name);
}

}  // namespace

extern "C" {

__attribute__((visibility("default"))) void welkinSetLayerHooks(const LayerHooks* given);
void welkinSetLayerHooks(const LayerHooks* given) {
  hooks = *given;
}

__attribute__((visibility("default"))) VKAPI_ATTR VkResult VKAPI_CALL
vkNegotiateLoaderLayerInterfaceVersion(VkNegotiateLayerInterface* versions) {
  versions->loaderLayerInterfaceVersion = 2;
  versions->pfnGetInstanceProcAddr = &instanceProc;
  versions->pfnGetDeviceProcAddr = &deviceProc;
  versions->pfnGetPhysicalDeviceProcAddr = nullptr;
  return VK_SUCCESS;
}
}
