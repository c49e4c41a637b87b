// SPDX-License-Identifier: MIT
#include "vk/device.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "failure.hpp"

namespace welkin::vk {

namespace {

VkBufferView texelsOf(const Device& device, VkBuffer buffer) {
  VkBufferViewCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO};
  info.buffer = buffer;
  info.format = VK_FORMAT_R32G32B32A32_UINT;
  info.range = VK_WHOLE_SIZE;
  VkBufferView view = VK_NULL_HANDLE;
  check(device.vk().CreateBufferView(device.handle(), &info, nullptr, &view), "vkCreateBufferView");
  return view;
}

}  // namespace

Device::Device(const DeviceInfo& info, std::pmr::memory_resource* host) : info_(info) {
  loadInstanceFunctions(vk_, info.getInstanceProcAddr, info.instance);
  vk_.GetPhysicalDeviceProperties(info.physicalDevice, &properties_);
  if (properties_.apiVersion < VK_API_VERSION_1_3) {
    fail(WLK_ERROR_MISSING_FEATURE, 0, "apiVersion",
         "the device supports Vulkan %u.%u, Welkin needs 1.3",
         VK_API_VERSION_MAJOR(properties_.apiVersion),
         VK_API_VERSION_MINOR(properties_.apiVersion));
  }
  // Light buffer, fields and scattering tables; Vulkan promises none of it.
  for (const VkFormat format :
       {VK_FORMAT_R32_SFLOAT, VK_FORMAT_R32G32_SFLOAT, VK_FORMAT_R32G32B32A32_SFLOAT}) {
    if (!supports(format, VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT)) {
      fail(WLK_ERROR_MISSING_FEATURE, 0, "format",
           "the device cannot filter images of VkFormat %d linearly", static_cast<int>(format));
    }
  }
  loadDeviceFunctions(vk_, info.device, info.headless);
  const VkPhysicalDeviceLimits& limits = properties_.limits;
  texels_ = limits.maxTexelBufferElements >= limits.maxStorageBufferRange / ROW_BYTES;
  timestampMask_ = timestampMask();
  memory_.emplace(vk_, info.physicalDevice, info.device, info.memoryLimit, host);
}

bool Device::supports(VkFormat format, VkFormatFeatureFlags features) const {
  VkFormatProperties properties{};
  vk_.GetPhysicalDeviceFormatProperties(info_.physicalDevice, format, &properties);
  return (properties.optimalTilingFeatures & features) == features;
}

uint64_t Device::timestampMask() const {
  constexpr uint32_t MOST = 32;
  std::array<VkQueueFamilyProperties, MOST> families{};
  uint32_t count = MOST;
  vk_.GetPhysicalDeviceQueueFamilyProperties(info_.physicalDevice, &count, families.data());
  const uint32_t family = info_.queueFamilyIndex;
  if (family >= std::min(count, MOST) || families[family].timestampValidBits == 0 ||
      !(properties_.limits.timestampPeriod > 0)) {
    return 0;
  }
  return ~uint64_t{0} >> (64 - std::min(families[family].timestampValidBits, 64U));
}

Buffer::Buffer(Device& device, VkDeviceSize size, VkBufferUsageFlags usage, bool hostVisible)
    : device_(&device), size_(size) {
  const Dispatch& vk = device.vk();
  VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
  // Larger ones are refused by who asked for them.
  const bool texels = (usage & VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT) != 0 && device.texels() &&
                      size <= device.properties().limits.maxStorageBufferRange;
  if (texels) {
    size_ = wholeRows(size);
  }
  info.size = size_;
  info.usage = texels ? usage : usage & ~VkFlags{VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT};
  check(vk.CreateBuffer(device.handle(), &info, nullptr, &buffer_), "vkCreateBuffer");
  try {
    VkMemoryRequirements needs{};
    vk.GetBufferMemoryRequirements(device.handle(), buffer_, &needs);
    allocation_ = device.memory().allocate(needs, hostVisible, true);
    check(vk.BindBufferMemory(device.handle(), buffer_, device.memory().memoryOf(allocation_),
                              allocation_.offset),
          "vkBindBufferMemory");
    if (texels) {
      texels_ = texelsOf(device, buffer_);
    }
  } catch (...) {
    vk.DestroyBuffer(device.handle(), buffer_, nullptr);
    device.memory().release(allocation_);
    throw;
  }
}

Buffer::~Buffer() {
  if (buffer_ != VK_NULL_HANDLE) {
    if (texels_ != VK_NULL_HANDLE) {
      device_->vk().DestroyBufferView(device_->handle(), texels_, nullptr);
    }
    device_->vk().DestroyBuffer(device_->handle(), buffer_, nullptr);
    device_->memory().release(allocation_);
  }
}

void Buffer::swap(Buffer& other) noexcept {
  std::swap(device_, other.device_);
  std::swap(buffer_, other.buffer_);
  std::swap(texels_, other.texels_);
  std::swap(size_, other.size_);
  std::swap(allocation_, other.allocation_);
}

VkImageView createView(const Device& device, VkImage image, VkFormat format, VkImageViewType type,
                       const VkImageSubresourceRange& range) {
  VkImageViewCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
  info.image = image;
  info.viewType = type;
  info.format = format;
  info.subresourceRange = range;
  VkImageView view = VK_NULL_HANDLE;
  check(device.vk().CreateImageView(device.handle(), &info, nullptr, &view), "vkCreateImageView");
  return view;
}

Image::Image(Device& device, const ImageInfo& info) : device_(&device), info_(info) {
  const Dispatch& vk = device.vk();
  VkImageCreateInfo create{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
  create.imageType = info.type;
  create.format = info.format;
  create.extent = info.extent;
  create.mipLevels = info.levels;
  create.arrayLayers = info.layers;
  create.samples = VK_SAMPLE_COUNT_1_BIT;
  create.tiling = VK_IMAGE_TILING_OPTIMAL;
  create.usage = info.usage;
  create.initialLayout = VK_IMAGE_LAYOUT_UNDEFINED;
  check(vk.CreateImage(device.handle(), &create, nullptr, &image_), "vkCreateImage");
  try {
    VkMemoryRequirements needs{};
    vk.GetImageMemoryRequirements(device.handle(), image_, &needs);
    allocation_ = device.memory().allocate(needs, false, false);
    check(vk.BindImageMemory(device.handle(), image_, device.memory().memoryOf(allocation_),
                             allocation_.offset),
          "vkBindImageMemory");
    const VkImageViewType type =
        info.type == VK_IMAGE_TYPE_3D
            ? VK_IMAGE_VIEW_TYPE_3D
            : (info.arrayView ? VK_IMAGE_VIEW_TYPE_2D_ARRAY : VK_IMAGE_VIEW_TYPE_2D);
    view_ = createView(device, image_, info.format, type,
                       {VK_IMAGE_ASPECT_COLOR_BIT, 0, info.levels, 0, info.layers});
  } catch (...) {
    vk.DestroyImage(device.handle(), image_, nullptr);
    device.memory().release(allocation_);
    throw;
  }
}

Image::~Image() {
  if (image_ != VK_NULL_HANDLE) {
    device_->vk().DestroyImageView(device_->handle(), view_, nullptr);
    device_->vk().DestroyImage(device_->handle(), image_, nullptr);
    device_->memory().release(allocation_);
  }
}

void Image::swap(Image& other) noexcept {
  std::swap(device_, other.device_);
  std::swap(image_, other.image_);
  std::swap(view_, other.view_);
  std::swap(info_, other.info_);
  std::swap(allocation_, other.allocation_);
  std::swap(layout, other.layout);
}

}  // namespace welkin::vk
