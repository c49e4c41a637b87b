// SPDX-License-Identifier: MIT
#include "support/fault_layer.hpp"

#include <vulkan/vulkan.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <tuple>
#include <type_traits>

namespace welkin::test {
namespace {

// What may fail; then what destroys, and what it undoes; then what can do neither.
// clang-format would move the columns of these lists on every run.
// clang-format off
#define WELKIN_FALLIBLE(X)                                                                      \
  X(AllocateMemory) X(CreateBuffer) X(CreateBufferView) X(CreateImage) X(CreateImageView)       \
  X(CreateSampler)                                                                              \
  X(CreateShaderModule) X(CreateDescriptorSetLayout) X(CreatePipelineLayout)                    \
  X(CreateComputePipelines) X(CreateGraphicsPipelines) X(CreateDescriptorPool)                  \
  X(CreateQueryPool) X(CreateCommandPool) X(CreateFence)                                        \
  X(AllocateDescriptorSets) X(MapMemory) X(BindBufferMemory) X(BindImageMemory)                 \
  X(GetQueryPoolResults) X(AllocateCommandBuffers) X(BeginCommandBuffer) X(EndCommandBuffer)    \
  X(ResetCommandPool) X(ResetFences) X(QueueSubmit) X(WaitForFences) X(DeviceWaitIdle)
#define WELKIN_UNDOING(X)                                                                       \
  X(FreeMemory, AllocateMemory) X(DestroyBuffer, CreateBuffer) X(DestroyImage, CreateImage)     \
  X(DestroyImageView, CreateImageView) X(DestroySampler, CreateSampler)                         \
  X(DestroyBufferView, CreateBufferView)                                                        \
  X(DestroyShaderModule, CreateShaderModule)                                                    \
  X(DestroyDescriptorSetLayout, CreateDescriptorSetLayout)                                      \
  X(DestroyPipelineLayout, CreatePipelineLayout) X(DestroyPipeline, CreateComputePipelines)     \
  X(DestroyDescriptorPool, CreateDescriptorPool) X(DestroyQueryPool, CreateQueryPool)           \
  X(DestroyCommandPool, CreateCommandPool) X(DestroyFence, CreateFence)
#define WELKIN_REST(X)                                                                          \
  X(UpdateDescriptorSets) X(CmdPipelineBarrier2) X(CmdCopyBufferToImage) X(CmdCopyBuffer)       \
  X(CmdCopyImageToBuffer) X(CmdFillBuffer) X(CmdBindPipeline) X(CmdBindDescriptorSets)          \
  X(CmdPushConstants) X(CmdDispatch) X(CmdDispatchIndirect) X(CmdUpdateBuffer)                  \
  X(CmdResetQueryPool) X(CmdWriteTimestamp2)                                                    \
  X(CmdBeginRendering) X(CmdEndRendering) X(CmdSetViewport) X(CmdSetScissor) X(CmdDraw)         \
  X(CmdDrawIndirect)                                                                            \
  X(CmdClearColorImage) X(GetBufferMemoryRequirements) X(GetImageMemoryRequirements)            \
  X(GetDeviceQueue)
// clang-format on

enum Call {
#define WELKIN_INDEX(name, ...) CALL_##name,
  WELKIN_FALLIBLE(WELKIN_INDEX) WELKIN_UNDOING(WELKIN_INDEX) WELKIN_REST(WELKIN_INDEX)
#undef WELKIN_INDEX
      CALL_COUNT
};

struct Layer {
  std::array<PFN_vkVoidFunction, CALL_COUNT> real{};
  std::array<int64_t, CALL_COUNT> live{};
  std::array<uint64_t, CALL_COUNT> callsOf{};
  std::map<VkDeviceMemory, VkDeviceSize> memory;
  uint64_t memoryBytes = 0;
  uint64_t mostMemory = 0;
  uint64_t calls = 0;
  uint64_t any = 0;
  uint64_t undone = 0;
  uint64_t at = FaultLayer::NEVER;
  bool forever = false;
  bool hollow = false;
  uint64_t hollowHandles = 0;
  VkResult code = VK_SUCCESS;
  const char* failed = "";
  std::set<std::string> unknown;
  std::map<std::string, int64_t> instanceObjects;
};
Layer layer;

bool failsNow() {
  const uint64_t k = layer.calls++;
  return k == layer.at || (layer.forever && k > layer.at);
}

// What vkDestroyPipeline undoes is counted as one. Sets go with their pool.
constexpr bool countsAsObject(Call call) {
  return call < CALL_AllocateDescriptorSets;
}
constexpr Call kindOf(Call call) {
  return call == CALL_CreateGraphicsPipelines ? CALL_CreateComputePipelines : call;
}

void askForMemory(VkDevice, const VkMemoryAllocateInfo* info, const VkAllocationCallbacks*,
                  VkDeviceMemory*) {
  layer.mostMemory = std::max(layer.mostMemory, layer.memoryBytes + info->allocationSize);
}

void takeMemory(VkDevice, const VkMemoryAllocateInfo* info, const VkAllocationCallbacks*,
                const VkDeviceMemory* made) {
  layer.memory[*made] = info->allocationSize;
  layer.memoryBytes += info->allocationSize;
}

void giveMemory(VkDevice, VkDeviceMemory memory, const VkAllocationCallbacks*) {
  const auto found = layer.memory.find(memory);
  if (found != layer.memory.end()) {
    layer.memoryBytes -= found->second;
    layer.memory.erase(found);
  }
}

constexpr bool needsPipeline(Call call) {
  return call == CALL_CreateShaderModule || call == CALL_DestroyShaderModule ||
         call == CALL_CreateComputePipelines || call == CALL_CreateGraphicsPipelines ||
         call == CALL_DestroyPipeline || call == CALL_CmdBindPipeline || call == CALL_CmdDispatch ||
         call == CALL_CmdDispatchIndirect || call == CALL_CmdDraw || call == CALL_CmdDrawIndirect;
}

template <Call WHICH>
struct Name;
template <typename Function>
struct Wrapper;
template <typename Result, typename... Arguments>
struct Wrapper<Result(VKAPI_PTR*)(Arguments...)> {
  using Function = Result(VKAPI_PTR*)(Arguments...);

