// SPDX-License-Identifier: MIT
// Between the library and Vulkan: makes the k-th call that can fail fail, and keeps count of the
// objects that are alive. C function pointers carry no state: all of it is the process's.
#pragma once

#include <vulkan/vulkan_core.h>

#include <cstdint>
#include <map>
#include <set>
#include <string>

namespace welkin::test {

class FaultLayer {
 public:
  static constexpr uint64_t NEVER = ~uint64_t{0};

  // What the library gets instead of the loader's.
  static PFN_vkGetInstanceProcAddr getInstanceProcAddr();
  // For a layer that the loader puts under a device: what it hands out for `real`.
  static PFN_vkVoidFunction replace(const char* name, PFN_vkVoidFunction real);
  // For calls of such a layer's own: counts one that can fail, and tells its result.
  static VkResult enter(const char* name);
  static void count(const char* kind, int64_t change);
  // The k-th call from now on, from 0, that returns a VkResult returns `code` instead, and is not
  // made; with `forever` all after it as well.
  static void failAt(uint64_t k, VkResult code, bool forever);
  static void failNever() { failAt(NEVER, VK_SUCCESS, false); }
  // Shaders and pipelines are handles of nothing, and what they do is not done: no compiler runs.
  static void makeHollowPipelines(bool hollow);
  // Calls that can fail since the last failAt.
  static uint64_t calls();
  // Of these, those of one function: "vkAllocateMemory".
  static uint64_t calls(const char* name);
  // All calls of device functions since then, those that return nothing included.
  static uint64_t anyCalls();
  // Of these, those that destroy or free.
  static uint64_t destructions();
  // Device functions that were asked for and are handed out uncounted. There should be none.
  static const std::set<std::string>& unknown();
  // Bytes of the device's memory that are allocated, and the most since the last failAt that were
  // or would have been, had the driver given what it was asked for.
  static uint64_t memory();
  static uint64_t mostMemory();
  // The call that failed last, "" if none did.
  static const char* failed();
  // Objects created and not destroyed, by the function that creates them.
  static std::map<std::string, int64_t> live();
};

}  // namespace welkin::test
