// SPDX-License-Identifier: MIT
#include "support/spy_device.hpp"

#include <vulkan/vulkan.h>

#include <array>
#include <cstring>
#include <stdexcept>

#include "support/descriptor_ledger.hpp"
#include "support/headless_scene.hpp"

namespace welkin::test {
namespace {

#define WELKIN_SPIED(X)                    \
  X(CmdDispatch, dispatches)               \
  X(CmdDispatchIndirect, dispatches)       \
  X(CmdDraw, draws)                        \
  X(CmdDrawIndirect, draws)                \
  X(CmdPipelineBarrier2, barriers)         \
  X(CmdCopyBufferToImage, copies)          \
  X(CmdCopyImageToBuffer, copies)          \
  X(CmdFillBuffer, copies)                 \
  X(CmdUpdateBuffer, copies)               \
  X(CmdClearColorImage, copies)            \
  X(CreateBuffer, created)                 \
  X(CreateBufferView, created)             \
  X(CreateImage, created)                  \
  X(CreateImageView, created)              \
  X(CreateSampler, created)                \
  X(CreateShaderModule, created)           \
  X(CreatePipelineLayout, created)         \
  X(CreateComputePipelines, created)       \
  X(CreateGraphicsPipelines, created)      \
  X(CreateQueryPool, created)              \
  X(DestroyBuffer, destroyed)              \
  X(DestroyBufferView, destroyed)          \
  X(DestroyImage, destroyed)               \
  X(DestroyImageView, destroyed)           \
  X(DestroySampler, destroyed)             \
  X(DestroyShaderModule, destroyed)        \
  X(DestroyDescriptorSetLayout, destroyed) \
  X(DestroyPipelineLayout, destroyed)      \
  X(DestroyPipeline, destroyed)            \
  X(DestroyDescriptorPool, destroyed)      \
  X(DestroyQueryPool, destroyed)           \
  X(AllocateMemory, allocated)             \
  X(CmdWriteTimestamp2, timestamps)

enum Spied {
#define WELKIN_INDEX(name, counter) SPIED_##name,
  WELKIN_SPIED(WELKIN_INDEX)
#undef WELKIN_INDEX
      SPIED_UpdateDescriptorSets,
  SPIED_GetQueryPoolResults,
  SPIED_CreateDescriptorSetLayout,
  SPIED_CreateDescriptorPool,
  SPIED_AllocateDescriptorSets,
  SPIED_COUNT
};

// C function pointers carry no state: what they count in is the process's.
struct Spy {
  VulkanCounts counts;
  DescriptorLedger ledger;
  std::set<std::string> asked;
  PFN_vkGetDeviceProcAddr deviceProc = nullptr;
  std::array<PFN_vkVoidFunction, SPIED_COUNT> real{};
  bool fakes = false;
  uint32_t timestampBits = 0;
  uint64_t clock = 0;
  uint32_t mostTexels = 0;  // 0: what the device says
};
Spy spied;

template <typename Function>
struct Wrapper;
template <typename Result, typename... Arguments>
struct Wrapper<Result(VKAPI_PTR*)(Arguments...)> {
  template <Spied WHICH, uint64_t VulkanCounts::*COUNTER>
  static VKAPI_ATTR Result VKAPI_CALL call(Arguments... arguments) {
    ++(spied.counts.*COUNTER);
    return reinterpret_cast<Result(VKAPI_PTR*)(Arguments...)>(spied.real[WHICH])(arguments...);
  }
};

VKAPI_ATTR void VKAPI_CALL updateDescriptorSets(VkDevice device, uint32_t writeCount,
                                                const VkWriteDescriptorSet* writes,
                                                uint32_t copyCount,
                                                const VkCopyDescriptorSet* copies) {
  spied.counts.descriptorWrites += writeCount + copyCount;
  reinterpret_cast<PFN_vkUpdateDescriptorSets>(spied.real[SPIED_UpdateDescriptorSets])(
      device, writeCount, writes, copyCount, copies);
}

VKAPI_ATTR VkResult VKAPI_CALL
createDescriptorSetLayout(VkDevice device, const VkDescriptorSetLayoutCreateInfo* info,
                          const VkAllocationCallbacks* callbacks, VkDescriptorSetLayout* layout) {
  ++spied.counts.created;
  const VkResult result = reinterpret_cast<PFN_vkCreateDescriptorSetLayout>(
      spied.real[SPIED_CreateDescriptorSetLayout])(device, info, callbacks, layout);
  if (result == VK_SUCCESS) {
    spied.ledger.made(*layout, *info);
  }
  return result;
}

VKAPI_ATTR VkResult VKAPI_CALL createDescriptorPool(VkDevice device,
                                                    const VkDescriptorPoolCreateInfo* info,
                                                    const VkAllocationCallbacks* callbacks,
                                                    VkDescriptorPool* pool) {
  ++spied.counts.created;
  const VkResult result = reinterpret_cast<PFN_vkCreateDescriptorPool>(
      spied.real[SPIED_CreateDescriptorPool])(device, info, callbacks, pool);
  if (result == VK_SUCCESS) {
    spied.ledger.made(*pool, *info);
  }
  return result;
}

VKAPI_ATTR VkResult VKAPI_CALL allocateDescriptorSets(VkDevice device,
                                                      const VkDescriptorSetAllocateInfo* info,
                                                      VkDescriptorSet* sets) {
  ++spied.counts.allocated;
  spied.counts.descriptorsShort += spied.ledger.allocated(*info);
  return reinterpret_cast<PFN_vkAllocateDescriptorSets>(spied.real[SPIED_AllocateDescriptorSets])(
      device, info, sets);
}

VKAPI_ATTR VkResult VKAPI_CALL getQueryPoolResults(VkDevice device, VkQueryPool pool,
                                                   uint32_t first, uint32_t count, size_t size,
                                                   void* data, VkDeviceSize stride,
                                                   VkQueryResultFlags flags) {
  const VkResult result = reinterpret_cast<PFN_vkGetQueryPoolResults>(
      spied.real[SPIED_GetQueryPoolResults])(device, pool, first, count, size, data, stride, flags);
  for (uint32_t i = 0; spied.fakes && i < count; ++i) {
    const uint64_t now = spied.clock & ((uint64_t{1} << spied.timestampBits) - 1);
    std::memcpy(static_cast<char*>(data) + i * stride, &now, sizeof now);
    spied.clock += SpyDevice::TICK;
  }
  return result;
}

VKAPI_ATTR void VKAPI_CALL queueFamilies(VkPhysicalDevice physical, uint32_t* count,
                                         VkQueueFamilyProperties* families) {
  vkGetPhysicalDeviceQueueFamilyProperties(physical, count, families);
  for (uint32_t i = 0; families != nullptr && i < *count; ++i) {
    families[i].timestampValidBits = spied.timestampBits;
  }
}

VKAPI_ATTR void VKAPI_CALL propertiesOf(VkPhysicalDevice physical,
                                        VkPhysicalDeviceProperties* properties) {
  vkGetPhysicalDeviceProperties(physical, properties);
  properties->limits.maxTexelBufferElements = spied.mostTexels;
}

struct Replacement {
  const char* name;
  PFN_vkVoidFunction function;
};

const std::array<Replacement, SPIED_COUNT>& replacements() {
  static const std::array<Replacement, SPIED_COUNT> table{{
#define WELKIN_ENTRY(name, counter)                  \
  {"vk" #name, reinterpret_cast<PFN_vkVoidFunction>( \
                   &Wrapper<PFN_vk##name>::call<SPIED_##name, &VulkanCounts::counter>)},
      WELKIN_SPIED(WELKIN_ENTRY)
#undef WELKIN_ENTRY
          {"vkUpdateDescriptorSets", reinterpret_cast<PFN_vkVoidFunction>(&updateDescriptorSets)},
      {"vkGetQueryPoolResults", reinterpret_cast<PFN_vkVoidFunction>(&getQueryPoolResults)},
      {"vkCreateDescriptorSetLayout",
       reinterpret_cast<PFN_vkVoidFunction>(&createDescriptorSetLayout)},
      {"vkCreateDescriptorPool", reinterpret_cast<PFN_vkVoidFunction>(&createDescriptorPool)},
      {"vkAllocateDescriptorSets", reinterpret_cast<PFN_vkVoidFunction>(&allocateDescriptorSets)},
  }};
  return table;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL spyDeviceProc(VkDevice device, const char* name) {
  spied.asked.insert(name);
  PFN_vkVoidFunction real = spied.deviceProc(device, name);
  for (size_t i = 0; i < replacements().size(); ++i) {
    if (std::strcmp(replacements()[i].name, name) == 0) {
      spied.real[i] = real;
      return replacements()[i].function;
    }
  }
  return real;
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL spyInstanceProc(VkInstance instance, const char* name) {
  PFN_vkVoidFunction real = vkGetInstanceProcAddr(instance, name);
  if (std::strcmp(name, "vkGetDeviceProcAddr") == 0) {
    spied.deviceProc = reinterpret_cast<PFN_vkGetDeviceProcAddr>(real);
    return reinterpret_cast<PFN_vkVoidFunction>(&spyDeviceProc);
  }
  if (spied.fakes && std::strcmp(name, "vkGetPhysicalDeviceQueueFamilyProperties") == 0) {
    return reinterpret_cast<PFN_vkVoidFunction>(&queueFamilies);
  }
  if (spied.mostTexels > 0 && std::strcmp(name, "vkGetPhysicalDeviceProperties") == 0) {
    return reinterpret_cast<PFN_vkVoidFunction>(&propertiesOf);
  }
  return real;
}

void require(VkResult result, const char* call) {
  if (result != VK_SUCCESS) {
    throw std::runtime_error(std::string(call) + " returned " + std::to_string(result));
  }
}

VKAPI_ATTR VkBool32 VKAPI_CALL keepMessage(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                           VkDebugUtilsMessageTypeFlagsEXT,
                                           const VkDebugUtilsMessengerCallbackDataEXT* data,
                                           void* user) {
  static_cast<std::vector<std::string>*>(user)->emplace_back(data->pMessage);
  return VK_FALSE;
}

}  // namespace

SpyDevice::SpyDevice(bool validation) {
  chooseDriver();
  spied.counts = {};
  spied.asked.clear();
  createInstance(validation);
  createDevice();
  VkCommandPoolCreateInfo pool{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
  pool.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
  pool.queueFamilyIndex = family;
  require(vkCreateCommandPool(device, &pool, nullptr, &pool_), "vkCreateCommandPool");
  VkCommandBufferAllocateInfo commands{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
  commands.commandPool = pool_;
  commands.commandBufferCount = 1;
  require(vkAllocateCommandBuffers(device, &commands, &commands_), "vkAllocateCommandBuffers");
  const VkFenceCreateInfo fence{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
  require(vkCreateFence(device, &fence, nullptr, &fence_), "vkCreateFence");
}

SpyDevice::~SpyDevice() {
  spied.fakes = false;
  spied.mostTexels = 0;
  vkDestroyFence(device, fence_, nullptr);
  vkDestroyCommandPool(device, pool_, nullptr);
  vkDestroyDevice(device, nullptr);
  if (messenger_ != VK_NULL_HANDLE) {
    reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(vkGetInstanceProcAddr(
        instance, "vkDestroyDebugUtilsMessengerEXT"))(instance, messenger_, nullptr);
  }
  vkDestroyInstance(instance, nullptr);
}

void SpyDevice::createInstance(bool validation) {
  VkDebugUtilsMessengerCreateInfoEXT messenger{
      VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
  messenger.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                              VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  messenger.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
  messenger.pfnUserCallback = keepMessage;
  messenger.pUserData = &messages_;
  const VkValidationFeatureEnableEXT enable =
      VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
  VkValidationFeaturesEXT features{VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT};
  features.enabledValidationFeatureCount = 1;
  features.pEnabledValidationFeatures = &enable;
  const char* layer = "VK_LAYER_KHRONOS_validation";
  const char* extension = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
  VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
  application.apiVersion = VK_API_VERSION_1_3;
  VkInstanceCreateInfo info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
  info.pApplicationInfo = &application;
  if (!validation) {
    require(vkCreateInstance(&info, nullptr, &instance), "vkCreateInstance");
    return;
  }
  info.pNext = &features;
  info.enabledLayerCount = 1;
  info.ppEnabledLayerNames = &layer;
  info.enabledExtensionCount = 1;
  info.ppEnabledExtensionNames = &extension;
  require(vkCreateInstance(&info, nullptr, &instance), "vkCreateInstance");
  require(
      reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(vkGetInstanceProcAddr(
          instance, "vkCreateDebugUtilsMessengerEXT"))(instance, &messenger, nullptr, &messenger_),
      "vkCreateDebugUtilsMessengerEXT");
}

void SpyDevice::createDevice() {
  uint32_t count = 1;
  const VkResult result = vkEnumeratePhysicalDevices(instance, &count, &physical);
  require(result == VK_INCOMPLETE ? VK_SUCCESS : result, "vkEnumeratePhysicalDevices");
  VkPhysicalDeviceVulkan13Features features13{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
  features13.synchronization2 = VK_TRUE;
  features13.dynamicRendering = VK_TRUE;
  VkPhysicalDeviceFeatures2 features{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2};
  features.pNext = &features13;
  features.features.shaderStorageImageWriteWithoutFormat = VK_TRUE;
  features.features.dualSrcBlend = VK_TRUE;
  features.features.fragmentStoresAndAtomics = VK_TRUE;
  const float priority = 1.0f;
  VkDeviceQueueCreateInfo queueInfo{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
  queueInfo.queueFamilyIndex = family;  // lavapipe has one family, which does everything
  queueInfo.queueCount = 1;
  queueInfo.pQueuePriorities = &priority;
  VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
  info.pNext = &features;
  info.queueCreateInfoCount = 1;
  info.pQueueCreateInfos = &queueInfo;
  require(vkCreateDevice(physical, &info, nullptr, &device), "vkCreateDevice");
  vkGetDeviceQueue(device, family, 0, &queue);
}

PFN_vkGetInstanceProcAddr SpyDevice::getInstanceProcAddr() {
  return &spyInstanceProc;
}

VulkanCounts& SpyDevice::counts() {
  return spied.counts;
}

void SpyDevice::fakeTimestamps(uint32_t bits) {
  spied.fakes = true;
  spied.timestampBits = bits;
  spied.clock = (uint64_t{1} << bits) - TICK / 2;
}

void SpyDevice::fakeTexels(uint32_t most) {
  spied.mostTexels = most;
}

const std::set<std::string>& SpyDevice::namesAsked() {
  return spied.asked;
}

void SpyDevice::record(const std::function<void(VkCommandBuffer)>& record) const {
  VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
  begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  require(vkBeginCommandBuffer(commands_, &begin), "vkBeginCommandBuffer");
  try {
    record(commands_);
  } catch (...) {
    vkEndCommandBuffer(commands_);  // thrown away: the next begin resets it
    throw;
  }
  require(vkEndCommandBuffer(commands_), "vkEndCommandBuffer");
}

void SpyDevice::run(const std::function<void(VkCommandBuffer)>& commands) const {
  record(commands);
  VkSubmitInfo submit{VK_STRUCTURE_TYPE_SUBMIT_INFO};
  submit.commandBufferCount = 1;
  submit.pCommandBuffers = &commands_;
  require(vkQueueSubmit(queue, 1, &submit, fence_), "vkQueueSubmit");
  require(vkWaitForFences(device, 1, &fence_, VK_TRUE, UINT64_MAX), "vkWaitForFences");
  require(vkResetFences(device, 1, &fence_), "vkResetFences");
}

SpyImage::SpyImage(const SpyDevice& spy, VkFormat imageFormat, VkExtent3D imageExtent,
                   VkImageUsageFlags usage)
    : format(imageFormat), extent(imageExtent), spy_(spy) {
  VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
  info.imageType = extent.depth > 1 ? VK_IMAGE_TYPE_3D : VK_IMAGE_TYPE_2D;
  info.format = format;
  info.extent = extent;
  info.mipLevels = info.arrayLayers = 1;
  info.samples = VK_SAMPLE_COUNT_1_BIT;
  info.usage = usage | VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  require(vkCreateImage(spy.device, &info, nullptr, &handle), "vkCreateImage");
  VkMemoryRequirements needs{};
  vkGetImageMemoryRequirements(spy.device, handle, &needs);
  memory_ = allocate(needs, false);
  require(vkBindImageMemory(spy.device, handle, memory_, 0), "vkBindImageMemory");
  VkBufferCreateInfo buffer{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
  buffer.size = VkDeviceSize{16} * extent.width * extent.height * extent.depth;
  buffer.usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
  require(vkCreateBuffer(spy.device, &buffer, nullptr, &buffer_), "vkCreateBuffer");
  vkGetBufferMemoryRequirements(spy.device, buffer_, &needs);
  bufferMemory_ = allocate(needs, true);
  require(vkBindBufferMemory(spy.device, buffer_, bufferMemory_, 0), "vkBindBufferMemory");
  require(vkMapMemory(spy.device, bufferMemory_, 0, VK_WHOLE_SIZE, 0, &mapped_), "vkMapMemory");
}

SpyImage::~SpyImage() {
  vkDestroyImage(spy_.device, handle, nullptr);
  vkFreeMemory(spy_.device, memory_, nullptr);
  vkDestroyBuffer(spy_.device, buffer_, nullptr);
  vkFreeMemory(spy_.device, bufferMemory_, nullptr);
}

VkDeviceMemory SpyImage::allocate(const VkMemoryRequirements& needs, bool hostVisible) const {
  VkPhysicalDeviceMemoryProperties properties{};
  vkGetPhysicalDeviceMemoryProperties(spy_.physical, &properties);
  const VkMemoryPropertyFlags wanted =
      hostVisible ? VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT : 0;
  for (uint32_t i = 0; i < properties.memoryTypeCount; ++i) {
    if ((needs.memoryTypeBits >> i & 1u) != 0 &&
        (properties.memoryTypes[i].propertyFlags & wanted) == wanted) {
      const VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, nullptr, needs.size,
                                      i};
      VkDeviceMemory memory = VK_NULL_HANDLE;
      require(vkAllocateMemory(spy_.device, &info, nullptr, &memory), "vkAllocateMemory");
      return memory;
    }
  }
  throw std::runtime_error("no memory type");
}

void SpyImage::copy(bool toImage, VkImageLayout from, VkImageLayout to) const {
  const VkImageLayout middle =
      toImage ? VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL : VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL;
  const auto move = [&](VkCommandBuffer commands, VkImageLayout a, VkImageLayout b) {
    VkImageMemoryBarrier barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER};
    barrier.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
    barrier.oldLayout = a;
    barrier.newLayout = b;
    barrier.image = handle;
    barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                         VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 0, nullptr, 0, nullptr, 1,
                         &barrier);
  };
  spy_.run([&](VkCommandBuffer commands) {
    move(commands, from, middle);
    VkBufferImageCopy region{};
    region.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
    region.imageExtent = extent;
    if (toImage) {
      vkCmdCopyBufferToImage(commands, buffer_, handle, middle, 1, &region);
    } else {
      vkCmdCopyImageToBuffer(commands, handle, middle, buffer_, 1, &region);
    }
    move(commands, middle, to);
  });
}

void SpyImage::write(VkImageLayout after) const {
  copy(true, VK_IMAGE_LAYOUT_UNDEFINED, after);
}

void SpyImage::read(VkImageLayout before) const {
  copy(false, before, before);
}

}  // namespace welkin::test
