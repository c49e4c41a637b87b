// SPDX-License-Identifier: MIT
// Draws what Dear ImGui was told over the window's image, by ImGui's own Vulkan backend.
#pragma once

#include <vector>

#include "engine/swapchain.hpp"

struct GLFWwindow;

class PanelPass {
 public:
  // The window must outlive it. Takes the window's input events and hands them on.
  PanelPass(const Gpu& gpu, GLFWwindow* window, const Swapchain& swapchain);
  ~PanelPass();
  PanelPass(const PanelPass&) = delete;
  PanelPass& operator=(const PanelPass&) = delete;

  // For a new swapchain of the same format. No frame may be in flight.
  void setSwapchain(const Swapchain& swapchain);
  // Starts what the panel says; record() or skip() ends it.
  void begin() const;
  void skip() const;
  // Expects the image in COLOR_ATTACHMENT and leaves it there.
  void record(VkCommandBuffer commands, uint32_t image) const;

  // Whether the panel, not the world, has the mouse or the keys.
  bool wantsMouse() const;
  bool wantsKeys() const;

 private:
  void createRenderPass(VkFormat format);
  void createBackend(GLFWwindow* window, uint32_t images);
  void uploadFonts() const;
  void destroyFramebuffers();

  const Gpu& gpu_;
  VkRenderPass renderPass_ = VK_NULL_HANDLE;
  VkDescriptorPool pool_ = VK_NULL_HANDLE;
  std::vector<VkFramebuffer> framebuffers_;
  VkExtent2D extent_{};
};
