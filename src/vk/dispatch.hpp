// SPDX-License-Identifier: MIT
// The Vulkan functions Welkin calls, loaded through the engine's vkGetInstanceProcAddr into a table
// of each context. No vk* symbol is defined or linked.
#pragma once

#include <vulkan/vulkan_core.h>

namespace welkin::vk {

// clang-format would move the columns of these lists on every run.
// clang-format off
#define WELKIN_INSTANCE_FUNCTIONS(X)                                                            \
  X(EnumeratePhysicalDevices) X(GetPhysicalDeviceProperties) X(GetPhysicalDeviceFeatures)       \
  X(GetPhysicalDeviceFormatProperties) X(GetPhysicalDeviceMemoryProperties)                     \
  X(GetPhysicalDeviceQueueFamilyProperties) X(GetDeviceProcAddr)

#define WELKIN_DEVICE_FUNCTIONS(X)                                                              \
  X(AllocateMemory) X(FreeMemory) X(MapMemory) X(CreateBuffer) X(DestroyBuffer)                 \
  X(CreateBufferView) X(DestroyBufferView)                                                      \
  X(GetBufferMemoryRequirements) X(BindBufferMemory) X(CreateImage) X(DestroyImage)             \
  X(GetImageMemoryRequirements) X(BindImageMemory) X(CreateImageView) X(DestroyImageView)       \
  X(CreateSampler) X(DestroySampler) X(CreateShaderModule) X(DestroyShaderModule)               \
  X(CreateDescriptorSetLayout) X(DestroyDescriptorSetLayout) X(CreatePipelineLayout)            \
  X(DestroyPipelineLayout) X(CreateComputePipelines) X(CreateGraphicsPipelines)                 \
  X(DestroyPipeline) X(CreateDescriptorPool) X(DestroyDescriptorPool)                           \
  X(AllocateDescriptorSets) X(UpdateDescriptorSets) X(CreateQueryPool) X(DestroyQueryPool)      \
  X(GetQueryPoolResults) X(CmdPipelineBarrier2) X(CmdCopyBufferToImage) X(CmdCopyBuffer)         \
  X(CmdCopyImageToBuffer) X(CmdFillBuffer) X(CmdBindPipeline) X(CmdBindDescriptorSets)          \
  X(CmdPushConstants) X(CmdDispatch) X(CmdDispatchIndirect) X(CmdUpdateBuffer)                  \
  X(CmdResetQueryPool) X(CmdWriteTimestamp2)                                                    \
  X(CmdBeginRendering) X(CmdEndRendering) X(CmdSetViewport) X(CmdSetScissor) X(CmdDraw)         \
  X(CmdDrawIndirect) X(CmdClearColorImage)

// Only for headless contexts, which own queue and command buffers.
#define WELKIN_HEADLESS_FUNCTIONS(X)                                                            \
  X(DestroyDevice) X(GetDeviceQueue) X(CreateCommandPool) X(DestroyCommandPool)                 \
  X(AllocateCommandBuffers) X(BeginCommandBuffer) X(EndCommandBuffer) X(QueueSubmit)            \
  X(ResetCommandPool) X(CreateFence) X(DestroyFence) X(WaitForFences) X(ResetFences)            \
  X(DeviceWaitIdle)
// clang-format on

struct Dispatch {
#define WELKIN_MEMBER(name) PFN_vk##name name = nullptr;
  WELKIN_INSTANCE_FUNCTIONS(WELKIN_MEMBER)
  WELKIN_DEVICE_FUNCTIONS(WELKIN_MEMBER)
  WELKIN_HEADLESS_FUNCTIONS(WELKIN_MEMBER)
#undef WELKIN_MEMBER
};

// Each fails with WLK_ERROR_MISSING_FEATURE naming the function that is not there. A core name that
// is missing is looked up again with the suffix KHR.
void loadInstanceFunctions(Dispatch& table, PFN_vkGetInstanceProcAddr get, VkInstance instance);
void loadDeviceFunctions(Dispatch& table, VkDevice device, bool headless);

// Throws for any result below zero: OUT_OF_*, DEVICE_LOST or INTERNAL, naming the call.
void check(VkResult result, const char* call);

}  // namespace welkin::vk