  // The last argument of a creation is where the handle goes.
  static VkResult makeHollow(Arguments... arguments) {
    auto place = std::get<sizeof...(Arguments) - 1>(std::tuple(arguments...));
    if constexpr (std::is_same_v<decltype(place), VkPipeline*> ||
                  std::is_same_v<decltype(place), VkShaderModule*>) {
      *place = reinterpret_cast<std::remove_pointer_t<decltype(place)>>(++layer.hollowHandles);
    }
    return VK_SUCCESS;
  }

  template <Call WHICH>
  static VKAPI_ATTR Result VKAPI_CALL fallible(Arguments... arguments) {
    ++layer.any;
    ++layer.callsOf[WHICH];
    if constexpr (WHICH == CALL_AllocateMemory) {
      askForMemory(arguments...);
    }
    if (failsNow()) {
      layer.failed = Name<WHICH>::TEXT;
      return layer.code;
    }
    const Result result = layer.hollow && needsPipeline(WHICH)
                              ? makeHollow(arguments...)
                              : reinterpret_cast<Function>(layer.real[WHICH])(arguments...);
    if (result >= 0 && countsAsObject(WHICH)) {
      ++layer.live[kindOf(WHICH)];  // the library makes pipelines one by one
      if constexpr (WHICH == CALL_AllocateMemory) {
        takeMemory(arguments...);
      }
    }
    return result;
  }

  template <Call WHICH, Call UNDONE>
  static VKAPI_ATTR void VKAPI_CALL undoing(Arguments... arguments) {
    ++layer.any;
    ++layer.undone;
    const bool given = [](VkDevice, auto handle, const VkAllocationCallbacks*) {
      return handle != VK_NULL_HANDLE;
    }(arguments...);
    layer.live[UNDONE] -= given ? 1 : 0;
    if constexpr (WHICH == CALL_FreeMemory) {
      giveMemory(arguments...);
    }
    if (layer.hollow && needsPipeline(WHICH)) {
      return;
    }
    reinterpret_cast<Function>(layer.real[WHICH])(arguments...);
  }

