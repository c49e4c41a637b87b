// SPDX-License-Identifier: MIT
// What each exported function does once the device is lost.
#pragma once

#include <functional>
#include <vector>

#include "stress/headless_life.hpp"

namespace welkin::test {

// A context that has drawn, and what was made in it. Headless ones have no surface and no map.
struct LostObjects {
  WlkContext* context;  // null once it is destroyed
  WlkMedium medium;
  WlkVolume volume;
  WlkVolume second;  // if there is one
  WlkView view;
  WlkSurface surface;
  WlkCloudShadow map;
  WlkVulkanImage image{};  // of the engine, with the volume's size
  VkCommandBuffer commands = VK_NULL_HANDLE;
};

struct LostRow {
  const char* name;
  WlkResult engine;
  WlkResult headless;
  std::function<WlkResult(const LostObjects&)> call;
  bool destroys = false;  // asks Vulkan to destroy, or may
};

// In an order in which each can be called: the context goes last.
std::vector<LostRow> lostTable();

}  // namespace welkin::test
