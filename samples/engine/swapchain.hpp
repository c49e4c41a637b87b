// SPDX-License-Identifier: MIT
// The images of the window.
#pragma once

#include <optional>
#include <vector>

#include "engine/gpu.hpp"

class Swapchain {
 public:
  Swapchain(const Gpu& gpu, VkExtent2D wanted);
  ~Swapchain();
  Swapchain(const Swapchain&) = delete;
  Swapchain& operator=(const Swapchain&) = delete;

  // Index of the next image, or nothing if the window changed and a new swapchain is needed.
  // `ready` is signalled when it may be written.
  std::optional<uint32_t> acquire(VkSemaphore ready) const;
  // Shows the image after rendered(index) is signalled; false if a new swapchain is needed.
  bool present(uint32_t index) const;

  // Whether this was made for a window of this size. Ask each frame: not every driver says that a
  // window has changed; lavapipe of Mesa 22 shows pictures of the old size in it.
  bool fits(VkExtent2D window) const {
    return window.width == wanted_.width && window.height == wanted_.height;
  }

  VkExtent2D extent() const { return extent_; }
  uint32_t imageCount() const { return static_cast<uint32_t>(images_.size()); }
  VkFormat format() const { return format_; }
  VkImage image(uint32_t index) const { return images_[index]; }
  VkImageView view(uint32_t index) const { return views_[index]; }
  VkSemaphore rendered(uint32_t index) const { return rendered_[index]; }

 private:
  const Gpu& gpu_;
  VkFormat format_ = VK_FORMAT_UNDEFINED;
  VkExtent2D wanted_{};
  VkExtent2D extent_{};
  VkSwapchainKHR swapchain_ = VK_NULL_HANDLE;
  std::vector<VkImage> images_;
  std::vector<VkImageView> views_;
  // One per image: presentation may still wait on it when the next frame is recorded.
  std::vector<VkSemaphore> rendered_;
};

// The surface's format whose writes encode sRGB.
VkFormat displayFormat(const Gpu& gpu);