  template <Call WHICH>
  static VKAPI_ATTR void VKAPI_CALL passing(Arguments... arguments) {
    ++layer.any;
    if (layer.hollow && needsPipeline(WHICH)) {
      return;
    }
    reinterpret_cast<Function>(layer.real[WHICH])(arguments...);
  }
};

#define WELKIN_NAME(name, ...)                      \
  template <>                                       \
  struct Name<CALL_##name> {                        \
    static constexpr const char* TEXT = "vk" #name; \
  };
WELKIN_FALLIBLE(WELKIN_NAME)
#undef WELKIN_NAME

struct Replacement {
  const char* name;
  PFN_vkVoidFunction function;
};

const std::array<Replacement, CALL_COUNT>& replacements() {
  static const std::array<Replacement, CALL_COUNT> table{{
#define WELKIN_ENTRY(name) \
  {"vk" #name, reinterpret_cast<PFN_vkVoidFunction>(&Wrapper<PFN_vk##name>::fallible<CALL_##name>)},
      WELKIN_FALLIBLE(WELKIN_ENTRY)
#undef WELKIN_ENTRY
#define WELKIN_ENTRY(name, undone)                   \
  {"vk" #name, reinterpret_cast<PFN_vkVoidFunction>( \
                   &Wrapper<PFN_vk##name>::undoing<CALL_##name, CALL_##undone>)},
          WELKIN_UNDOING(WELKIN_ENTRY)
#undef WELKIN_ENTRY
#define WELKIN_ENTRY(name) \
  {"vk" #name, reinterpret_cast<PFN_vkVoidFunction>(&Wrapper<PFN_vk##name>::passing<CALL_##name>)},
              WELKIN_REST(WELKIN_ENTRY)
#undef WELKIN_ENTRY
  }};
  return table;
}

PFN_vkVoidFunction replaced(const char* name, PFN_vkVoidFunction real) {
  for (size_t i = 0; i < replacements().size(); ++i) {
    if (std::strcmp(replacements()[i].name, name) == 0) {
      layer.real[i] = real;
      return replacements()[i].function;
    }
  }
  return nullptr;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL deviceProc(VkDevice device, const char* name) {
  PFN_vkVoidFunction real = vkGetDeviceProcAddr(device, name);
  PFN_vkVoidFunction ours = replaced(name, real);
  if (ours == nullptr) {
    layer.unknown.insert(name);
  }
  return ours != nullptr ? ours : real;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL instanceProc(VkInstance instance, const char* name) {
  return std::strcmp(name, "vkGetDeviceProcAddr") == 0
             ? reinterpret_cast<PFN_vkVoidFunction>(&deviceProc)
             : vkGetInstanceProcAddr(instance, name);
}

}  // namespace

PFN_vkGetInstanceProcAddr FaultLayer::getInstanceProcAddr() {
  return &instanceProc;
}

PFN_vkVoidFunction FaultLayer::replace(const char* name, PFN_vkVoidFunction real) {
  PFN_vkVoidFunction ours = replaced(name, real);
  return ours != nullptr ? ours : real;
}

VkResult FaultLayer::enter(const char* name) {
  ++layer.any;
  if (failsNow()) {
    layer.failed = name;
    return layer.code;
  }
  return VK_SUCCESS;
}

void FaultLayer::count(const char* kind, int64_t change) {
  layer.instanceObjects[kind] += change;
}

void FaultLayer::failAt(uint64_t k, VkResult code, bool forever) {
  layer.calls = 0;
  layer.callsOf = {};
  layer.mostMemory = layer.memoryBytes;
  layer.any = 0;
  layer.undone = 0;
  layer.at = k;
  layer.code = code;
  layer.forever = forever;
  layer.failed = "";
}

void FaultLayer::makeHollowPipelines(bool hollow) {
  layer.hollow = hollow;
}

uint64_t FaultLayer::calls() {
  return layer.calls;
}

uint64_t FaultLayer::calls(const char* name) {
  const auto found =
      std::find_if(replacements().begin(), replacements().end(),
                   [&](const auto& one) { return std::strcmp(one.name, name) == 0; });
  return found == replacements().end()
             ? 0
             : layer.callsOf[static_cast<size_t>(found - replacements().begin())];
}

uint64_t FaultLayer::memory() {
  return layer.memoryBytes;
}

uint64_t FaultLayer::mostMemory() {
  return layer.mostMemory;
}

uint64_t FaultLayer::anyCalls() {
  return layer.any;
}

uint64_t FaultLayer::destructions() {
  return layer.undone;
}

const std::set<std::string>& FaultLayer::unknown() {
  return layer.unknown;
}

const char* FaultLayer::failed() {
  return layer.failed;
}

std::map<std::string, int64_t> FaultLayer::live() {
  std::map<std::string, int64_t> left;
#define WELKIN_LEFT(name)                       \
  if (layer.live[CALL_##name] != 0) {           \
    left["vk" #name] = layer.live[CALL_##name]; \
  }
  WELKIN_FALLIBLE(WELKIN_LEFT)
#undef WELKIN_LEFT
  for (const auto& [kind, count] : layer.instanceObjects) {
    if (count != 0) {
      left[kind] = count;
    }
  }
  return left;
}

}  // namespace welkin::test
