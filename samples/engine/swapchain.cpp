// SPDX-License-Identifier: MIT
#include "engine/swapchain.hpp"

#include <algorithm>
#include <stdexcept>

namespace {

VkSurfaceFormatKHR pickFormat(const Gpu& gpu) {
  uint32_t count = 0;
  check(vkGetPhysicalDeviceSurfaceFormatsKHR(gpu.physical(), gpu.surface(), &count, nullptr),
        "vkGetPhysicalDeviceSurfaceFormatsKHR");
  std::vector<VkSurfaceFormatKHR> formats(count);
  check(vkGetPhysicalDeviceSurfaceFormatsKHR(gpu.physical(), gpu.surface(), &count, formats.data()),
        "vkGetPhysicalDeviceSurfaceFormatsKHR");
  for (const VkSurfaceFormatKHR& format : formats) {
    if (format.colorSpace == VK_COLOR_SPACE_SRGB_NONLINEAR_KHR &&
        (format.format == VK_FORMAT_B8G8R8A8_SRGB || format.format == VK_FORMAT_R8G8B8A8_SRGB)) {
      return format;
    }
  }
  throw std::runtime_error("the window offers no 8-bit sRGB format");
}

}  // namespace

VkFormat displayFormat(const Gpu& gpu) {
  return pickFormat(gpu).format;
}

Swapchain::Swapchain(const Gpu& gpu, VkExtent2D wanted) : gpu_(gpu), wanted_(wanted) {
  VkSurfaceCapabilitiesKHR surface{};
  check(vkGetPhysicalDeviceSurfaceCapabilitiesKHR(gpu.physical(), gpu.surface(), &surface),
        "vkGetPhysicalDeviceSurfaceCapabilitiesKHR");
  const VkSurfaceFormatKHR format = pickFormat(gpu);
  format_ = format.format;
  extent_ = surface.currentExtent;
  if (extent_.width == UINT32_MAX) {  // the swapchain decides
    extent_.width =
        std::clamp(wanted.width, surface.minImageExtent.width, surface.maxImageExtent.width);
    extent_.height =
        std::clamp(wanted.height, surface.minImageExtent.height, surface.maxImageExtent.height);
  }
  VkSwapchainCreateInfoKHR info{VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR};
  info.surface = gpu.surface();
  info.minImageCount = surface.minImageCount + 1;
  if (surface.maxImageCount != 0) {
    info.minImageCount = std::min(info.minImageCount, surface.maxImageCount);
  }
  info.imageFormat = format.format;
  info.imageColorSpace = format.colorSpace;
  info.imageExtent = extent_;
  info.imageArrayLayers = 1;
  info.imageUsage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
  info.preTransform = surface.currentTransform;
  info.compositeAlpha = VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR;
  info.presentMode = VK_PRESENT_MODE_FIFO_KHR;
  info.clipped = VK_TRUE;
  check(vkCreateSwapchainKHR(gpu.device(), &info, nullptr, &swapchain_), "vkCreateSwapchainKHR");

  uint32_t count = 0;
  check(vkGetSwapchainImagesKHR(gpu.device(), swapchain_, &count, nullptr),
        "vkGetSwapchainImagesKHR");
  images_.resize(count);
  check(vkGetSwapchainImagesKHR(gpu.device(), swapchain_, &count, images_.data()),
        "vkGetSwapchainImagesKHR");
  views_.resize(count);
  rendered_.resize(count);
  for (uint32_t i = 0; i < count; ++i) {
    VkImageViewCreateInfo view{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
    view.image = images_[i];
    view.viewType = VK_IMAGE_VIEW_TYPE_2D;
    view.format = format_;
    view.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    check(vkCreateImageView(gpu.device(), &view, nullptr, &views_[i]), "vkCreateImageView");
    const VkSemaphoreCreateInfo semaphore{VK_STRUCTURE_TYPE_SEMAPHORE_CREATE_INFO};
    check(vkCreateSemaphore(gpu.device(), &semaphore, nullptr, &rendered_[i]), "vkCreateSemaphore");
  }
}

Swapchain::~Swapchain() {
  for (VkSemaphore semaphore : rendered_) {
    vkDestroySemaphore(gpu_.device(), semaphore, nullptr);
  }
  for (VkImageView view : views_) {
    vkDestroyImageView(gpu_.device(), view, nullptr);
  }
  vkDestroySwapchainKHR(gpu_.device(), swapchain_, nullptr);
}

std::optional<uint32_t> Swapchain::acquire(VkSemaphore ready) const {
  uint32_t index = 0;
  const VkResult result =
      vkAcquireNextImageKHR(gpu_.device(), swapchain_, UINT64_MAX, ready, VK_NULL_HANDLE, &index);
  if (result == VK_ERROR_OUT_OF_DATE_KHR) {
    return std::nullopt;
  }
  check(result, "vkAcquireNextImageKHR");
  return index;
}

bool Swapchain::present(uint32_t index) const {
  VkPresentInfoKHR info{VK_STRUCTURE_TYPE_PRESENT_INFO_KHR};
  info.waitSemaphoreCount = 1;
  info.pWaitSemaphores = &rendered_[index];
  info.swapchainCount = 1;
  info.pSwapchains = &swapchain_;
  info.pImageIndices = &index;
  const std::scoped_lock lock(gpu_.queueLock());
  const VkResult result = vkQueuePresentKHR(gpu_.queue(), &info);
  if (result == VK_ERROR_OUT_OF_DATE_KHR || result == VK_SUBOPTIMAL_KHR) {
    return false;
  }
  check(result, "vkQueuePresentKHR");
  return true;
}
