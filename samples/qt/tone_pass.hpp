// SPDX-License-Identifier: MIT
// Tone-maps the pictures of both views into the halves of the window.
#pragma once

#include <array>

#include "engine/swapchain.hpp"
#include "scene_pass.hpp"

constexpr uint32_t VIEWS = 2;

class TonePass {
 public:
  TonePass(const Gpu& gpu, VkFormat displayFormat);
  ~TonePass();
  TonePass(const TonePass&) = delete;
  TonePass& operator=(const TonePass&) = delete;

  // No frame may be in flight.
  void setPicture(uint32_t view, const Image& picture) const;
  // Expects the pictures in SAMPLED, leaves the window's image in COLOR_ATTACHMENT.
  void record(VkCommandBuffer commands, const Swapchain& swapchain, uint32_t index,
              VkExtent2D half) const;

 private:
  const Gpu& gpu_;
  VkSampler sampler_ = VK_NULL_HANDLE;
  VkDescriptorSetLayout setLayout_ = VK_NULL_HANDLE;
  VkDescriptorPool pool_ = VK_NULL_HANDLE;
  std::array<VkDescriptorSet, VIEWS> sets_{};
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
  VkPipeline pipeline_ = VK_NULL_HANDLE;
};
