// SPDX-License-Identifier: MIT
#include "vk/dispatch.hpp"

#include <cstring>

#include "failure.hpp"

namespace welkin::vk {
namespace {

PFN_vkVoidFunction require(PFN_vkVoidFunction function, const char* name) {
  if (function == nullptr) {
    fail(WLK_ERROR_MISSING_FEATURE, 0, name, "the Vulkan function %s is not available", name);
  }
  return function;
}

PFN_vkVoidFunction deviceFunction(const Dispatch& table, VkDevice device, const char* name) {
  PFN_vkVoidFunction function = table.GetDeviceProcAddr(device, name);
  if (function == nullptr) {
    char alias[96];
    std::snprintf(alias, sizeof alias, "%sKHR", name);
    function = table.GetDeviceProcAddr(device, alias);
  }
  return require(function, name);
}

}  // namespace

void loadInstanceFunctions(Dispatch& table, PFN_vkGetInstanceProcAddr get, VkInstance instance) {
#define WELKIN_LOAD(name) \
  table.name = reinterpret_cast<PFN_vk##name>(require(get(instance, "vk" #name), "vk" #name));
  WELKIN_INSTANCE_FUNCTIONS(WELKIN_LOAD)
#undef WELKIN_LOAD
}

void loadDeviceFunctions(Dispatch& table, VkDevice device, bool headless) {
#define WELKIN_LOAD(name) \
  table.name = reinterpret_cast<PFN_vk##name>(deviceFunction(table, device, "vk" #name));
  WELKIN_DEVICE_FUNCTIONS(WELKIN_LOAD)
  if (headless) {
    WELKIN_HEADLESS_FUNCTIONS(WELKIN_LOAD)
  }
#undef WELKIN_LOAD
}

void check(VkResult result, const char* call) {
  if (result >= 0) {
    return;
  }
  WlkResult code = WLK_ERROR_INTERNAL;
  switch (result) {
    case VK_ERROR_OUT_OF_HOST_MEMORY:
      code = WLK_ERROR_OUT_OF_HOST_MEMORY;
      break;
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
    case VK_ERROR_OUT_OF_POOL_MEMORY:
    case VK_ERROR_TOO_MANY_OBJECTS:
      code = WLK_ERROR_OUT_OF_DEVICE_MEMORY;
      break;
    case VK_ERROR_DEVICE_LOST:
      code = WLK_ERROR_DEVICE_LOST;
      break;
    case VK_ERROR_FORMAT_NOT_SUPPORTED:
      code = WLK_ERROR_UNSUPPORTED_FORMAT;
      break;
    default:
      break;
  }
  Failure failure;
  failure.result = code;
  failure.vkResult = result;
  std::snprintf(failure.field, sizeof failure.field, "%s", call);
  std::snprintf(failure.message, sizeof failure.message, "%s returned VkResult %d", call,
                static_cast<int>(result));
  throw failure;
}

}  // namespace welkin::vk
