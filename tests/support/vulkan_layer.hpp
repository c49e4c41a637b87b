// SPDX-License-Identifier: MIT
// An explicit layer of Vulkan that a test puts under a context which loads Vulkan by itself: the
// FaultLayer sees its calls, too. One instance and one device at a time.
#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>

namespace welkin::test {

// What the layer, a library of its own, asks the test's program.
struct LayerHooks {
  PFN_vkVoidFunction (*replace)(const char* name, PFN_vkVoidFunction real);
  VkResult (*enter)(const char* name);
  void (*count)(const char* kind, int64_t change);
};
using SetLayerHooks = void (*)(const LayerHooks*);

// While it lives, instances of Vulkan that this process makes have the layer.
class UnderFaultLayer {
 public:
  UnderFaultLayer();
  ~UnderFaultLayer();
  UnderFaultLayer(const UnderFaultLayer&) = delete;
  UnderFaultLayer& operator=(const UnderFaultLayer&) = delete;

 private:
  void* library_;
};

}  // namespace welkin::test
